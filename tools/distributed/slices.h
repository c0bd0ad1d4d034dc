// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Arrays over all points of which each block has written its own part.
#pragma once

#include "core/csr_lists.h"
#include "store.h"

#include <map>
#include <string>
#include <vector>

namespace pcl::floater {
/// What the blocks have written in one step.
class Slices
{
public:
  /// \param store, plan, ranges must outlive this
  Slices (Store& store, const Plan& plan, const BlockRanges& ranges, const char* step)
      : store_ (store), plan_ (plan), ranges_ (ranges), step_ (step)
  {
  }

  /// The file of a block.
  ArrayFile& file (std::size_t block);

  /// Values of some points, `width` for each.
  /// \param points ascending
  template <typename T>
  void gather (const std::string& array, const std::vector<Index>& points, std::size_t width,
               T* values)
  {
    forEachRun (points, [&] (std::size_t at, std::size_t block, Index first, Index last) {
      file (block).read (array, first * width, last * width, values + at * width);
    });
  }

  template <typename T>
  std::vector<T> gather (const std::string& array, const std::vector<Index>& points,
                         std::size_t width = 1)
  {
    std::vector<T> values (points.size () * width);
    gather (array, points, width, values.data ());
    return values;
  }

  /// Lists of some points, which the blocks have written by writeLists: row i is that of points[i].
  CsrLists gatherLists (const std::string& array, const std::vector<Index>& points);

private:
  // Calls visit (place in points, block, first, last), the latter two counted in the block, for
  // points that follow each other in one block.
  template <typename Visit>
  void forEachRun (const std::vector<Index>& points, Visit&& visit)
  {
    for (std::size_t begin = 0, end = 0; begin < points.size (); begin = end) {
      const std::size_t block = ranges_.blockOf (points[begin]);
      const Index first = ranges_.first (block), last = ranges_.last (block);
      for (end = begin + 1;
           end < points.size () && points[end] < last && points[end] == points[end - 1] + 1;)
        ++end;
      visit (begin, block, points[begin] - first, points[end - 1] + 1 - first);
    }
  }

  Store& store_;
  const Plan& plan_;
  const BlockRanges& ranges_;
  const char* step_;
  std::map<std::size_t, ArrayFile> files_;
};

/// Lists as two arrays, the second of which is named "<array>.ends". All must outlive the writer.
void
writeLists (const std::string& array, const CsrLists& lists, ArrayWriter& writer);

/// Reads lists that writeLists has written, `first` to before `last`.
CsrLists
readLists (ArrayFile& file, const std::string& array, std::size_t first, std::size_t last);

/// Appends a list to others.
void
appendRow (const Row& row, CsrLists& all);

/// Points of a part of the working set, and where they are in it.
class LocalPoints
{
public:
  /// \param points ascending; must outlive this
  explicit LocalPoints (const std::vector<Index>& points);

  std::size_t size () const { return points_.size (); }

  /// Place of a point; NONE if it is not in the part.
  Index placeOf (Index point) const;

  /// Replaces points by their places.
  /// \return whether all are in the part
  bool toPlaces (std::vector<Index>& points) const;

  /// Replaces places by their points.
  void toPoints (std::vector<Index>& places) const
  {
    for (Index& place : places)
      place = points_[place];
  }

  /// Lists of places for all points of the part, of lists of points of some. Those of the others
  /// are empty.
  /// \param rows whose lists are given, as points, ascending; all in the part
  CsrLists toPlaces (const std::vector<Index>& rows, CsrLists lists) const;

private:
  struct Run
  {
    Index first, last; // points, one past the last
    Index place;       // of the first
  };

  const std::vector<Index>& points_;
  std::vector<Run> runs_; // of points that follow each other
  mutable std::size_t hint_ = 0;
};

} // namespace pcl::floater

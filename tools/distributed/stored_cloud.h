// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The points of a run and what the blocks have found out, as the steps read them.
#pragma once

#include "core/csr_lists.h"
#include "core/order_statistics.h"
#include "job.h"
#include "points/point_block.h"

#include <map>
#include <numeric>
#include <string>
#include <vector>

namespace pcl::floater {
using Box = BlockCutter::Box;

inline std::vector<Index>
pointsFrom (Index first, Index last)
{
  std::vector<Index> points (last - first);
  std::iota (points.begin (), points.end (), first);
  return points;
}

/// Outliers that the second step has chosen, ascending.
std::vector<Index>
readOutliers (const StepContext& context);

/// Writes a working set and what is needed to cut it.
/// \param name POINTS or POINTS_LEFT
/// \param gross_outliers cloud indices
void
writePoints (Store& store, const std::string& name, std::uint64_t plan, const Points& points,
             const std::vector<Index>& gross_outliers);

/// Reads it.
/// \param[out] gross_outliers cloud indices
Points
readPoints (Store& store, const std::string& name, const Plan& plan,
            std::vector<Index>& gross_outliers);

/// The points without outliers, how they are cut, and what the blocks have written about them. Lists
/// of points are ascending.
class StoredCloud
{
public:
  /// \param context must outlive this
  StoredCloud (const StepContext& context, const std::vector<Index>& outliers);

  ArrayFile& file () { return file_; } ///< of the points
  const BlockCutter& cutter () const { return cutter_; }
  std::size_t points () const { return points_; }
  Index first (std::size_t block) const
  {
    return BlockCutter::firstOf (block, context_.plan.blocks, points_);
  }
  Index last (std::size_t block) const { return first (block + 1); }
  bool hasPoints (std::size_t block) const { return first (block) < last (block); }
  std::vector<Index> own (std::size_t block) const
  {
    return pointsFrom (first (block), last (block));
  }

  /// Values of some points that are stored with these; empty if there are none of any.
  template <typename T>
  std::vector<T> given (const std::string& array, const std::vector<Index>& points)
  {
    std::vector<T> values;
    if (file_.count (array) > 0)
      forEachRun (points, [&] (std::size_t block, Index begin, Index end) {
        file_.append (array, first (block) + begin, first (block) + end, values);
      });
    return values;
  }

  /// What a block has written in a step.
  ArrayFile& slice (const char* step, std::size_t block);

  /// Values of some points from an array of a step, `width` for each. If they are indices, these must
  /// be those of points.
  template <typename T>
  std::vector<T> gather (const char* step, const std::string& array,
                         const std::vector<Index>& points, std::size_t width = 1)
  {
    std::vector<T> values;
    values.reserve (points.size () * width);
    forEachRun (points, [&] (std::size_t block, Index begin, Index end) {
      const std::size_t before = values.size ();
      slice (step, block).append (array, begin * width, end * width, values);
      if constexpr (std::is_same_v<T, Index>)
        slice (step, block).requireBelow (values, points_, before);
    });
    return values;
  }

  /// Lists of some points from two arrays of a step, the second of which is named "<array>.offsets":
  /// row i is that of points[i].
  CsrLists gatherLists (const char* step, const std::string& array,
                        const std::vector<Index>& points);

  /// The neighbours of points without those beside lines.
  CsrLists nearest (const std::vector<Index>& points);

private:
  // Calls visit (block, begin, end), the latter two counted in the block, for points that follow each
  // other in one block.
  template <typename Visit>
  void forEachRun (const std::vector<Index>& points, Visit&& visit) const
  {
    std::size_t block = 0;
    for (std::size_t begin = 0, end = 0; begin < points.size (); begin = end) {
      while (points[begin] >= last (block))
        ++block;
      const Index from = first (block), to = last (block);
      for (end = begin + 1;
           end < points.size () && points[end] < to && points[end] == points[end - 1] + 1;)
        ++end;
      visit (block, points[begin] - from, points[end - 1] + 1 - from);
    }
  }

  const StepContext& context_;
  const char* neighbors_step_; // that has found the neighbours of these points
  ArrayFile file_;
  std::size_t points_;
  BlockCutter cutter_;
  std::map<std::string, ArrayFile> slices_;
};

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The points of a run and what the blocks have found out, as the steps of the blocks read them.
#pragma once

#include "core/csr_lists.h"
#include "core/order_statistics.h"
#include "job.h"
#include "points/point_block.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <vector>

namespace pcl::floater {
/// Which points a block owns.
class BlockRanges
{
public:
  /// \param points with or without outliers
  BlockRanges (const Plan& plan, std::size_t points) : blocks_ (plan.blocks), points_ (points) {}

  std::size_t blocks () const { return blocks_; }
  std::size_t points () const { return points_; }
  Index first (std::size_t block) const { return BlockCutter::firstOf (block, blocks_, points_); }
  Index last (std::size_t block) const { return first (block + 1); }

  /// Calls visit (block, first, last), the latter two counted in the block, for points that follow
  /// each other in one block.
  /// \param points ascending
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

private:
  std::size_t blocks_, points_;
};

/// What the blocks have written in one step.
class Slices
{
public:
  /// \param context, ranges must outlive this
  Slices (const StepContext& context, const BlockRanges& ranges, const char* step)
      : context_ (context), ranges_ (ranges), step_ (step)
  {
  }

  ArrayFile& file (std::size_t block);

  /// Values of some points, `width` for each. If they are indices, these must be those of points.
  /// \param points ascending
  template <typename T>
  std::vector<T> gather (const std::string& array, const std::vector<Index>& points,
                         std::size_t width = 1)
  {
    std::vector<T> values;
    values.reserve (points.size () * width);
    ranges_.forEachRun (points, [&] (std::size_t block, Index first, Index last) {
      const std::size_t before = values.size ();
      file (block).append (array, first * width, last * width, values);
      if constexpr (std::is_same_v<T, Index>)
        file (block).requireBelow (values, ranges_.points (), before);
    });
    return values;
  }

  /// Lists of some points: row i is that of points[i]. The offsets are in the array "<array>.offsets".
  CsrLists gatherLists (const std::string& array, const std::vector<Index>& points);

private:
  const StepContext& context_;
  const BlockRanges& ranges_;
  const char* step_;
  std::map<std::size_t, ArrayFile> files_;
};

using Box = BlockCutter::Box;

inline std::vector<Index>
pointsFrom (Index first, Index last)
{
  std::vector<Index> points (last - first);
  std::iota (points.begin (), points.end (), first);
  return points;
}

/// The points of a run, in a file, and how they are cut.
class StoredCloud
{
public:
  /// \param name POINTS, or POINTS_LEFT if there are outliers
  StoredCloud (const StepContext& context, const char* name)
      : file_ (openArrays (context.store, name, context.plan)),
        ranges_ (context.plan, file_.count ("positions")),
        cutter_ (
            ranges_.points (), file_.read<Box> ("groups"), context.plan.blocks,
            [this] (std::size_t first, std::size_t last, std::vector<Box>& buckets) {
              file_.append ("buckets", first, last, buckets);
            },
            [this] (Index first, Index last, std::vector<Eigen::Vector3d>& positions) {
              file_.append ("positions", first, last, positions);
            })
  {
  }

  ArrayFile& file () { return file_; }
  const BlockRanges& ranges () const { return ranges_; }
  const BlockCutter& cutter () const { return cutter_; }

  // \param points ascending
  std::vector<Eigen::Vector3d> gather (const std::vector<Index>& points)
  {
    std::vector<Eigen::Vector3d> positions;
    positions.reserve (points.size ());
    ranges_.forEachRun (points, [&] (std::size_t block, Index first, Index last) {
      const Index before = ranges_.first (block);
      file_.append ("positions", before + first, before + last, positions);
    });
    return positions;
  }

private:
  ArrayFile file_;
  BlockRanges ranges_;
  BlockCutter cutter_;
};

/// Outliers that the second step has chosen, ascending.
std::vector<Index>
readOutliers (const StepContext& context);

/// Writes a working set and what is needed to cut it.
/// \param name POINTS or POINTS_LEFT
/// \param gross_outliers cloud indices
void
writePoints (Store& store, const std::string& name, std::uint64_t plan, const Points& points,
             const std::vector<Index>& gross_outliers, const RunContext& run);

/// Reads it.
/// \param[out] gross_outliers cloud indices
Points
readPoints (Store& store, const std::string& name, const Plan& plan,
            std::vector<Index>& gross_outliers);

/// The neighbours of points without outliers, and those beside lines.
class StoredNeighbors
{
public:
  StoredNeighbors (const StepContext& context, const std::vector<Index>& outliers,
                   const BlockRanges& ranges)
      : width_ (std::min<std::size_t> (static_cast<std::size_t> (context.options.neighbors.k),
                                       ranges.points () - 1)),
        found_ (context, ranges, outliers.empty () ? "neighbors" : "planes"),
        planes_ (context, ranges, "planes")
  {
  }

  // Without those beside lines.
  CsrLists nearest (const std::vector<Index>& points)
  {
    requireListed (points.size () * width_);
    CsrLists lists;
    lists.ids = found_.gather<Index> ("ids", points, width_);
    lists.offsets.resize (points.size () + 1);
    for (std::size_t i = 0; i <= points.size (); ++i)
      lists.offsets[i] = static_cast<Index> (i * width_);
    return lists;
  }

  CsrLists beside (const std::vector<Index>& points)
  {
    return planes_.gatherLists ("beside", points);
  }

  Slices& planes () { return planes_; }

private:
  std::size_t width_;
  Slices found_, planes_;
};

/// What a step of a block without outliers begins with.
struct OwnBlock
{
  OwnBlock (const StepContext& context, std::size_t block)
      : outliers (readOutliers (context)),
        cloud (context, outliers.empty () ? POINTS : POINTS_LEFT),
        first (cloud.ranges ().first (block)), last (cloud.ranges ().last (block))
  {
  }

  bool isEmpty () const { return first == last; }

  std::vector<Index> outliers;
  StoredCloud cloud; ///< without them
  Index first, last; ///< the own points, and one behind the last
};

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The points of a run and what the blocks have found out, as the steps read them.
#pragma once

#include "core/csr_lists.h"
#include "core/order_statistics.h"
#include "job.h"
#include "points/neighbors.h"

#include <boost/range/irange.hpp>
#include <boost/range/iterator_range.hpp>

#include <map>

namespace pcl::floater {
using Box = BlockCutter::Box;

/// What the second step has chosen.
struct LeftOut
{
  bool are_stacked = false;      ///< some points lie on others: a net of them is left
  std::vector<Index> outliers{}; ///< of the net, ascending

  bool isNothing () const { return !are_stacked && outliers.empty (); }
};

inline LeftOut
readLeftOut (const StepContext& context)
{
  ArrayFile file = context.store.arrays (OUTLIERS, context.plan);
  LeftOut left_out{file.count ("are_stacked") > 0, file.read<Index> ("outliers")};
  const std::vector<Index>& outliers = left_out.outliers;
  file.requireBelow (outliers, context.plan.points);
  file.require (outliers.size () < context.plan.points &&
                std::is_sorted (outliers.begin (), outliers.end (), std::less_equal<> ()));
  return left_out;
}

/// Writes a working set and what is needed to cut it.
/// \param name POINTS or POINTS_LEFT
/// \param gross_outliers cloud indices
inline void
writePoints (const Store& store, const std::string& name, std::uint64_t plan, const Points& points,
             const std::vector<Index>& gross_outliers)
{
  store.put (name,
             {{"positions", points.positions},
              {"cloud_index", points.cloud_index},
              {"normals", points.normals},
              {"facing_normals", points.facing_normals},
              {"buckets", BlockCutter::makeBuckets (points.positions)},
              {"non_finite", points.non_finite},
              {"duplicates", points.duplicates},
              {"gross_outliers", gross_outliers}},
             plan);
}

/// Reads the working set of the plan.
/// \param[out] gross_outliers cloud indices
inline Points
readPoints (const Store& store, const Plan& plan, std::vector<Index>& gross_outliers)
{
  ArrayFile file = store.arrays (POINTS, plan);
  Points points;
  points.positions = file.read<Eigen::Vector3d> ("positions");
  points.cloud_index = file.read<Index> ("cloud_index");
  points.normals = file.read<Eigen::Vector3f> ("normals");
  points.facing_normals = file.read<Eigen::Vector3f> ("facing_normals");
  points.non_finite = file.read<Index> ("non_finite");
  points.duplicates = file.read<std::array<Index, 2>> ("duplicates");
  gross_outliers = file.read<Index> ("gross_outliers");
  for (const std::vector<Index>* list : {&points.cloud_index, &points.non_finite, &gross_outliers})
    file.requireBelow (*list, plan.cloudSize ());
  file.requireBelow (points.duplicates, plan.cloudSize ());
  const std::size_t count = points.positions.size ();
  file.require (count > 0 && count <= plan.points && points.cloud_index.size () == count);
  for (const std::vector<Eigen::Vector3f>* normals : {&points.normals, &points.facing_normals})
    file.require (normals->empty () || normals->size () == count);
  points.centre = Eigen::Map<const Eigen::Vector3d> (plan.centre.data ());
  points.scale = plan.scale;
  return points;
}

/// The points that are left, how they are cut, and what the blocks have written about them. Lists of
/// points are ascending.
class StoredCloud
{
public:
  /// \param context must outlive this
  StoredCloud (const StepContext& context, const LeftOut& left_out)
      : context_ (context), neighbors_step_ (left_out.isNothing () ? "neighbors" : "planes"),
        file_ (context.store.arrays (left_out.isNothing () ? POINTS : POINTS_LEFT, context.plan)),
        cutter_{file_.count ("positions"), file_.read<Box> ("buckets"), context.plan.blocks,
                [this] (Index first, Index last, std::vector<Eigen::Vector3d>& positions) {
                  file_.append ("positions", first, last, positions);
                }}
  {
  }

  const BlockCutter& cutter () const { return cutter_; }
  bool hasPoints (std::size_t block) const { return cutter_.first (block) < cutter_.last (block); }
  std::vector<Index> all () const
  {
    return boost::copy_range<std::vector<Index>> (
        boost::irange (Index{0}, static_cast<Index> (cutter_.points)));
  }
  std::vector<Index> own (std::size_t block) const
  {
    return boost::copy_range<std::vector<Index>> (
        boost::irange (cutter_.first (block), cutter_.last (block)));
  }

  /// Values of some points that are stored with these; empty if there are none of any.
  template <typename T>
  std::vector<T> given (const std::string& array, const std::vector<Index>& points)
  {
    std::vector<T> values;
    if (file_.count (array) > 0)
      forEachRun (points, [&] (std::size_t block, Index begin, Index end) {
        file_.append (array, cutter_.first (block) + begin, cutter_.first (block) + end, values);
      });
    return values;
  }

  /// What a block has written in a step.
  ArrayFile& slice (const char* step, std::size_t block)
  {
    const std::string name = blockFile (step, block);
    const auto known = slices_.find (name);
    return known != slices_.end ()
               ? known->second
               : slices_.emplace (name, context_.store.arrays (name, context_.plan)).first->second;
  }

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
        slice (step, block).requireBelow (values, cutter_.points, before);
    });
    return values;
  }

  /// Lists of some points from two arrays of a step, the second of which is named "<array>.offsets":
  /// row i is that of points[i].
  CsrLists gatherLists (const char* step, const std::string& array,
                        const std::vector<Index>& points)
  {
    CsrLists all;
    all.offsets.reserve (points.size () + 1);
    all.offsets.push_back (0);
    std::size_t entries = 0; // of whole blocks, which are most if all points are asked for
    forEachRun (points, [&] (std::size_t block, Index begin, Index end) {
      if (end - begin == cutter_.last (block) - cutter_.first (block))
        entries += slice (step, block).count (array);
    });
    all.ids.reserve (entries);
    forEachRun (points, [&] (std::size_t block, Index begin, Index end) {
      ArrayFile& its = slice (step, block);
      std::vector<Index> offsets;
      its.append (array + ".offsets", begin, end + std::size_t{1}, offsets);
      its.require (std::is_sorted (offsets.begin (), offsets.end ()));
      const std::size_t before = all.ids.size ();
      requireListed (before + (offsets.back () - offsets.front ()));
      its.append (array, offsets.front (), offsets.back (), all.ids);
      its.requireBelow (all.ids, cutter_.points, before);
      for (auto offset = offsets.begin () + 1; offset != offsets.end (); ++offset)
        all.offsets.push_back (static_cast<Index> (before) + *offset - offsets.front ());
    });
    return all;
  }

  /// The nearest neighbours of the points of a block, by a search.
  CsrLists findNearest (std::size_t block) const
  {
    BlockSearch search (cutter_, block);
    return findNearestOfBlock (search, cutter_.points, context_.options.neighbors.k, context_.run);
  }

  /// The neighbours of points without those beside lines.
  CsrLists nearest (const std::vector<Index>& points)
  {
    const std::size_t width = std::min<std::size_t> (
        static_cast<std::size_t> (context_.options.neighbors.k), cutter_.points - 1);
    requireListed (points.size () * width);
    CsrLists lists;
    lists.ids = gather<Index> (neighbors_step_, "ids", points, width);
    lists.offsets.resize (points.size () + 1);
    for (std::size_t i = 0; i <= points.size (); ++i)
      lists.offsets[i] = static_cast<Index> (i * width);
    return lists;
  }

  CsrLists nearestOfAll () { return nearest (all ()); }

private:
  // Calls visit (block, begin, end), the latter two counted in the block, for points that follow each
  // other in one block.
  template <typename Visit>
  void forEachRun (const std::vector<Index>& points, Visit&& visit) const
  {
    std::size_t block = 0;
    for (std::size_t begin = 0, end = 0; begin < points.size (); begin = end) {
      while (points[begin] >= cutter_.last (block))
        ++block;
      const Index from = cutter_.first (block), to = cutter_.last (block);
      for (end = begin + 1;
           end < points.size () && points[end] < to && points[end] == points[end - 1] + 1;)
        ++end;
      visit (block, points[begin] - from, points[end - 1] + 1 - from);
    }
  }

  const StepContext& context_;
  const char* neighbors_step_; // that has found the neighbours of these points
  ArrayFile file_;
  BlockCutter cutter_;
  std::map<std::string, ArrayFile> slices_;
};

} // namespace pcl::floater

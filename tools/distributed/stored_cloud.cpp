// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stored_cloud.h"

namespace pcl::floater {
StoredCloud::StoredCloud (const StepContext& context, const std::vector<Index>& outliers)
    : context_ (context), neighbors_step_ (outliers.empty () ? "neighbors" : "planes"),
      file_ (openArrays (context.store, outliers.empty () ? POINTS : POINTS_LEFT, context.plan)),
      points_ (file_.count ("positions")),
      cutter_{points_, file_.read<Box> ("buckets"), context.plan.blocks,
              [this] (Index first, Index last, std::vector<Eigen::Vector3d>& positions) {
                file_.append ("positions", first, last, positions);
              }}
{
}

ArrayFile&
StoredCloud::slice (const char* step, std::size_t block)
{
  const std::string name = blockFile (step, block);
  const auto known = slices_.find (name);
  return known != slices_.end ()
             ? known->second
             : slices_.emplace (name, openArrays (context_.store, name, context_.plan))
                   .first->second;
}

CsrLists
StoredCloud::gatherLists (const char* step, const std::string& array,
                          const std::vector<Index>& points)
{
  CsrLists all;
  all.offsets.reserve (points.size () + 1);
  all.offsets.push_back (0);
  std::size_t entries = 0; // of whole blocks, which are most if all points are asked for
  forEachRun (points, [&] (std::size_t block, Index begin, Index end) {
    if (end - begin == last (block) - first (block))
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
    its.requireBelow (all.ids, points_, before);
    for (auto offset = offsets.begin () + 1; offset != offsets.end (); ++offset)
      all.offsets.push_back (static_cast<Index> (before) + *offset - offsets.front ());
  });
  return all;
}

CsrLists
StoredCloud::nearest (const std::vector<Index>& points)
{
  const std::size_t width =
      std::min<std::size_t> (static_cast<std::size_t> (context_.options.neighbors.k), points_ - 1);
  requireListed (points.size () * width);
  CsrLists lists;
  lists.ids = gather<Index> (neighbors_step_, "ids", points, width);
  lists.offsets.resize (points.size () + 1);
  for (std::size_t i = 0; i <= points.size (); ++i)
    lists.offsets[i] = static_cast<Index> (i * width);
  return lists;
}

void
writePoints (Store& store, const std::string& name, std::uint64_t plan, const Points& points,
             const std::vector<Index>& gross_outliers)
{
  const std::vector<Box> buckets = BlockCutter::makeBuckets (points.positions);
  store.put (name,
             {{"positions", points.positions},
              {"cloud_index", points.cloud_index},
              {"normals", points.normals},
              {"facing_normals", points.facing_normals},
              {"buckets", buckets},
              {"non_finite", points.non_finite},
              {"duplicates", points.duplicates},
              {"gross_outliers", gross_outliers}},
             plan);
}

Points
readPoints (Store& store, const std::string& name, const Plan& plan,
            std::vector<Index>& gross_outliers)
{
  ArrayFile file = openArrays (store, name, plan);
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

std::vector<Index>
readOutliers (const StepContext& context)
{
  ArrayFile file = openArrays (context.store, OUTLIERS, context.plan);
  std::vector<Index> outliers = file.read<Index> ("outliers");
  file.requireBelow (outliers, context.plan.points);
  file.require (outliers.size () < context.plan.points &&
                std::is_sorted (outliers.begin (), outliers.end (), std::less_equal<> ()));
  return outliers;
}

} // namespace pcl::floater

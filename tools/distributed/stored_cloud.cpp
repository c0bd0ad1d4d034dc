// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stored_cloud.h"

namespace pcl::floater {
ArrayFile&
Slices::file (std::size_t block)
{
  const auto known = files_.find (block);
  if (known != files_.end ())
    return known->second;
  return files_
      .emplace (block, openArrays (context_.store, blockFile (step_, block), context_.plan))
      .first->second;
}

CsrLists
Slices::gatherLists (const std::string& array, const std::vector<Index>& points)
{
  CsrLists all;
  all.offsets.reserve (points.size () + 1);
  all.offsets.push_back (0);
  std::size_t entries = 0; // of whole blocks, which are most if all points are asked for
  ranges_.forEachRun (points, [&] (std::size_t block, Index first, Index last) {
    if (last - first == ranges_.last (block) - ranges_.first (block))
      entries += file (block).count (array);
  });
  all.ids.reserve (entries);
  ranges_.forEachRun (points, [&] (std::size_t block, Index first, Index last) {
    ArrayFile& its = file (block);
    std::vector<Index> offsets;
    its.append (array + ".offsets", first, last + std::size_t{1}, offsets);
    its.require (std::is_sorted (offsets.begin (), offsets.end ()));
    const std::size_t before = all.ids.size ();
    requireListed (before + (offsets.back () - offsets.front ()));
    its.append (array, offsets.front (), offsets.back (), all.ids);
    its.requireBelow (all.ids, ranges_.points (), before);
    for (auto offset = offsets.begin () + 1; offset != offsets.end (); ++offset)
      all.offsets.push_back (static_cast<Index> (before) + *offset - offsets.front ());
  });
  return all;
}

void
writePoints (Store& store, const std::string& name, std::uint64_t plan, const Points& points,
             const std::vector<Index>& gross_outliers, const RunContext& run)
{
  const std::vector<Box> buckets = BlockCutter::makeBuckets (points.positions, run);
  const std::vector<Box> groups = BlockCutter::makeGroups (buckets);
  store.put (name,
             {{"positions", points.positions},
              {"cloud_index", points.cloud_index},
              {"normals", points.normals},
              {"facing_normals", points.facing_normals},
              {"buckets", buckets},
              {"groups", groups},
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

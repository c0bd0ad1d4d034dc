// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stored_cloud.h"

#include <algorithm>

namespace pcl::floater {
void
takeIn (const std::vector<Index>& rows, const CsrLists& lists, StoredCloud& cloud,
        BlockSearch& search)
{
  lookUntilInside (search,
                   [&] (const LocalPoints& local, const std::vector<Eigen::Vector3d>& positions) {
                     for (std::size_t i = 0; i < rows.size (); ++i) {
                       std::vector<Index> missing;
                       for (const Index q : lists.row (i))
                         if ((q < rows.front () || q > rows.back ()) && local.placeOf (q) == NONE)
                           missing.push_back (q);
                       if (missing.empty ())
                         continue;
                       sortUnique (missing);
                       const Eigen::Vector3d& here = positions[local.placeOf (rows[i])];
                       double farthest = 0.0;
                       for (const Eigen::Vector3d& there : cloud.gather (missing))
                         farthest = std::max (farthest, (there - here).norm ());
                       search.watch ().looked (here, farthest);
                     }
                   });
}

BlockRanges
blockRanges (const Plan& plan, std::size_t points)
{
  std::vector<std::size_t> firsts;
  for (std::size_t block = 0; block <= plan.blocks; ++block)
    firsts.push_back (BlockCutter::firstOf (block, plan.blocks, points));
  return BlockRanges (std::move (firsts));
}

const char*
pointsLeft (const std::vector<Index>& outliers)
{
  return outliers.empty () ? POINTS : POINTS_LEFT;
}

void
writePoints (Store& store, const std::string& name, std::uint64_t plan, const Points& points,
             const std::vector<Index>& gross_outliers, const RunContext& run)
{
  ArrayWriter writer;
  const std::vector<Box> buckets = BlockCutter::makeBuckets (points.positions, run);
  addVectors ("positions", points.positions, writer);
  writer.add ("cloud_index", points.cloud_index);
  addVectors ("normals", points.normals, writer);
  addVectors ("facing_normals", points.facing_normals, writer);
  const std::vector<Box> groups = BlockCutter::makeGroups (buckets);
  addBoxes ("buckets", buckets, writer);
  addBoxes ("groups", groups, writer);
  writer.add ("non_finite", points.non_finite);
  writer.add ("duplicates", points.duplicates);
  writer.add ("gross_outliers", gross_outliers);
  store.put (name, writer, plan);
}

Points
readPoints (Store& store, const std::string& name, const Plan& plan,
            std::vector<Index>& gross_outliers)
{
  ArrayFile file = openArrays (store, name, plan);
  Points points;
  points.positions = readVectors<Eigen::Vector3d> (file, "positions");
  points.cloud_index = file.read<Index> ("cloud_index");
  points.normals = readVectors<Eigen::Vector3f> (file, "normals");
  points.facing_normals = readVectors<Eigen::Vector3f> (file, "facing_normals");
  points.non_finite = file.read<Index> ("non_finite");
  points.duplicates = file.read<std::array<Index, 2>> ("duplicates");
  gross_outliers = file.read<Index> ("gross_outliers");
  points.centre = Eigen::Map<const Eigen::Vector3d> (plan.centre.data ());
  points.scale = plan.scale;
  points.lattice_width = plan.lattice_width;
  return points;
}

std::vector<Index>
readOutliers (const StepContext& context)
{
  return openArrays (context.store, OUTLIERS, context.plan).read<Index> ("outliers");
}

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stored_stages.h"

#include "report/report_cloud.h"

namespace pcl::floater {
StoredStages::StoredStages (const StepContext& context)
    : context_ (context), outliers_ (readOutliers (context)),
      ranges_ (blockRanges (context.plan, context.plan.points - outliers_.size ()))
{
}

Slices
StoredStages::slices (const char* step) const
{
  return {context_.store, context_.plan, ranges_, step};
}

Points
StoredStages::points (Report& report)
{
  std::vector<Index> gross_outliers;
  Points points = readPoints (context_.store, POINTS, context_.plan, gross_outliers);
  report.statistics.cloud_points = context_.plan.cloud_size;
  report.statistics.selected_points = context_.plan.selected_points;
  reportGrossOutliers (gross_outliers, report);
  reportPoints (points, report);
  return points;
}

LocalPlanes
StoredStages::planes ()
{
  StoredNeighbors stored (context_, outliers_, ranges_);
  LocalPlanes planes;
  planes.neighbors = stored.all (allPoints ());
  planes.spacing = stored.planes ().gather<float> ("spacing", allPoints ());
  planes.normals = stored.planes ().gather<Eigen::Vector3f> ("normals", allPoints ());
  return planes;
}

std::vector<AreaSample>
StoredStages::areaSamples ()
{
  Slices stars = slices ("stars");
  std::vector<AreaSample> samples;
  for (std::size_t block = 0; block < ranges_.blocks (); ++block)
    if (!ranges_.isEmpty (block))
      stars.file (block).append ("areas", samples);
  return samples;
}

Stars
StoredStages::begunStars ()
{
  Slices stored = slices ("stars");
  Stars stars;
  stars.neighbors = stored.gatherLists ("stars", allPoints ());
  stars.far_neighbors = stored.gatherLists ("far", allPoints ());
  stars.open = stored.gather<std::uint8_t> ("open", allPoints ());
  stars.normals = stored.gather<Eigen::Vector3f> ("normals", allPoints ());
  stars.reach = stored.gather<float> ("reach", allPoints ());
  return stars;
}

} // namespace pcl::floater

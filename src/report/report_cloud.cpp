// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/report_cloud.h"

#include "core/order_statistics.h"
#include "report/findings.h"

namespace pcl::floater {
namespace {
// Share of coinciding points above which a warning is given. Used for the warning only.
constexpr std::size_t MANY_COINCIDE = 100;

// Viewpoint in the frame of the cloud, or the direction to a far sensor.
Vector3d
inCloud (const Points& points, const Viewpoint& viewpoint)
{
  constexpr double ROUNDING = 1e-14; // of the scale: error of moving a position to the box and back
  const Vector3d place = viewpoint.is_far
                             ? viewpoint.place
                             : Vector3d (points.centre + points.scale * viewpoint.place);
  return (place.array ().abs () < ROUNDING * points.scale).select (0.0, place);
}

} // namespace

void
reportPoints (const Points& points, Report& report)
{
  report.non_finite = points.non_finite;
  report.duplicates = points.duplicates;
  report.statistics.non_finite_points = points.non_finite.size ();
  report.statistics.duplicate_points = points.duplicates.size ();
  report.statistics.working_points = points.positions.size ();
  const std::size_t coincident = points.duplicates.size ();
  if (coincident > 0 && MANY_COINCIDE * coincident >= coincident + points.positions.size ())
    addFinding (report, FindingId::COINCIDENT_POINTS, points, {}, coincident,
                points.duplicates.front ()[0], points.duplicates.front ()[1]);
}

void
reportOutliers (const std::vector<Index>& outliers, FindingId what, Report& report)
{
  if (outliers.empty ())
    return;
  addFinding (report, what, {}, {}, outliers.size (),
              *std::min_element (outliers.begin (), outliers.end ()));
  report.outliers.insert (report.outliers.end (), outliers.begin (), outliers.end ());
  std::sort (report.outliers.begin (), report.outliers.end ());
  report.statistics.outlier_points = report.outliers.size ();
}

void
reportStacks (const Points& points, const Stacks& stacks, Report& report)
{
  report.statistics.stacked_points = stacks.points;
  report.statistics.stack_height = stacks.median;
  report.statistics.largest_stack_height = stacks.largest;
  if (stacks.points > 0)
    addFinding (report, FindingId::STACKED_POINTS, points, {stacks.at}, stacks.points,
                100.0 * stacks.points / points.total (), stacks.median, stacks.largest);
}

void
reportScatter (const Points& points, const std::vector<Index>& scatter, bool is_finding,
               Report& report)
{
  report.scatter = valuesAt (points.cloud_index, scatter);
  for (std::size_t i = 0; i < points.stacked.of.size (); ++i)
    if (std::binary_search (scatter.begin (), scatter.end (), points.stacked.of[i]))
      report.scatter.push_back (points.stacked.cloud_index[i]);
  std::sort (report.scatter.begin (), report.scatter.end ());
  report.statistics.scatter_points = report.scatter.size ();
  if (is_finding && !scatter.empty ())
    addFinding (report, FindingId::SCATTER, points, {scatter.front ()}, report.scatter.size (),
                100.0 * report.scatter.size () / points.total ());
}

void
reportNoise (const Noise& noise, bool denoised, Report& report)
{
  report.statistics.noise = noise.median;
  report.statistics.noise_quantile_90 = noise.quantile_90;
  report.statistics.largest_noise = noise.largest;
  report.statistics.projected_points = denoised ? noise.noisy_points : 0;
  report.denoised = denoised;
  if (denoised)
    addFinding (report, FindingId::NOISE, {}, {}, noise.noisy_points, noise.largest, noise.median,
                noise.quantile_90, 100.0 * noise.noisy_points / noise.at_point.size ());
}

void
reportCoordinateGrid (const Points& points, const CoordinateGrid& grid, Report& report)
{
  report.statistics.coordinate_step = grid.spacings;
  if (grid.spacings > 0.0)
    addFinding (report,
                grid.is_single_precision ? FindingId::COORDINATES_IN_FLOAT
                                         : FindingId::COORDINATES_ROUNDED,
                points, {}, grid.axis, grid.step, grid.spacings, points.duplicates.size ());
}

void
reportView (const Points& points, const Viewpoint& viewpoint, const ViewSurface& surface,
            Report& report)
{
  report.is_view = true;
  report.is_far_view = viewpoint.is_far;
  Eigen::Map<Vector3d> (report.viewpoint.data ()) = inCloud (points, viewpoint);
  report.statistics.holes_filled = surface.holes_filled;
  report.statistics.view_steps = surface.steps;
  report.statistics.view_gaps = surface.gaps;
}

void
reportOtherViewpoint (const Points& points, const Viewpoint& other, Report& report)
{
  const Vector3d place = inCloud (points, other);
  addFinding (report, other.is_far ? FindingId::OTHER_DIRECTION : FindingId::OTHER_VIEWPOINT,
              points, {}, place[0], place[1], place[2]);
}

} // namespace pcl::floater

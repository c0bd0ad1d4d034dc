// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud_geometry.h"

#include "core/order_statistics.h"
#include "input/input.h"
#include "local/no_surface.h"
#include "points/outliers.h"
#include "report/findings.h"
#include "report/report_cloud.h"

namespace pcl::floater {
namespace {
// The points that are not on the user's loop. Equal points are represented by one of them.
std::vector<Index>
exceptLoop (std::vector<Index> found, const Points& points, std::vector<Index> loop)
{
  for (Index& index : loop) {
    const auto duplicate = std::lower_bound (points.duplicates.begin (), points.duplicates.end (),
                                             std::array<Index, 2>{index, 0});
    if (duplicate != points.duplicates.end () && (*duplicate)[0] == index)
      index = (*duplicate)[1];
  }
  std::sort (loop.begin (), loop.end ());
  const auto is_given = [&] (Index p) {
    return std::binary_search (loop.begin (), loop.end (), points.cloud_index[p]);
  };
  found.erase (std::remove_if (found.begin (), found.end (), is_given), found.end ());
  return found;
}

} // namespace

std::vector<Index>
outliersOf (const Points& points, const CsrLists& neighbors, const Request& request)
{
  if (!request.options.remove_outliers)
    return {};
  return exceptLoop (findOutliers (points.positions, neighbors, request.run), points,
                     request.options.disc.boundary.loop);
}

Problem
checkCurves (const Points& points, const LocalGeometry& geometry, const Request& request)
{
  const std::optional<double> times =
      findCurves (points.positions, -points.centre / points.scale, geometry,
                  static_cast<std::size_t> (request.options.neighbors.k), request.run);
  if (!times)
    return {};
  const std::string apart =
      *times > 0.0 ? "about " + rounded (*times) + " times as far apart as the points along them"
                   : "too far apart";
  return {RunStatus::DEGENERATE,
          "the points lie along curves, such as profiles of a scanner, " + apart +
              ": for a surface, profiles should be at most 10 times as far apart as their points. "
              "Take more profiles, or fewer points of each (a voxel grid thins them out)"};
}

bool
dropsScatter (const Options& options)
{
  return options.scatter == ScatterPolicy::DROP ||
         (options.scatter == ScatterPolicy::AUTO && !asksForDisc (options));
}

std::vector<Index>
scatterOf (const Points& points, const LocalGeometry& geometry, const Noise& noise,
           const Request& request)
{
  std::vector<Index> scatter =
      findScatter (geometry, noise, request.options.scatter == ScatterPolicy::AUTO, request.run);
  return dropsScatter (request.options)
             ? exceptLoop (std::move (scatter), points, request.options.disc.boundary.loop)
             : scatter;
}

bool
takeScatter (Points& points, const std::vector<Index>& scatter, const Options& options,
             Report& report)
{
  const bool drops = dropsScatter (options) && !scatter.empty ();
  report.scatter = valuesAt (points.cloud_index, scatter);
  for (std::size_t i = 0; i < points.stacked.of.size (); ++i)
    if (std::binary_search (scatter.begin (), scatter.end (), points.stacked.of[i]))
      report.scatter.push_back (points.stacked.cloud_index[i]);
  std::sort (report.scatter.begin (), report.scatter.end ());
  report.statistics.scatter_points = report.scatter.size ();
  if (drops && options.scatter == ScatterPolicy::AUTO) // not asked for
    addFinding (report, FindingId::SCATTER, points, {scatter.front ()}, report.scatter.size (),
                100.0 * static_cast<double> (report.scatter.size ()) /
                    static_cast<double> (points.total ()));
  if (drops) {
    removePoints (points, scatter);
    report.statistics.working_points = points.total ();
  }
  return drops;
}

StarSettings
starSettings (const Request& request)
{
  const Options& options = request.options;
  StarSettings settings;
  settings.filter_sheets = options.filter_sheets;
  settings.with_offsets = asksForDisc (options);
  settings.reach_beyond = !asksForDisc (options) && !isInBalls (options.neighbors.kind);
  settings.planes_of_all = options.disc.as_published;
  return settings;
}

LocalPlanes
searchPlanes (const Points& points, const NeighborSettings& settings, const Request& request)
{
  const RunContext& run = request.run;
  run.beginStage (Stage::NEIGHBORS);
  std::optional<KdTree> tree; // searched again for the stars of a surface
  CsrLists neighbors =
      findNeighbors (points, settings, run, asksForDisc (request.options) ? nullptr : &tree);
  run.beginStage (Stage::STARS);
  return beginPlanes (points, std::move (neighbors), std::move (tree), starSettings (request), run);
}

LocalGeometry
projectNoise (Points& points, LocalGeometry geometry, Noise& noise,
              const NeighborSettings& settings, const Request& request)
{
  const RunContext& run = request.run;
  points.projected = projectNoisyPoints (points.positions, geometry.neighbors, noise, run);
  const StarSettings stars = starSettings (request);
  LocalPlanes planes =
      fitLocalPlanes (points, searchPlanes (points, settings, request), stars, run);
  LocalGeometry projected = makeLocalGeometry (points, std::move (planes), stars, run);
  keepExplained (projected.neighbors, starAgreement (geometry.stars, run),
                 starAgreement (projected.stars, run), noise);
  if (noise.noisy_points == 0) {
    points.projected.clear ();
    return geometry;
  }
  std::vector<Index> taken_back;
  for (Index p = 0; p < points.size (); ++p)
    if (noise.at_point[p] <= 0.0F && points.projected[p] != points.positions[p]) {
      points.projected[p] = points.positions[p];
      taken_back.push_back (p);
    }
  if (!taken_back.empty ())
    copyRows (geometry, taken_back, projected);
  return projected;
}

FacingHints
facingHints (const Points& points, const Request& request)
{
  FacingHints hints;
  hints.wanted = request.options.facing;
  if (!points.facing_normals.empty () &&
      (hints.wanted == Facing::AUTO || hints.wanted == Facing::NORMALS))
    hints.normals = &points.facing_normals;
  const bool may_be_seen =
      request.options.view.use != ViewUse::NEVER || hints.wanted == Facing::VIEWPOINT;
  if (may_be_seen && isSensorKnown (request.sensor_origin))
    hints.sensor = points.fromCloud (request.sensor_origin);
  return hints;
}

} // namespace pcl::floater

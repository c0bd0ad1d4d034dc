// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud_geometry.h"

#include "input/input.h"
#include "points/noise.h"
#include "points/outliers.h"
#include "report/report_cloud.h"

#include <algorithm>
#include <array>
#include <utility>

namespace pcl::floater {
namespace {
// Points of a given loop, ascending. Equal points are represented by one of them.
std::vector<Index>
pointsOfLoop (const Points& points, std::vector<Index> loop)
{
  for (Index& index : loop) {
    const auto duplicate = std::lower_bound (points.duplicates.begin (), points.duplicates.end (),
                                             std::array<Index, 2>{index, 0});
    if (duplicate != points.duplicates.end () && (*duplicate)[0] == index)
      index = (*duplicate)[1];
  }
  std::sort (loop.begin (), loop.end ());
  return loop;
}

// The points that are not on the user's loop.
std::vector<Index>
exceptLoop (std::vector<Index> found, const Points& points, const std::vector<Index>& loop)
{
  const std::vector<Index> given = pointsOfLoop (points, loop);
  const auto is_given = [&] (Index p) {
    return std::binary_search (given.begin (), given.end (), points.cloud_index[p]);
  };
  found.erase (std::remove_if (found.begin (), found.end (), is_given), found.end ());
  return found;
}

} // namespace

NeighborSettings
neighborSettings (const Options& options, NeighborSearch* search)
{
  // Blocks save no memory here: the solver of a disc needs far more.
  return {options.neighbors, asksForDisc (options) ? 1 : options.blocks, search};
}

void
removeOutliers (Points& points, CsrLists& neighbors, const NeighborSettings& settings,
                const Request& request, Report& report)
{
  const std::vector<Index> outliers =
      exceptLoop (findOutliers (points.positions, neighbors, request.run, request.limits.outliers),
                  points, request.options.disc.boundary.loop);
  if (outliers.empty ())
    return;
  removeOutliers (points, outliers, report);
  neighbors = renewNeighbors (points, outliers, neighbors, settings, request.run);
}

void
removeOutliers (Points& points, const std::vector<Index>& outliers, Report& report)
{
  if (outliers.empty ())
    return;
  const std::vector<Index> cloud_indices = removePoints (points, outliers);
  reportOutliers (cloud_indices, points.size (), report);
}

Noise
measureNoiseAndScatter (Points& points, LocalPlanes& planes, const NeighborTable& neighbors,
                        const NeighborSettings& settings, const Request& request,
                        const NoiseProbes* known, Report& report)
{
  const Options& options = request.options;
  const Limits& limits = request.limits;
  const RunContext& run = request.run;
  const bool drops_scatter = options.scatter == ScatterPolicy::DROP;
  if (!options.denoise && !drops_scatter)
    return {};
  Noise noise = measureNoise (points.positions, neighbors, limits.noise, run, known);
  if (drops_scatter)
    noise.scatter = exceptLoop (std::move (noise.scatter), points, options.disc.boundary.loop);
  reportScatter (points, noise.scatter, report);
  if (drops_scatter && !noise.scatter.empty ()) {
    removePoints (points, noise.scatter);
    report.statistics.working_points = points.size ();
    if (checkPoints (points))
      return {}; // the caller reports the problem
    std::optional<KdTree> tree;
    CsrLists of_rest =
        findNeighbors (points, settings, run, asksForDisc (options) ? nullptr : &tree);
    planes = fitLocalPlanes (points, std::move (of_rest), std::move (tree), starSettings (request),
                             run, limits.planes);
    if (options.denoise)
      noise = measureNoise (points.positions, planes.neighbors, limits.noise, run);
    noise.scatter.clear (); // all scatter has been removed
  }
  return options.denoise ? noise : Noise{};
}

StarSettings
starSettings (const Request& request)
{
  const Options& options = request.options;
  StarSettings settings;
  settings.filter_sheets = options.filter_sheets;
  settings.with_offsets = asksForDisc (options);
  const Neighborhood kind = options.neighbors.kind;
  settings.reach_beyond =
      !asksForDisc (options) && kind != Neighborhood::BALL && kind != Neighborhood::BALL_DELAUNAY;
  settings.limits = request.limits.sheets;
  settings.reach = request.limits.reach;
  return settings;
}

LocalGeometry
projectNoise (Points& points, CsrLists neighbors, const Noise& noise,
              const NeighborSettings& settings, const Request& request)
{
  const Limits& limits = request.limits;
  const RunContext& run = request.run;
  points.projected = projectNoisyPoints (points.positions, neighbors, noise, limits.noise, run);
  neighbors = {};
  run.beginStage (Stage::NEIGHBORS);
  std::optional<KdTree> tree;
  neighbors = findNeighbors (points, settings, run, &tree);
  run.beginStage (Stage::STARS);
  const StarSettings stars = starSettings (request);
  return makeLocalGeometry (
      points,
      fitLocalPlanes (points, std::move (neighbors), std::move (tree), stars, run, limits.planes),
      stars, run);
}

FacingHints
facingHints (const Points& points, const Request& request)
{
  const Eigen::Map<const Eigen::Vector3d> sensor (request.sensor_origin.data ());
  FacingHints hints;
  hints.wanted = request.options.facing;
  if (!points.facing_normals.empty () &&
      (hints.wanted == Facing::AUTO || hints.wanted == Facing::NORMALS))
    hints.normals = &points.facing_normals;
  const bool may_be_seen =
      request.options.view.use != ViewUse::NEVER || hints.wanted == Facing::VIEWPOINT;
  if (may_be_seen && isSensorKnown (request.sensor_origin))
    hints.sensor = (sensor - points.centre) / points.scale;
  return hints;
}

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "disc_stages.h"

#include "core/run_context.h"
#include "floater/domain.h"
#include "floater/reachability.h"
#include "floater/weights.h"
#include "points/neighbors.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace pcl
{
namespace floater
{
DiscStages
runStages (const std::string& name, const Cloud& cloud, const Options& options)
{
  DiscStages disc;
  disc.name = name;
  std::vector<Index> cloud_index (cloud.size ());
  std::iota (cloud_index.begin (), cloud_index.end (), Index{0});

  RunMonitor monitor ({}, disc.statistics);
  const RunContext run (options.threads, &monitor);
  run.beginStage (Stage::WORKING_SET);
  disc.points = makePoints (cloud.positions (), cloud_index, run);
  run.beginStage (Stage::NEIGHBORS);
  CsrLists neighbors = findNeighbors (disc.points, {options.neighbors, 1, nullptr}, run);
  run.beginStage (Stage::STARS);
  StarSettings star_settings;
  star_settings.filter_sheets = options.filter_sheets;
  disc.geometry = makeLocalGeometry (disc.points, std::move (neighbors), star_settings, run);
  run.beginStage (Stage::BOUNDARY);
  disc.boundary = findBoundary (disc.points, disc.geometry, options.disc.boundary, run);
  checkBoundary (disc.points, disc.geometry.spacing, false, disc.boundary);
  if (disc.boundary.problem)
    throw std::runtime_error (name + ": " + disc.boundary.problem.message);
  run.beginStage (Stage::WEIGHTS);
  const Stars stars = std::move (disc.geometry.stars);
  const std::vector<double> weights = computeWeights (stars, options.disc.weighting, run);
  // Points that the library would link back to the loop are left out here: with no candidates for
  // links, reachable is what the stars themselves reach.
  CsrLists no_links;
  no_links.offsets.assign (disc.points.size () + 1, 0);
  const std::vector<Index>& loop = disc.boundary.loop;
  const Reachability reach =
      reachLoop (stars.neighbors, no_links, disc.points.positions, loop, run);
  disc.left_out = static_cast<std::size_t> (
      std::count (reach.reachable.begin (), reach.reachable.end (), std::uint8_t{0}));
  disc.loop_uv = layLoop (disc.points.positions, loop, options.disc.domain);
  disc.system = assembleSystem (stars.neighbors, weights, loop, disc.loop_uv, reach.reachable, run);
  monitor.stopClock ();
  disc.geometry.stars = {};
  disc.geometry.stars.normals = stars.normals;
  return disc;
}

std::vector<Eigen::Vector2d>
parametersOf (const DiscStages& disc, const std::vector<Eigen::Vector2d>& solution)
{
  std::vector<Eigen::Vector2d> uv (
      disc.points.size (), Eigen::Vector2d::Constant (std::numeric_limits<double>::quiet_NaN ()));
  for (std::size_t i = 0; i < disc.boundary.loop.size (); ++i)
    uv[disc.boundary.loop[i]] = disc.loop_uv[i];
  for (std::size_t i = 0; i < disc.system.unknowns (); ++i)
    uv[disc.system.point_of_unknown[i]] = solution[i];
  return uv;
}

std::vector<int>
fileOrder (const DiscStages& disc)
{
  const auto placeInFile = [&disc] (int unknown) {
    const Index point = disc.system.point_of_unknown[static_cast<std::size_t> (unknown)];
    return disc.points.cloud_index[point];
  };
  std::vector<int> order (disc.system.unknowns ());
  std::iota (order.begin (), order.end (), 0);
  std::sort (order.begin (), order.end (),
             [&] (int a, int b) { return placeInFile (a) < placeInFile (b); });
  return order;
}

} // namespace floater
} // namespace pcl

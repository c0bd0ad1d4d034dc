// SPDX-License-Identifier: GPL-3.0-or-later
#include "disc.h"

#include "core/run_context.h"
#include "points/nearest_neighbors.h"
#include "local/stars.h"
#include "local/tangent_planes.h"
#include "points/points.h"
#include "floater/domain.h"
#include "floater/reachability.h"
#include "floater/weights.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace pcl
{
namespace floater
{
Disc
makeDisc (const std::string& name, const Cloud& cloud, const Options& options)
{
  Disc disc;
  disc.name = name;
  std::vector<Index> cloud_index (cloud.size ());
  std::iota (cloud_index.begin (), cloud_index.end (), Index{0});

  StageClock clock (disc.statistics, options.stage_callback);
  clock.start (Stage::WORKING_SET);
  disc.set = makePoints (cloud.positions (), cloud_index, options.threads);
  clock.start (Stage::NEIGHBORS);
  disc.near = findNearestNeighbors (disc.set, options.neighbors.k, nullptr, options.threads);
  clock.start (Stage::STARS);
  Stars stars = makeStars (disc.points.positions, disc.near,
                           fitTangentPlanes (disc.points.positions, disc.near, options.threads),
                           options.filter_sheets, options.threads);
  clock.start (Stage::BOUNDARY);
  disc.boundary = findBoundary (disc.set, disc.near, stars, options);
  if (disc.boundary.problem)
    throw std::runtime_error (name + ": " + disc.boundary.problem.message);
  clock.start (Stage::WEIGHTS);
  const std::vector<double> weights = computeWeights (stars, options.weighting, options.threads);
  // Points that the library would link back to the loop are left out here: with no candidates for
  // links, reachable is what the stars themselves reach.
  CsrLists no_links;
  no_links.offsets.assign (disc.points.positions.size () + 1, 0);
  const Reachability reach =
      reachLoop (stars.neighbors, no_links, disc.points.positions, disc.boundary.loop);
  disc.left_out = static_cast<std::size_t> (
      std::count (reach.reachable.begin (), reach.reachable.end (), std::uint8_t{0}));
  disc.loop_uv = layLoop (disc.points.positions, disc.boundary.loop, options.domain.curve,
                          options.domain.polygon_sides, options.domain.loop_spacing);
  disc.system = assembleSystem (stars.neighbors, weights, disc.boundary.loop, disc.loop_uv,
                                reach.reachable, options.threads);
  clock.stop ();
  disc.normals = std::move (stars.normals);
  return disc;
}

std::vector<Eigen::Vector2d>
parametersOf (const Disc& disc, const std::vector<Eigen::Vector2d>& solution)
{
  std::vector<Eigen::Vector2d> uv (
      disc.points.positions.size (),
      Eigen::Vector2d::Constant (std::numeric_limits<double>::quiet_NaN ()));
  for (std::size_t i = 0; i < disc.boundary.loop.size (); ++i)
    uv[disc.boundary.loop[i]] = disc.loop_uv[i];
  for (std::size_t i = 0; i < disc.system.unknowns (); ++i)
    uv[disc.system.point_of_unknown[i]] = solution[i];
  return uv;
}

std::vector<int>
fileOrder (const Disc& disc)
{
  const auto placeInFile = [&disc] (int unknown) {
    return disc.points.cloud_index[disc.system.point_of_unknown[static_cast<std::size_t> (unknown)]];
  };
  std::vector<int> order (disc.system.unknowns ());
  std::iota (order.begin (), order.end (), 0);
  std::sort (order.begin (), order.end (),
             [&] (int a, int b) { return placeInFile (a) < placeInFile (b); });
  return order;
}

} // namespace floater
} // namespace pcl

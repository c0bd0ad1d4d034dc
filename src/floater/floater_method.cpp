// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/floater_method.h"

#include "core/order_statistics.h"
#include "floater/domain.h"
#include "floater/planar_delaunay.h"
#include "floater/weights.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace pcl::floater {
std::vector<std::uint8_t>
reachLoop (const CsrLists& neighbors, const std::vector<Index>& loop, const RunContext& run)
{
  std::vector<std::uint8_t> reachable (neighbors.rows (), 0);
  for (const Index p : loop)
    reachable[p] = 1;
  const CsrLists leading_to = makeCsrLists (neighbors.rows (), [&] (const auto& emit) {
    for (Index p = 0; p < neighbors.rows (); ++p)
      for (const Index q : neighbors.row (p))
        if (reachable[p] == 0)
          emit (q, p);
  });
  std::vector<Index> queue = loop;
  ProgressLoop progress (run);
  for (std::size_t head = 0; head < queue.size (); ++head) {
    progress.next ();
    for (const Index p : leading_to.row (queue[head]))
      if (reachable[p] == 0) {
        reachable[p] = 1;
        queue.push_back (p);
      }
  }
  return reachable;
}

Parameterization
parameterize (const std::vector<Eigen::Vector3d>& positions, Stars stars,
              const std::vector<Index>& loop, const DiscOptions& options, const RunContext& run,
              const DiscLimits& limits)
{
  Parameterization result;
  run.beginStage (Stage::WEIGHTS);
  std::vector<double> weights = computeWeights (stars, options.weighting, run);
  CsrLists neighbors = std::move (stars.neighbors);
  stars = {};

  const std::vector<std::uint8_t> reachable = reachLoop (neighbors, loop, run);
  const auto unreachable =
      static_cast<std::size_t> (std::count (reachable.begin (), reachable.end (), 0));
  const double reached = static_cast<double> (positions.size () - unreachable);
  if (reached < limits.least_reached_share * static_cast<double> (positions.size ())) {
    result.problem = {
        RunStatus::UNREACHABLE,
        std::to_string (unreachable) + " of " + std::to_string (positions.size ()) +
            " points do not connect to the boundary loop: the cloud has several components, or "
            "gaps much wider than its spacing; reconstruct its components one by one, or use "
            "more neighbours"};
    return result;
  }
  const std::vector<Eigen::Vector2d> loop_uv = layLoop (positions, loop, options.domain);
  LinearSystem system = assembleSystem (neighbors, weights, loop, loop_uv, reachable);
  neighbors = {};
  std::vector<double> ().swap (weights);
  result.unknowns = system.unknowns ();
  result.nonzeros = system.nonzeros ();

  run.beginStage (Stage::SOLVE);
  result.solution = solve (system, options.solver, run);
  const Eigen::MatrixX2d solved = std::move (result.solution.uv);
  result.problem = result.solution.problem;
  if (result.problem)
    return result;

  result.uv.assign (positions.size (),
                    Eigen::Vector2d::Constant (std::numeric_limits<double>::quiet_NaN ()));
  for (std::size_t i = 0; i < loop.size (); ++i)
    result.uv[loop[i]] = loop_uv[i];
  for (std::size_t i = 0; i < system.unknowns (); ++i)
    result.uv[system.point_of_unknown[i]] = solved.row (static_cast<Eigen::Index> (i));
  return result;
}

// The stages of TW 385 in order, with its sections and equations.

Disc
makeDisc (const Points& points, LocalGeometry& geometry, Boundary boundary,
          const DiscSettings& settings, const RunContext& run)
{
  Disc disc;
  disc.boundary = std::move (boundary);
  disc.problem = disc.boundary.problem;
  if (disc.problem)
    return disc;
  const std::vector<Eigen::Vector3d>& positions = points.workingPositions ();
  const std::vector<Index>& loop = disc.boundary.loop;

  // Section 2.1: the weights may be for all neighbours; the boundary needed Delaunay stars.
  run.beginStage (Stage::WEIGHTS);
  StarSettings star_settings = settings.stars;
  const DiscOptions& options = settings.options.disc;
  const Neighborhood neighborhood = settings.options.neighbors.kind;
  if (neighborhood == Neighborhood::NEAREST || neighborhood == Neighborhood::BALL) {
    star_settings.kind = StarKind::ALL;
    geometry.stars = makeStars (positions, geometry.neighbors, geometry.stars.normals,
                                Rows::all (positions.size ()), star_settings, run);
  }

  // Section 4, equations (1) to (3): weights, the loop on a convex curve, the linear system.
  // The normals are needed longer than the stars.
  std::vector<Eigen::Vector3f> normals = geometry.stars.normals;
  disc.parameterization =
      parameterize (positions, std::move (geometry.stars), loop, options, run, settings.limits);
  geometry.stars = {};
  geometry.stars.normals = std::move (normals);
  disc.problem = disc.parameterization.problem;
  if (disc.problem)
    return disc;

  // Section 2: the triangles of the parameters are the triangles in space.
  run.beginStage (Stage::DELAUNAY);
  const std::vector<Eigen::Vector2d>& uv = disc.parameterization.uv;
  disc.mesh = triangulatePlane (uv, loop);

  // Beyond TW 385: points without a triangle, such as coinciding parameters, are inserted, and
  // edges are flipped in space.
  run.beginStage (Stage::FLIPS);
  FinishSettings finish;
  finish.flip_edges = settings.options.flip_edges;
  finish.largest_fold_share = settings.limits.largest_fold_share;
  finish.limits = settings.finish;
  finish.facing = settings.facing;
  finish.insert_points = !options.as_published;
  finish.repair = finish.flip_edges && settings.options.remove_self_intersections;
  disc.finish = finishMesh (disc.mesh, points.positions, geometry, finish, run);
  if (!disc.finish.is_repairable)
    disc.problem = {
        RunStatus::NOT_A_DISC,
        std::to_string (disc.finish.folds) + " of " +
            std::to_string (disc.mesh.triangles.size () * 3 / 2) +
            " edges are folded: the surface is not one disc with one boundary (it may be closed, "
            "have handles or several components, be sampled too thinly, or have a finger longer "
            "than 35 of its radii); let the topology be chosen automatically, or reconstruct a "
            "part of the surface"};
  return disc;
}

} // namespace pcl::floater

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
namespace {
// The reversed lists: row q holds the points p, ascending, whose row holds q. Only entries for
// which use (p, q) is true.
template <typename Use>
CsrLists
reverse (const CsrLists& lists, Use&& use)
{
  return makeCsrLists (lists.rows (), [&] (const auto& emit) {
    for (std::size_t p = 0; p < lists.rows (); ++p)
      for (const Index q : lists.row (p))
        if (use (p, q))
          emit (q, static_cast<Index> (p));
  });
}

// Marks and appends all points that lead to the entries of the queue from `head` on.
void
search (const CsrLists& leading_to, std::vector<Index>& queue, std::size_t head,
        std::vector<std::uint8_t>& reachable, const RunContext& run)
{
  ProgressLoop progress (run);
  for (; head < queue.size (); ++head) {
    progress.next ();
    for (const Index p : leading_to.row (queue[head]))
      if (reachable[p] == 0) {
        reachable[p] = 1;
        queue.push_back (p);
      }
  }
}

} // namespace

Reachability
reachLoop (const CsrLists& neighbors, const CsrLists& nearest,
           const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop,
           const RunContext& run, const DiscLimits& limits)
{
  Reachability result;
  std::vector<std::uint8_t>& reachable = result.reachable;
  reachable.assign (positions.size (), 0);
  std::vector<Index> queue;
  queue.reserve (positions.size ());
  for (const Index p : loop)
    if (reachable[p] == 0) {
      reachable[p] = 1;
      queue.push_back (p);
    }
  const CsrLists leading_to =
      reverse (neighbors, [&] (std::size_t p, Index) { return reachable[p] == 0; });
  search (leading_to, queue, 0, reachable, run);
  if (queue.size () == positions.size ())
    return result;

  // Most entries are between two reached points, and are not needed.
  const CsrLists nearest_of = reverse (
      nearest, [&] (std::size_t p, Index q) { return reachable[p] == 0 || reachable[q] == 0; });
  std::vector<std::uint8_t> waiting (positions.size (), 0); // listed for linking
  std::vector<Index> round;
  std::vector<std::pair<double, Index>> candidates;
  for (std::size_t head = 0; head < queue.size ();) {
    // Unreached points next to a point that was reached since the last round.
    round.clear ();
    for (; head < queue.size (); ++head)
      for (const Row row : {nearest.row (queue[head]), nearest_of.row (queue[head])})
        for (const Index p : row)
          if (reachable[p] == 0 && waiting[p] == 0) {
            waiting[p] = 1;
            round.push_back (p);
          }
    // Each is linked to the nearest reached points. Ties go to the smaller point.
    for (const Index p : round) {
      candidates.clear ();
      for (const Row row : {nearest.row (p), nearest_of.row (p)})
        for (const Index q : row)
          if (reachable[q] != 0)
            candidates.emplace_back ((positions[q] - positions[p]).squaredNorm (), q);
      sortUnique (candidates);
      for (std::size_t i = 0; i < std::min (candidates.size (), limits.links_per_point); ++i)
        result.links.push_back ({p, candidates[i].second});
    }
    for (const Index p : round)
      reachable[p] = 1;
    queue.insert (queue.end (), round.begin (), round.end ());
    result.linked_points += round.size ();
    search (leading_to, queue, head, reachable, run);
  }
  std::sort (result.links.begin (), result.links.end ());
  return result;
}

namespace {
// Adds each link as one more neighbour, with the weight of an average neighbour.
// \param links (point, neighbour), ascending
void
addLinks (const std::vector<std::array<Index, 2>>& links, CsrLists& neighbors,
          std::vector<double>& weights)
{
  if (links.empty ())
    return;
  CsrLists wider;
  std::vector<double> wider_weights;
  wider.offsets.push_back (0);
  auto link = links.begin ();
  for (Index p = 0; p < neighbors.rows (); ++p) {
    const Index first = neighbors.offsets[p], last = neighbors.offsets[p + 1];
    wider.ids.insert (wider.ids.end (), neighbors.ids.begin () + first,
                      neighbors.ids.begin () + last);
    wider_weights.insert (wider_weights.end (), weights.begin () + first, weights.begin () + last);
    for (; link != links.end () && (*link)[0] == p; ++link) {
      wider.ids.push_back ((*link)[1]);
      wider_weights.push_back (1.0 / std::max<double> (1.0, last - first));
    }
    wider.offsets.push_back (static_cast<Index> (wider.ids.size ()));
  }
  neighbors = std::move (wider);
  weights = std::move (wider_weights);
}

} // namespace

Parameterization
parameterize (const std::vector<Eigen::Vector3d>& positions, const CsrLists& nearest, Stars stars,
              const std::vector<Index>& loop, const DiscOptions& options, const RunContext& run,
              const DiscLimits& limits)
{
  Parameterization result;
  run.beginStage (Stage::WEIGHTS);
  std::vector<double> weights = computeWeights (stars, options.weighting, run);
  CsrLists neighbors = std::move (stars.neighbors);
  stars = {};

  CsrLists no_links; // TW 385 has none
  no_links.offsets.assign (positions.size () + 1, 0);
  const Reachability reach = reachLoop (neighbors, options.as_published ? no_links : nearest,
                                        positions, loop, run, limits);
  addLinks (reach.links, neighbors, weights);
  result.relinked = reach.linked_points;
  result.unreachable =
      static_cast<std::size_t> (std::count (reach.reachable.begin (), reach.reachable.end (), 0));
  const double reached = static_cast<double> (positions.size () - result.unreachable);
  if (reached < limits.least_reached_share * static_cast<double> (positions.size ())) {
    result.problem = {
        RunStatus::UNREACHABLE,
        std::to_string (result.unreachable) + " of " + std::to_string (positions.size ()) +
            " points do not connect to the boundary loop: the cloud has several components, or "
            "gaps much wider than its spacing; reconstruct its components one by one, or use "
            "more neighbours"};
    return result;
  }
  const std::vector<Eigen::Vector2d> loop_uv = layLoop (positions, loop, options.domain);
  LinearSystem system = assembleSystem (neighbors, weights, loop, loop_uv, reach.reachable);
  neighbors = {};
  std::vector<double> ().swap (weights);
  result.unknowns = system.unknowns ();
  result.nonzeros = system.nonzeros ();

  run.beginStage (Stage::SOLVE);
  Solution solution = solve (system, options.solver, run);
  result.problem = solution.problem;
  const Eigen::MatrixX2d solved = std::move (solution.uv);
  result.solution = std::move (solution);
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
  disc.parameterization = parameterize (positions, geometry.neighbors, std::move (geometry.stars),
                                        loop, options, run, settings.limits);
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
            "than "
            "35 of its radii); let the topology be chosen automatically, or reconstruct a part of "
            "the surface"};
  return disc;
}

} // namespace pcl::floater

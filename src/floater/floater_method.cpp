// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/floater_method.h"

#include "floater/planar_delaunay.h"
#include "floater/weights.h"

namespace pcl::floater {
namespace {
// Two steps g and h on a curve of curvature c turn left by an area of c g h / 2. To survive
// rounding, it must be well above the distance of doubles near 1, which is 2e-16. With these two
// values it is 8e-15 or more.
constexpr double SHORTEST_STEP = 4e-6;
constexpr double SIDE_CURVATURE = 1e-3;

// Smallest share of all points connected with the boundary loop; below, the cloud counts as several
// components. Not derived from data, and not certain.
constexpr double LEAST_REACHED_SHARE = 0.5;

// Share of all edges: if more are folded after the flips, the surface is no disc. On 24 clouds, discs
// had up to 0.01 and closed surfaces that were laid out as discs 0.04 or more.
constexpr double LARGEST_FOLD_SHARE = 0.03;

// Places the points first to last - 1 of the loop, which may go on at its beginning, on a curve whose
// end is point `last`.
// \param chords       chords[i] is the step from loop point i to the next one
// \param curve_length in the plane
// \return fractions of the curve, ascending from 0
std::vector<double>
placeOnCurve (const std::vector<double>& chords, std::size_t first, std::size_t last,
              double curve_length)
{
  double total = 0.0;
  for (std::size_t i = first; i < last; ++i)
    total += chords[i % chords.size ()];
  const std::size_t steps = last - first;
  const double shortest =
      std::min (SHORTEST_STEP / curve_length, 0.5 / static_cast<double> (steps));
  std::vector<double> fractions (steps);
  double sum = 0.0;
  for (std::size_t i = 0; i < steps; ++i) {
    fractions[i] = sum;
    sum += total > 0.0 ? std::max (chords[(first + i) % chords.size ()] / total, shortest) : 1.0;
  }
  for (double& fraction : fractions)
    fraction /= sum;
  return fractions;
}

// Indices in the loop of the corners, ascending from 0, each as near as possible to its share of
// the loop's length.
std::vector<std::size_t>
cornerPoints (const std::vector<double>& chords, std::size_t corners)
{
  const double total = std::accumulate (chords.begin (), chords.end (), 0.0);
  std::vector<std::size_t> points{0};
  std::size_t i = 0;
  double length = 0.0; // from point 0 to point i
  for (std::size_t corner = 1; corner < corners; ++corner) {
    const double wanted = total * static_cast<double> (corner) / static_cast<double> (corners);
    const std::size_t last =
        chords.size () - (corners - corner); // leaves a point for each later corner
    while (i < last && (i <= points.back () || length + 0.5 * chords[i] < wanted))
      length += chords[i++];
    points.push_back (i);
  }
  return points;
}

// Makes weights, lays the loop on a convex curve, and assembles and solves the linear system (TW 385,
// equations (1) to (3)): the parameters of a disc with a boundary. Stages WEIGHTS and SOLVE.
// \param stars with their offsets; all but their normals are freed as soon as there are weights
void
parameterize (const Positions& positions, Stars& stars, const DiscOptions& options,
              const RunContext& run, Disc& disc)
{
  const std::vector<Index>& loop = disc.boundary.loop;
  run.beginStage (Stage::WEIGHTS);
  std::vector<double> weights = computeWeights (stars, options.weighting, run);
  CsrLists neighbors = std::move (stars.neighbors);
  Normals normals = std::move (stars.normals);
  stars = {};
  stars.normals = std::move (normals);

  const Flags reachable = reachLoop (neighbors, loop, run);
  const auto unreachable =
      static_cast<std::size_t> (std::count (reachable.begin (), reachable.end (), 0));
  const double reached = static_cast<double> (positions.size () - unreachable);
  if (reached < LEAST_REACHED_SHARE * static_cast<double> (positions.size ())) {
    disc.problem = {
        RunStatus::UNREACHABLE,
        std::to_string (unreachable) + " of " + std::to_string (positions.size ()) +
            " points do not connect to the boundary loop: the cloud has several components, or "
            "gaps much wider than its spacing; reconstruct its components one by one, or use "
            "more neighbours"};
    return;
  }
  const std::vector<Vector2d> loop_uv = layLoop (positions, loop, options.domain);
  const LinearSystem system = assembleSystem (neighbors, weights, loop, loop_uv, reachable);
  neighbors = {};
  std::vector<double> ().swap (weights);

  run.beginStage (Stage::SOLVE);
  Solution solution = solve (system, options.solver, run);
  disc.figures = solution;
  disc.problem = std::move (solution.problem);
  if (disc.problem)
    return;
  disc.uv.assign (positions.size (),
                  Vector2d::Constant (std::numeric_limits<double>::quiet_NaN ()));
  for (std::size_t i = 0; i < loop.size (); ++i)
    disc.uv[loop[i]] = loop_uv[i];
  for (std::size_t i = 0; i < system.unknowns (); ++i)
    disc.uv[system.point_of_unknown[i]] = solution.uv.row (static_cast<Eigen::Index> (i));
}

} // namespace

std::vector<Vector2d>
layLoop (const Positions& positions, const std::vector<Index>& loop, const DomainOptions& options)
{
  const std::size_t count = loop.size ();
  std::vector<double> chords (count);
  for (std::size_t i = 0; i < count; ++i) {
    const double step = (positions[loop[i + 1 == count ? 0 : i + 1]] - positions[loop[i]]).norm ();
    chords[i] = options.loop_spacing == LoopSpacing::UNIFORM       ? 1.0
                : options.loop_spacing == LoopSpacing::CENTRIPETAL ? std::sqrt (step)
                                                                   : step;
  }
  std::vector<Vector2d> places; // on the unit circle: of the points, or of the corners
  const auto addPlace = [&places] (double angle) {
    places.emplace_back (std::cos (angle), std::sin (angle));
  };
  if (options.curve == Domain::CIRCLE) {
    for (const double fraction : placeOnCurve (chords, 0, count, 2.0 * PI))
      addPlace (2.0 * PI * fraction);
    return places;
  }
  const int sides = options.curve == Domain::SQUARE ? 4 : std::max (3, options.polygon_sides);
  const std::size_t corners = std::min (count, static_cast<std::size_t> (sides));
  for (std::size_t c = 0; c < corners; ++c)
    addPlace (2.0 * PI * (static_cast<double> (c) - 0.5) / static_cast<double> (corners) -
              0.5 * PI);
  const std::vector<std::size_t> corner_points = cornerPoints (chords, corners);
  std::vector<Vector2d> uv (count);
  for (std::size_t c = 0; c < corners; ++c) {
    const std::size_t next = c + 1 == corners ? 0 : c + 1;
    const Vector2d& from = places[c];
    const Vector2d side = places[next] - from;
    // The side is a parabola through both corners. Its slope is far smaller than their turns.
    const Vector2d bulge = 0.5 * SIDE_CURVATURE * side.norm () * Vector2d (side.y (), -side.x ());
    std::size_t at = corner_points[c];
    const std::size_t end = corner_points[next] + (next == 0 ? count : 0);
    for (const double t : placeOnCurve (chords, at, end, side.norm ()))
      uv[at++ % count] = from + t * side + t * (1.0 - t) * bulge;
  }
  return uv;
}

Flags
reachLoop (const CsrLists& neighbors, const std::vector<Index>& loop, const RunContext& run)
{
  Flags reachable (neighbors.rows (), 0);
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

Disc
makeDisc (const Points& points, LocalGeometry& geometry, Boundary boundary, const Options& options,
          FinishSettings finish, const RunContext& run)
{
  Disc disc;
  disc.boundary = std::move (boundary);
  disc.problem = disc.boundary.problem;
  if (disc.problem)
    return disc;
  const Positions& positions = points.workingPositions ();

  // Section 2.1: the weights may be for all neighbours; the boundary needed Delaunay stars.
  run.beginStage (Stage::WEIGHTS);
  const Neighborhood neighborhood = options.neighbors.kind;
  if (neighborhood == Neighborhood::NEAREST || neighborhood == Neighborhood::BALL) {
    StarSettings stars{options.filter_sheets};
    stars.with_all = true;
    geometry.stars = makeStars (positions, geometry.neighbors, geometry.stars.normals,
                                Rows::all (positions.size ()), stars, run);
  }

  // Section 4, equations (1) to (3): weights, the loop on a convex curve, the linear system.
  parameterize (positions, geometry.stars, options.disc, run, disc);
  if (disc.problem)
    return disc;

  // Section 2: the triangles of the parameters are the triangles in space.
  run.beginStage (Stage::DELAUNAY);
  disc.mesh = triangulatePlane (disc.uv, disc.boundary.loop);

  // Beyond TW 385: points without a triangle, such as coinciding parameters, are inserted, and
  // edges are flipped in space.
  run.beginStage (Stage::FLIPS);
  finish.largest_fold_share = LARGEST_FOLD_SHARE;
  finish.add_points = !options.disc.as_published;
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

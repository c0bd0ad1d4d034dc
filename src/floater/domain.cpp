// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/domain.h"

#include "core/geometry.h"
#include "core/order_statistics.h"
#include "core/run_context.h"
#include "floater/own_shape.h"

#include <algorithm>
#include <cmath>

namespace pcl::floater {
namespace {
// Two steps g and h on a curve of curvature c turn left by an area of c g h / 2. To survive
// rounding, it must be well above the distance of doubles near 1, which is 2e-16. With these two
// values it is 8e-15 or more.
// these two values it is 8e-15 or more.
constexpr double SHORTEST_STEP = 4e-6;
constexpr double SIDE_CURVATURE = 1e-3;

// Places the points first to last - 1 of the loop on a curve whose end is point `last`.
// \param chords       chords[i] is the step from loop point i to the next one
// \param curve_length in the plane
// \return fractions of the curve, ascending from 0
std::vector<double>
placeOnCurve (const std::vector<double>& chords, std::size_t first, std::size_t last,
              double curve_length)
{
  double total = 0.0;
  for (std::size_t i = first; i < last; ++i)
    total += chords[i];
  const std::size_t steps = last - first;
  const double shortest =
      std::min (SHORTEST_STEP / curve_length, 0.5 / static_cast<double> (steps));
  std::vector<double> fractions (steps);
  double sum = 0.0;
  for (std::size_t i = 0; i < steps; ++i) {
    fractions[i] = sum;
    sum += total > 0.0 ? std::max (chords[first + i] / total, shortest) : 1.0;
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
  double total = 0.0;
  for (const double chord : chords)
    total += chord;
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

std::vector<Eigen::Vector2d>
layOnCircle (const std::vector<double>& chords)
{
  std::vector<Eigen::Vector2d> uv;
  uv.reserve (chords.size ());
  for (const double fraction : placeOnCurve (chords, 0, chords.size (), 2.0 * PI))
    uv.emplace_back (std::cos (2.0 * PI * fraction), std::sin (2.0 * PI * fraction));
  return uv;
}

// Lays the corners at given positions, and the points between two corners on the side between them.
// \param corner_points indices of the corners in the loop, ascending; the first one is 0
// \param places        positions of the corners in the plane, anti-clockwise
std::vector<Eigen::Vector2d>
layOnSides (const std::vector<double>& chords, std::vector<std::size_t> corner_points,
            const std::vector<Eigen::Vector2d>& places)
{
  const std::size_t corners = corner_points.size ();
  corner_points.push_back (chords.size ());
  std::vector<Eigen::Vector2d> uv;
  uv.reserve (chords.size ());
  for (std::size_t c = 0; c < corners; ++c) {
    const Eigen::Vector2d& from = places[c];
    const Eigen::Vector2d side = places[c + 1 == corners ? 0 : c + 1] - from;
    // The side is a parabola through both corners. Its slope is far smaller than their turns.
    const Eigen::Vector2d bulge =
        0.5 * SIDE_CURVATURE * side.norm () * Eigen::Vector2d (side.y (), -side.x ());
    for (const double t :
         placeOnCurve (chords, corner_points[c], corner_points[c + 1], side.norm ()))
      uv.emplace_back (from + t * side + t * (1.0 - t) * bulge);
  }
  return uv;
}

std::vector<Eigen::Vector2d>
layOnRegularPolygon (const std::vector<double>& chords, std::size_t corners)
{
  std::vector<Eigen::Vector2d> places;
  for (std::size_t c = 0; c < corners; ++c) {
    const double angle =
        2.0 * PI * (static_cast<double> (c) - 0.5) / static_cast<double> (corners) - 0.5 * PI;
    places.emplace_back (std::cos (angle), std::sin (angle));
  }
  return layOnSides (chords, cornerPoints (chords, corners), places);
}

// \return empty if the loop has no own shape, or one that is not convex after rounding
std::vector<Eigen::Vector2d>
layOnOwnShape (const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop,
               std::vector<double> chords)
{
  OwnShape shape = findOwnShape (positions, loop, {SIDE_CURVATURE, SHORTEST_STEP});
  if (shape.corners.empty ())
    return {};
  // The first corner must be the first point of the loop: rotate the loop, and the result back.
  const auto turn = static_cast<std::ptrdiff_t> (shape.corners.front ());
  for (std::size_t& corner : shape.corners)
    corner -= static_cast<std::size_t> (turn);
  std::rotate (chords.begin (), chords.begin () + turn, chords.end ());
  std::vector<Eigen::Vector2d> uv = layOnSides (chords, shape.corners, shape.places);
  std::rotate (uv.begin (), uv.end () - turn, uv.end ());
  return isStrictlyConvex (uv) ? uv : std::vector<Eigen::Vector2d> ();
}

double
stepLength (double distance, LoopSpacing spacing)
{
  switch (spacing) {
  case LoopSpacing::CHORD_LENGTH:
    break;
  case LoopSpacing::CENTRIPETAL:
    return std::sqrt (distance);
  case LoopSpacing::UNIFORM:
    return 1.0;
  }
  return distance;
}

} // namespace

std::vector<Eigen::Vector2d>
layLoop (const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop,
         const DomainOptions& options)
{
  const std::size_t count = loop.size ();
  std::vector<double> chords (count);
  for (std::size_t i = 0; i < count; ++i)
    chords[i] =
        stepLength ((positions[loop[i + 1 == count ? 0 : i + 1]] - positions[loop[i]]).norm (),
                    options.loop_spacing);
  if (options.curve == Domain::OWN_SHAPE) {
    std::vector<Eigen::Vector2d> uv = layOnOwnShape (positions, loop, chords);
    if (!uv.empty ())
      return uv;
  }
  if (options.curve == Domain::CIRCLE || options.curve == Domain::OWN_SHAPE)
    return layOnCircle (chords);
  const int sides = options.curve == Domain::SQUARE ? 4 : std::max (3, options.polygon_sides);
  return layOnRegularPolygon (chords, std::min (count, static_cast<std::size_t> (sides)));
}

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

// Links point p to the nearest reached points. Ties go to the smaller point.
void
linkPoint (Index p, const CsrLists& nearest, const CsrLists& nearest_of,
           const std::vector<Eigen::Vector3d>& positions,
           const std::vector<std::uint8_t>& reachable, std::size_t most,
           std::vector<std::array<Index, 2>>& links)
{
  std::vector<std::pair<double, Index>> candidates;
  for (const Row row : {nearest.row (p), nearest_of.row (p)})
    for (const Index q : row)
      if (reachable[q] != 0)
        candidates.emplace_back ((positions[q] - positions[p]).squaredNorm (), q);
  sortUnique (candidates);
  candidates.resize (std::min (candidates.size (), most));
  for (const auto& candidate : candidates)
    links.push_back ({p, candidate.second});
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
    for (const Index p : round)
      linkPoint (p, nearest, nearest_of, positions, reachable, limits.links_per_point,
                 result.links);
    for (const Index p : round)
      reachable[p] = 1;
    queue.insert (queue.end (), round.begin (), round.end ());
    result.linked_points += round.size ();
    search (leading_to, queue, head, reachable, run);
  }
  std::sort (result.links.begin (), result.links.end ());
  return result;
}

} // namespace pcl::floater

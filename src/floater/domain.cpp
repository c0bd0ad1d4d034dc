// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/domain.h"

#include "core/exact.h"
#include "core/geometry.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl::floater {
namespace {
// Two steps g and h on a curve of curvature c turn left by an area of c g h / 2. To survive
// rounding, it must be well above the distance of doubles near 1, which is 2e-16. With these two
// values it is 8e-15 or more.
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
  const double total = std::accumulate (chords.data () + first, chords.data () + last, 0.0);
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

using Outline = std::vector<Eigen::Vector2d>;

// The loop in its least-squares plane along its principal axes, anti-clockwise, in the unit circle.
Outline
project (const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop)
{
  const Eigen::Vector3d& origin = positions[loop.front ()];
  PlaneFit fit;
  for (const Index p : loop)
    fit.add (positions[p] - origin);
  const PrincipalAxes principal = fit.principalAxes ();
  Outline outline;
  outline.reserve (loop.size ());
  for (const Index p : loop) {
    const Eigen::Vector3d offset = positions[p] - origin - principal.centre;
    outline.emplace_back (principal.axes.col (2).dot (offset), principal.axes.col (1).dot (offset));
  }
  double area = 0.0;
  for (std::size_t i = 0; i < outline.size (); ++i)
    area += cross (outline[i], outline[i + 1 == outline.size () ? 0 : i + 1]);
  Eigen::AlignedBox2d box;
  for (Eigen::Vector2d& p : outline) {
    if (area < 0.0)
      p.y () = -p.y ();
    box.extend (p);
  }
  double radius = 0.0;
  for (Eigen::Vector2d& p : outline) {
    p -= box.center ();
    radius = std::max (radius, p.norm ());
  }
  for (Eigen::Vector2d& p : outline)
    p /= radius > 0.0 ? radius : 1.0;
  return outline;
}

// As many hull vertices as possible with the same order along loop and hull. Both are cycles, cut
// at the hull's vertex that comes first in the loop.
std::vector<std::size_t>
inLoopOrder (std::vector<std::size_t> hull)
{
  if (hull.empty ())
    return hull;
  std::rotate (hull.begin (), std::min_element (hull.begin (), hull.end ()), hull.end ());
  // Longest increasing subsequence: ends[l] is the smallest last element of those of length l + 1.
  std::vector<std::size_t> ends, before (hull.size (), 0);
  for (std::size_t i = 0; i < hull.size (); ++i) {
    const auto at =
        std::lower_bound (ends.begin (), ends.end (), hull[i],
                          [&hull] (std::size_t end, std::size_t p) { return hull[end] < p; });
    if (at != ends.begin ())
      before[i] = *(at - 1);
    if (at == ends.end ())
      ends.push_back (i);
    else
      *at = i;
  }
  std::vector<std::size_t> ordered (ends.size ());
  for (std::size_t length = ends.size (), i = ends.back (); length > 0; i = before[i])
    ordered[--length] = hull[i];
  return ordered;
}

// Least length of the first of `steps` steps on a side.
double
firstStep (double side, std::size_t steps)
{
  return steps == 1 ? side : std::min (SHORTEST_STEP, 0.5 * side / static_cast<double> (steps));
}

// Whether b can be a corner between the corners a and c, given the numbers of steps of the loop
// between them.
bool
isFit (const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
       std::size_t steps_before, std::size_t steps_after)
{
  constexpr double SMALLEST_AREA = 1e-14; // twice the area of a turn; 50 times its rounding error
  const Eigen::Vector2d before = b - a, after = c - b;
  const double turn = std::atan2 (cross (before, after), before.dot (after));
  // At each end of a side, the bulge reduces the turn by half of its curvature times the side's
  // length.
  const double taken = 0.5 * SIDE_CURVATURE * (before.norm () + after.norm ());
  const double area = (turn - taken) * firstStep (before.norm (), steps_before) *
                      firstStep (after.norm (), steps_after);
  // Too many steps on a side with so little bulge would not turn left after rounding.
  const auto crowded = [] (double side, std::size_t steps) {
    const double step = firstStep (side, steps);
    return steps > 1 && 0.5 * SIDE_CURVATURE * step * step < 0.5 * SMALLEST_AREA;
  };
  return turn > 2.0 * taken && area > SMALLEST_AREA && !crowded (before.norm (), steps_before) &&
         !crowded (after.norm (), steps_after);
}

// The corners of the loop's own shape, as indices in the loop, ascending: the vertices of the convex
// hull of its outline except for those in another order along the loop than along the hull (where
// the projection crosses itself), those at which the hull turns too little for bulging sides, and
// those too near to the next one for the points between them. None if fewer than three are left.
// O(n log n).
std::vector<std::size_t>
cornersOfOwnShape (const Outline& outline)
{
  constexpr std::size_t FEWEST = 3;
  std::vector<std::size_t> corners = inLoopOrder (convexHull (outline));
  const auto steps = [&outline] (std::size_t from, std::size_t to) {
    return to > from ? to - from : to + outline.size () - from;
  };
  // Repeatedly drops corners that do not fit between the remaining ones.
  for (bool changed = true; changed && corners.size () >= FEWEST;) {
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < corners.size (); ++i) {
      const std::size_t before = kept.empty () ? corners.back () : kept.back ();
      const bool last = i + 1 == corners.size ();
      const std::size_t after = !last ? corners[i + 1] : kept.empty () ? corners[i] : kept.front ();
      if (before != after && isFit (outline[before], outline[corners[i]], outline[after],
                                    steps (before, corners[i]), steps (corners[i], after)))
        kept.push_back (corners[i]);
    }
    changed = kept.size () < corners.size ();
    corners = std::move (kept);
  }
  if (corners.size () < FEWEST)
    corners.clear ();
  return corners;
}

// Whether a closed polygon turns left at every point and once around in total, in double precision.
bool
isStrictlyConvex (const std::vector<Eigen::Vector2d>& polygon)
{
  const std::size_t count = polygon.size ();
  double turn = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    // Differences of nearly equal numbers are exact, so the sign of the cross product is right.
    const Eigen::Vector2d before = polygon[(i + 1) % count] - polygon[i];
    const Eigen::Vector2d after = polygon[(i + 2) % count] - polygon[(i + 1) % count];
    const double sine = cross (before, after);
    if (!(sine > 0.0))
      return false;
    turn += std::atan2 (sine, before.dot (after));
  }
  return count >= 3 && std::abs (turn - 2.0 * PI) < 1.0;
}

// \return empty if the loop has no own shape, or one that is not convex after rounding
std::vector<Eigen::Vector2d>
layOnOwnShape (const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop,
               std::vector<double> chords)
{
  const Outline outline = project (positions, loop);
  std::vector<std::size_t> corners = cornersOfOwnShape (outline);
  if (corners.empty ())
    return {};
  Outline places;
  for (const std::size_t corner : corners)
    places.push_back (outline[corner]);
  // The first corner must be the first point of the loop: rotate the loop, and the result back.
  const auto turn = static_cast<std::ptrdiff_t> (corners.front ());
  for (std::size_t& corner : corners)
    corner -= static_cast<std::size_t> (turn);
  std::rotate (chords.begin (), chords.begin () + turn, chords.end ());
  Outline uv = layOnSides (chords, corners, places);
  std::rotate (uv.begin (), uv.end () - turn, uv.end ());
  return isStrictlyConvex (uv) ? uv : Outline{};
}

double
stepLength (double distance, LoopSpacing spacing)
{
  if (spacing == LoopSpacing::UNIFORM)
    return 1.0;
  return spacing == LoopSpacing::CENTRIPETAL ? std::sqrt (distance) : distance;
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
  const std::size_t corners = std::min (count, static_cast<std::size_t> (sides));
  Outline places; // of a regular polygon
  for (std::size_t c = 0; c < corners; ++c) {
    const double angle =
        2.0 * PI * (static_cast<double> (c) - 0.5) / static_cast<double> (corners) - 0.5 * PI;
    places.emplace_back (std::cos (angle), std::sin (angle));
  }
  return layOnSides (chords, cornerPoints (chords, corners), places);
}

} // namespace pcl::floater

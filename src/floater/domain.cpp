// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/domain.h"

#include "core/exact.h"
#include "core/geometry.h"
#include "core/order_statistics.h"

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
// \param corner_points indices of the corners in the loop, ascending
// \param places        positions of the corners in the plane, anti-clockwise
std::vector<Eigen::Vector2d>
layOnSides (const std::vector<double>& chords, const std::vector<std::size_t>& corner_points,
            const std::vector<Eigen::Vector2d>& places)
{
  std::vector<Eigen::Vector2d> uv (chords.size ());
  for (std::size_t c = 0; c < places.size (); ++c) {
    const std::size_t next = c + 1 == places.size () ? 0 : c + 1;
    const Eigen::Vector2d& from = places[c];
    const Eigen::Vector2d side = places[next] - from;
    // The side is a parabola through both corners. Its slope is far smaller than their turns.
    const Eigen::Vector2d bulge =
        0.5 * SIDE_CURVATURE * side.norm () * Eigen::Vector2d (side.y (), -side.x ());
    std::size_t at = corner_points[c];
    const std::size_t end = corner_points[next] + (next == 0 ? chords.size () : 0);
    for (const double t : placeOnCurve (chords, at, end, side.norm ()))
      uv[at++ % chords.size ()] = from + t * side + t * (1.0 - t) * bulge;
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

// Marks the points at which a closed polygon does not turn left.
// \return whether there are none, and it turns once around in total
bool
isStrictlyConvex (const Outline& polygon, std::vector<std::uint8_t>& is_wrong)
{
  const std::size_t count = polygon.size ();
  double turn = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    // Differences of nearly equal numbers are exact, so the sign of the cross product is right.
    const Eigen::Vector2d before = polygon[i] - polygon[(i + count - 1) % count];
    const Eigen::Vector2d after = polygon[(i + 1) % count] - polygon[i];
    const double sine = cross (before, after);
    is_wrong[i] = sine > 0.0 ? 0 : 1;
    turn += std::atan2 (sine, before.dot (after));
  }
  return std::count (is_wrong.begin (), is_wrong.end (), 1) == 0 &&
         std::abs (turn - 2.0 * PI) < 1.0;
}

// Lays the loop on the convex hull of its outline. In rounds, corners are dropped where that does not
// turn left at the corner or on the side after it: those in another order along the loop than along
// the hull (where the projection crosses itself), those at which the hull turns too little for
// bulging sides, and those too near to the next one for the points between them.
// \return empty if fewer than three corners are left, or the loop winds around itself
Outline
layOnOwnShape (const Outline& outline, const std::vector<double>& chords)
{
  std::vector<std::size_t> corners = convexHull (outline);
  std::sort (corners.begin (), corners.end ());
  std::vector<std::uint8_t> is_wrong (outline.size ());
  while (corners.size () >= 3) {
    Outline uv = layOnSides (chords, corners, valuesAt (outline, corners));
    if (isStrictlyConvex (uv, is_wrong))
      return uv;
    // Of two corners beside each other one is kept: it turns more without the other one.
    std::vector<std::size_t> kept;
    bool was_dropped = false;
    for (std::size_t c = 0; c < corners.size (); ++c) {
      const std::size_t end =
          c + 1 < corners.size () ? corners[c + 1] : corners.front () + outline.size ();
      std::size_t wrong = 0;
      for (std::size_t i = corners[c]; i < end; ++i)
        wrong += is_wrong[i % outline.size ()];
      was_dropped = wrong > 0 && !was_dropped;
      if (!was_dropped)
        kept.push_back (corners[c]);
    }
    if (kept.size () == corners.size ())
      break;
    corners = std::move (kept);
  }
  return {};
}

} // namespace

std::vector<Eigen::Vector2d>
layLoop (const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop,
         const DomainOptions& options)
{
  const std::size_t count = loop.size ();
  std::vector<double> chords (count);
  for (std::size_t i = 0; i < count; ++i) {
    const double step = (positions[loop[i + 1 == count ? 0 : i + 1]] - positions[loop[i]]).norm ();
    chords[i] = options.loop_spacing == LoopSpacing::UNIFORM       ? 1.0
                : options.loop_spacing == LoopSpacing::CENTRIPETAL ? std::sqrt (step)
                                                                   : step;
  }
  if (options.curve == Domain::OWN_SHAPE) {
    Outline uv = layOnOwnShape (project (positions, loop), chords);
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

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/own_shape.h"

#include "core/exact.h"
#include "core/geometry.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl::floater {
namespace {
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
firstStep (double side, std::size_t steps, const SideLimits& limits)
{
  return steps == 1 ? side
                    : std::min (limits.shortest_step, 0.5 * side / static_cast<double> (steps));
}

// Whether b can be a corner between the corners a and c, given the numbers of steps of the loop
// between them.
bool
isFit (const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
       std::size_t steps_before, std::size_t steps_after, const SideLimits& limits)
{
  constexpr double SMALLEST_AREA = 1e-14; // twice the area of a turn; 50 times its rounding error
  const Eigen::Vector2d before = b - a, after = c - b;
  const double turn = std::atan2 (cross (before, after), before.dot (after));
  // At each end of a side, the bulge reduces the turn by half of its curvature times the side's
  // length.
  const double taken = 0.5 * limits.curvature * (before.norm () + after.norm ());
  const double area = (turn - taken) * firstStep (before.norm (), steps_before, limits) *
                      firstStep (after.norm (), steps_after, limits);
  // Too many steps on a side with so little bulge would not turn left after rounding.
  const auto crowded = [&limits] (double side, std::size_t steps) {
    const double step = firstStep (side, steps, limits);
    return steps > 1 && 0.5 * limits.curvature * step * step < 0.5 * SMALLEST_AREA;
  };
  return turn > 2.0 * taken && area > SMALLEST_AREA && !crowded (before.norm (), steps_before) &&
         !crowded (after.norm (), steps_after);
}

} // namespace

OwnShape
findOwnShape (const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& loop,
              const SideLimits& limits)
{
  constexpr std::size_t FEWEST = 3;
  const Outline outline = project (positions, loop);
  std::vector<std::size_t> corners = inLoopOrder (convexHull (outline));
  const auto steps = [&loop] (std::size_t from, std::size_t to) {
    return to > from ? to - from : to + loop.size () - from;
  };
  // Repeatedly drops corners that do not fit between the remaining ones.
  for (bool changed = true; changed && corners.size () >= FEWEST;) {
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < corners.size (); ++i) {
      const std::size_t before = kept.empty () ? corners.back () : kept.back ();
      const bool last = i + 1 == corners.size ();
      const std::size_t after = !last ? corners[i + 1] : kept.empty () ? corners[i] : kept.front ();
      if (before != after && isFit (outline[before], outline[corners[i]], outline[after],
                                    steps (before, corners[i]), steps (corners[i], after), limits))
        kept.push_back (corners[i]);
    }
    changed = kept.size () < corners.size ();
    corners = std::move (kept);
  }
  OwnShape shape;
  if (corners.size () < FEWEST)
    return shape;
  for (const std::size_t corner : corners)
    shape.places.push_back (outline[corner]);
  shape.corners = std::move (corners);
  return shape;
}

bool
isStrictlyConvex (const std::vector<Eigen::Vector2d>& polygon)
{
  constexpr double TWO_PI = 6.283185307179586;
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
  return count >= 3 && std::abs (turn - TWO_PI) < 1.0;
}

} // namespace pcl::floater

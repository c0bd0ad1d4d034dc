// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/domain.h"

#include "core/geometry.h"

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
  std::vector<Eigen::Vector2d> places; // on the unit circle
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
  return layOnSides (chords, cornerPoints (chords, corners), places);
}

} // namespace pcl::floater

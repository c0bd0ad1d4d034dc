// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/no_surface.h"

#include "core/order_statistics.h"
#include "local/star_reach.h"

#include <map>

namespace pcl::floater {
namespace {
// Share of the points that lie on a line with their neighbours, or in turns.
constexpr double ON_LINES = 0.9;

// Number of points of a turn whose step to the next point is about as large as most steps.
std::size_t
evenSteps (std::vector<double> angles)
{
  // How far a step may be from the median; 7 % of the steps of strewn points are within it, 62 % of
  // a golden spiral's.
  constexpr double EVEN_STEP = 0.1;
  std::sort (angles.begin (), angles.end ());
  std::vector<double> steps{angles.front () + 2.0 * PI - angles.back ()};
  for (std::size_t i = 1; i < angles.size (); ++i)
    steps.push_back (angles[i] - angles[i - 1]);
  const double usual = median (steps);
  const auto isEven = [&] (double s) { return std::abs (s - usual) < EVEN_STEP * usual; };
  return static_cast<std::size_t> (std::count_if (steps.begin (), steps.end (), isEven));
}

// The axis of a sensor that turns about it, if nearly all points lie in turns.
std::optional<int>
findTurnAxis (const Positions& positions, const Vector3d& origin, const CsrLists& neighbors,
              std::size_t nearest, std::size_t stride)
{
  for (int axis = 0; axis < 3; ++axis) {
    std::size_t looked_at = 0, alone = 0;
    for (std::size_t p = 0; p < positions.size (); p += stride, ++looked_at) {
      const Row row = neighbors.first (static_cast<Index> (p), nearest);
      alone += std::all_of (row.begin (), row.end (),
                            [&] (Index q) { return positions[q][axis] == positions[p][axis]; });
    }
    if (2 * alone < looked_at)
      continue;
    std::map<double, std::vector<double>> turns;
    for (const Vector3d& position : positions) {
      const Vector3d ray = position - origin;
      turns[position[axis]].push_back (std::atan2 (ray[(axis + 2) % 3], ray[(axis + 1) % 3]));
    }
    std::size_t even = 0;
    for (auto& [height, angles] : turns)
      even += evenSteps (std::move (angles));
    if (static_cast<double> (even) >= ON_LINES * static_cast<double> (positions.size ()))
      return axis;
  }
  return {};
}

} // namespace

std::optional<double>
findCurves (const Positions& positions, const Vector3d& origin, const LocalGeometry& geometry,
            std::size_t neighbors, const RunContext& run)
{
  // At most this share of the points is joined to another curve. Parallel lines on a wavy sheet, up
  // to 30 times as far apart as their points, have 0.91 or more of their points joined, 40 times
  // 0.67, 60 times 0.42; single curves 0.02 or less, profiles with corners 20 to 40 times as far
  // apart up to 0.28.
  constexpr double JOINED = 0.35;
  constexpr std::size_t SAMPLES = 1000;     // points looked at
  constexpr std::size_t LEAST_POINTS = 100; // fewer lie along lines by chance
  const std::size_t n = positions.size (), stride = n / SAMPLES + 1;
  if (n < LEAST_POINTS)
    return {};
  const std::size_t looked_at = (n + stride - 1) / stride;
  const std::optional<int> axis =
      findTurnAxis (positions, origin, geometry.neighbors, neighbors, stride);
  std::vector<std::pair<Index, Line>> on_line;
  for (std::size_t i = 0; i < n; i += stride) {
    const auto p = static_cast<Index> (i);
    const Row row = geometry.neighbors.first (p, neighbors);
    if (const auto line = axis ? Line{} : lineThrough (positions, p, row))
      on_line.emplace_back (p, *line);
  }
  const auto points = static_cast<double> (on_line.size ());
  if (points < ON_LINES * static_cast<double> (looked_at))
    return {};
  const auto isBeside = [&] (const std::pair<Index, Line>& at, const Vector3d& position) {
    const Vector3d offset = position - positions[at.first];
    return axis ? offset[*axis] != 0.0 : liesBeside (at.second, offset);
  };
  const auto isJoined = [&] (const std::pair<Index, Line>& at) {
    return anyTriangle (geometry.stars, at.first, [&] (Index q, Index r) {
      return (isBeside (at, positions[q]) || isBeside (at, positions[r])) &&
             hasTriangle (geometry.stars, q, r, at.first) &&
             hasTriangle (geometry.stars, r, at.first, q);
    });
  };
  const auto joined = std::count_if (on_line.begin (), on_line.end (), isJoined);
  if (static_cast<double> (joined) > JOINED * points)
    return {};
  constexpr std::size_t NEAREST = 6; // three on either side: two steps away on average
  const KdTree tree (positions, run);
  std::vector<Neighbor> found;
  std::vector<double> apart;
  for (const auto& at : on_line) {
    const Vector3d& here = positions[at.first];
    const auto isOff = [&] (const Neighbor&, const Vector3d& q) { return isBeside (at, q); };
    tree.nearestIf (here, Vector3d::Zero (), KdTree::EVERYWHERE, 1, isOff, found);
    double step = 0.0;
    const Row nearest = geometry.neighbors.first (at.first, NEAREST);
    for (const Index q : nearest)
      step += 0.5 * (positions[q] - here).norm () / static_cast<double> (nearest.size ());
    if (!found.empty () && step > 0.0)
      apart.push_back (std::sqrt (found.front ().sqr_distance) / step);
  }
  return 2 * apart.size () > on_line.size () ? median (apart) : 0.0;
}

} // namespace pcl::floater

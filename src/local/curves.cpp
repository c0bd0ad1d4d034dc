// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/curves.h"

#include "core/order_statistics.h"
#include "local/star_reach.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl::floater {
Curves
findCurves (const std::vector<Eigen::Vector3d>& positions, const LocalGeometry& geometry,
            std::size_t neighbors, double least_aspect, const ReachLimits& reach,
            const CurveLimits& limits, const RunContext& run)
{
  const std::size_t n = positions.size (), stride = n / limits.samples + 1;
  if (n < limits.least_points)
    return {};
  const std::size_t looked_at = (n + stride - 1) / stride;
  std::vector<std::pair<Index, Line>> on_line;
  for (std::size_t i = 0; i < n; i += stride) {
    const auto p = static_cast<Index> (i);
    if (const auto line =
            lineThrough (positions, p, geometry.neighbors.first (p, neighbors), least_aspect))
      on_line.emplace_back (p, *line);
  }
  const auto points = static_cast<double> (on_line.size ());
  if (points < limits.on_lines * static_cast<double> (looked_at))
    return {};
  const auto isJoined = [&] (const std::pair<Index, Line>& at) {
    const Index p = at.first;
    const auto isBeside = [&] (Index q) {
      return liesBeside (at.second, positions[q] - positions[p], reach);
    };
    const Row row = geometry.stars.neighbors.row (p);
    for (std::size_t i = 0; i + geometry.stars.open[p] < row.size (); ++i) {
      const Index q = row[i], r = row[i + 1 < row.size () ? i + 1 : 0];
      if ((isBeside (q) || isBeside (r)) && hasTriangle (geometry.stars, q, r, p) &&
          hasTriangle (geometry.stars, r, p, q))
        return true;
    }
    return false;
  };
  const auto joined = std::count_if (on_line.begin (), on_line.end (), isJoined);
  if (static_cast<double> (joined) > limits.joined * points)
    return {};
  constexpr std::size_t NEAREST = 6;
  const KdTree tree (positions, run);
  std::vector<Neighbor> found;
  std::vector<double> apart;
  for (const auto& [p, line] : on_line) {
    const Eigen::Vector3d& here = positions[p];
    const auto isBeside = [&, &line = line] (const Neighbor&, const Eigen::Vector3d& position) {
      return liesBeside (line, position - here, reach);
    };
    tree.nearestIf (here, Eigen::Vector3d::Zero (), KdTree::EVERYWHERE, 1, isBeside, found);
    double step = 0.0; // three neighbours on either side: two steps away on average
    const Row nearest = geometry.neighbors.first (p, NEAREST);
    for (const Index q : nearest)
      step += 0.5 * (positions[q] - here).norm () / static_cast<double> (nearest.size ());
    if (!found.empty () && step > 0.0)
      apart.push_back (std::sqrt (found.front ().sqr_distance) / step);
  }
  return {true, 2 * apart.size () > on_line.size () ? median (apart) : 0.0};
}

} // namespace pcl::floater

// SPDX-License-Identifier: GPL-3.0-or-later
// Triangulation of a closed polygon in space at least cost.
#pragma once

#include "mesh/flips.h"

#include <cmath>
#include <limits>
#include <vector>

namespace pcl
{
namespace floater
{
/// Triangulates polygons by dynamic programming over their sub-polygons. O(m^3) for m corners.
class PolygonFilling
{
public:
  /// Least-cost triangles of a closed polygon, anti-clockwise; empty if there is no way.
  /// \param allowed (p, q): whether these corners may be joined
  /// \param cost (p, q, r): of a triangle, 0 or more
  template <typename Cost, typename Allowed>
  std::vector<Triangle> fill (const std::vector<Index>& polygon, Cost&& cost, Allowed&& allowed)
  {
    const std::size_t m = polygon.size ();
    best_.assign (m * m, {0.0, 0});
    for (std::size_t span = 2; span < m; ++span)
      for (std::size_t i = 0; i + span < m; ++i) {
        const std::size_t j = i + span;
        Choice& choice = best_[i * m + j];
        choice = {std::numeric_limits<double>::infinity (), 0};
        if (span < m - 1 && !allowed (polygon[i], polygon[j]))
          continue;
        for (std::size_t apex = i + 1; apex < j; ++apex) {
          const double before = best_[i * m + apex].cost + best_[apex * m + j].cost;
          if (before >= choice.cost)
            continue;
          const double sum = before + cost (polygon[i], polygon[apex], polygon[j]);
          if (sum < choice.cost)
            choice = {sum, apex};
        }
      }
    std::vector<Triangle> triangles;
    if (m >= 3 && std::isfinite (best_[m - 1].cost))
      collect (polygon, 0, m - 1, triangles);
    return triangles;
  }

private:
  struct Choice
  {
    double cost;
    std::size_t apex;
  };

  void collect (const std::vector<Index>& polygon, std::size_t i, std::size_t j,
                std::vector<Triangle>& triangles) const
  {
    if (j - i < 2)
      return;
    const std::size_t apex = best_[i * polygon.size () + j].apex;
    triangles.push_back ({polygon[i], polygon[apex], polygon[j]});
    collect (polygon, i, apex, triangles);
    collect (polygon, apex, j, triangles);
  }

  std::vector<Choice> best_;
};

} // namespace floater
} // namespace pcl

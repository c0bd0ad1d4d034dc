// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/view_gaps.h"

#include "core/order_statistics.h"
#include "core/parallel.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>

namespace pcl::floater {
namespace {
std::vector<float>
circumradii (const TriangleMesh& view, const Rays& rays, const RunContext& run)
{
  std::vector<float> radii (view.triangles.size ());
  parallelRanges (run, radii.size (), [&] (std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      const auto& [a, b, c] = view.triangles[t];
      const Eigen::Vector3d u = rays.directions[b] - rays.directions[a];
      const Eigen::Vector3d v = rays.directions[c] - rays.directions[a];
      const double double_area = u.cross (v).norm ();
      radii[t] =
          double_area > 0.0
              ? static_cast<float> (u.norm () * v.norm () * (v - u).norm () / (2.0 * double_area))
              : std::numeric_limits<float>::infinity ();
    }
  });
  return radii;
}

} // namespace

std::vector<std::uint8_t>
findGaps (const TriangleMesh& view, const Rays& rays, const GapLimits& limits,
          const RunContext& run)
{
  const std::size_t points = view.triangle_of.size ();
  const std::vector<float> radii = circumradii (view, rays, run);
  // The second smallest radius around each point, then its median over the neighbours: at a
  // boundary, more triangles may lie in the gap than on the surface, but hardly fewer than two on
  // the surface.
  std::vector<float> around (points, 0.0F), typical (points, 0.0F);
  const auto forPoints = [&] (const auto& body) {
    parallelRanges (run, points, [&] (std::size_t first, std::size_t last) {
      std::vector<Index> fan;
      std::vector<float> values;
      for (auto p = static_cast<Index> (first); p < last; ++p) {
        if (view.triangle_of[p] == NONE)
          continue;
        view.fan (p, fan);
        values.clear ();
        body (p, fan, values);
      }
    });
  };
  forPoints ([&] (Index p, const std::vector<Index>& fan, std::vector<float>& values) {
    for (const Index t : fan)
      values.push_back (radii[t]);
    around[p] = valueAtRank (values, std::min<std::size_t> (1, values.size () - 1));
  });
  forPoints ([&] (Index p, const std::vector<Index>& fan, std::vector<float>& values) {
    for (const Index t : fan)
      for (const Index q : view.triangles[t])
        values.push_back (around[q]);
    typical[p] = median (values);
  });
  std::vector<std::uint8_t> is_gap (radii.size (), 0);
  for (std::size_t t = 0; t < radii.size (); ++t) {
    const auto& [a, b, c] = view.triangles[t];
    const double least = std::min ({typical[a], typical[b], typical[c]});
    is_gap[t] = static_cast<double> (radii[t]) > limits.radius * least ? 1 : 0;
  }
  return is_gap;
}

} // namespace pcl::floater

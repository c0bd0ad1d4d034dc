// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/noise_projection.h"

#include "core/parallel.h"
#include "core/plane_fit.h"
#include "points/point_sample.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl::floater {
std::vector<Eigen::Vector3d>
projectNoisyPoints (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                    const Noise& noise, const NoiseLimits& limits, const RunContext& run)
{
  constexpr std::size_t MOST = 60; // points of a plane
  constexpr double NARROWNESS = 4.0;
  constexpr double OUTSIDE = 4.5; // standard deviations at which the weight vanishes
  constexpr int PASSES = 2;
  const PointSample all (positions, 1, run), quarter (positions, STRIDES[1], run),
      sixteenth (positions, STRIDES[2], run);
  const std::array<const PointSample*, SCALES> samples{&all, &quarter, &sixteenth};
  std::vector<Eigen::Vector3d> projected = positions;
  parallelRanges (run, positions.size (), [&] (std::size_t first, std::size_t last) {
    std::vector<Neighbor> found;
    for (std::size_t p = first; p < last; ++p) {
      const auto deviation = static_cast<double> (noise.at_point[p]);
      if (deviation <= 0.0)
        continue;
      const Row row = neighbors.first (p, LOOKED_AT);
      const double known = (positions[row[row.size () - 1]] - positions[p]).squaredNorm ();
      const double radius = limits.radius * deviation;
      const double wanted = std::max (static_cast<double> (LOOKED_AT),
                                      static_cast<double> (row.size ()) * radius * radius / known);
      std::size_t scale = 0;
      while (scale + 1 < SCALES && wanted > static_cast<double> (MOST * STRIDES[scale]))
        ++scale;
      const auto count = static_cast<std::size_t> (
          std::min (static_cast<double> (MOST), wanted / static_cast<double> (STRIDES[scale])));
      samples[scale]->nearest (positions[p], count, found);
      const double sqr_reach = found.back ().sqr_distance;
      Plane plane;
      for (int pass = 0; pass < PASSES; ++pass) {
        PlaneFit fit;
        for (const Neighbor& neighbor : found) {
          const Eigen::Vector3d offset = positions[neighbor.point] - positions[p];
          double weight = std::exp (-NARROWNESS * neighbor.sqr_distance / sqr_reach);
          if (pass > 0) {
            const double share = plane.height (offset) / (OUTSIDE * deviation);
            weight *= std::abs (share) < 1.0 ? (1.0 - share * share) * (1.0 - share * share) : 0.0;
          }
          fit.add (offset, weight);
        }
        if (fit.weight () < 1.0)
          break;
        plane = fit.plane ();
      }
      projected[p] = positions[p] - plane.normal * plane.height (Eigen::Vector3d::Zero ());
    }
  });
  return projected;
}

} // namespace pcl::floater

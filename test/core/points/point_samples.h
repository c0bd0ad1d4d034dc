// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds and an oracle for the tests of neighbours, noise and outliers.
#pragma once

#include "points/neighbors.h"
#include "points/points.h"
#include "samples.h"
#include "surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace pcl::floater::samples {
const Eigen::Vector3d ON_A_MAP (5e5, 5.5e6, 300.0);

/// \param noise in spacings
inline Positions
surface (SurfaceKind kind, std::size_t points, double noise = 0.0, double density_ratio = 1.0)
{
  SurfaceSpec spec;
  spec.kind = kind;
  spec.points = points;
  spec.noise = noise;
  spec.density_ratio = density_ratio;
  return generateSurface (spec);
}

inline Positions
placed (Positions cloud, const Eigen::Vector3d& place, double scale = 1.0)
{
  for (Eigen::Vector3d& p : cloud)
    p = place + scale * p;
  return cloud;
}

inline Points
workingPoints (const Positions& positions)
{
  return makePoints (positions, indices (positions.size ()), 1);
}

/// A search of the caller that tries all points. It answers with the point itself among the neighbours and,
/// within a radius, with one that is too far away.
class BruteForceSearch : public NeighborSearch
{
public:
  explicit BruteForceSearch (Positions cloud) : cloud_ (std::move (cloud)) {}

  void build (const std::vector<std::uint32_t>& cloud_indices) override
  {
    EXPECT_TRUE (std::is_sorted (cloud_indices.begin (), cloud_indices.end ()));
    chosen = cloud_indices;
  }

  void nearest (std::uint32_t cloud_index, int k,
                std::vector<std::uint32_t>& cloud_indices) override
  {
    EXPECT_TRUE (std::binary_search (chosen.begin (), chosen.end (), cloud_index));
    std::vector<std::pair<double, Index>> all;
    for (const Index q : chosen)
      all.emplace_back ((cloud_[q] - cloud_[cloud_index]).squaredNorm (), q);
    std::sort (all.begin (), all.end ());
    all.resize (std::min (all.size (), static_cast<std::size_t> (k)));
    cloud_indices.clear ();
    for (const auto& neighbor : all)
      for (int copy = 0; copy < answers_each; ++copy)
        cloud_indices.push_back (neighbor.second);
    std::sort (cloud_indices.begin (), cloud_indices.end ());
  }

  bool within (std::uint32_t cloud_index, double radius,
               std::vector<std::uint32_t>& cloud_indices) override
  {
    cloud_indices.clear ();
    for (const Index q : chosen)
      if ((cloud_[q] - cloud_[cloud_index]).norm () <= radius)
        cloud_indices.push_back (q);
    cloud_indices.push_back (chosen[(cloud_index + 17) % chosen.size ()]);
    return knows_radii;
  }

  std::vector<std::uint32_t> chosen;
  int answers_each = 1;
  bool knows_radii = false;

private:
  Positions cloud_;
};

} // namespace pcl::floater::samples

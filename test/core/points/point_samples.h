// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds, and neighbours by trying all points.
#pragma once

#include "points/kd_tree.h"
#include "points/points.h"
#include "samples.h"
#include "surfaces.h"

#include <algorithm>
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

inline Positions
joined (Positions a, const Positions& b)
{
  a.insert (a.end (), b.begin (), b.end ());
  return a;
}

/// Points of a grid in z = 0, `spacing` apart, each moved by up to `jitter` spacings in x and y.
inline Positions
jitteredGrid (int columns, int rows, double spacing, double jitter, RandomStream& random)
{
  Positions points;
  for (int x = 0; x < columns; ++x)
    for (int y = 0; y < rows; ++y) {
      const double dx = jitter * random.uniform (), dy = jitter * random.uniform ();
      points.emplace_back (spacing * (x + dx), spacing * (y + dy), 0.0);
    }
  return points;
}

inline Eigen::Vector3d
normalVector (RandomStream& random)
{
  const double x = random.normal (), y = random.normal ();
  return {x, y, random.normal ()};
}

inline Points
workingPoints (const Positions& positions)
{
  return makePoints (positions, indices (positions.size ()), 1);
}

/// The k nearest points, nearest first, by trying all.
inline std::vector<Neighbor>
nearestByTryingAll (const Positions& points, const Eigen::Vector3d& query, std::size_t k)
{
  std::vector<Neighbor> all;
  for (Index p = 0; p < points.size (); ++p)
    all.push_back ({(points[p] - query).squaredNorm (), p});
  const std::size_t count = std::min (k, all.size ());
  std::partial_sort (all.begin (), all.begin () + static_cast<std::ptrdiff_t> (count), all.end ());
  all.resize (count);
  return all;
}

} // namespace pcl::floater::samples

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_samples.h"

namespace pcl::floater::samples {
KnownSurface
components (std::uint64_t seed)
{
  return withComponent (
      withComponent (sphere (1500, seed), torus (1200, seed + 1), 3.0, {75.0, 0.0, 0.0}),
      annulus (seed + 2), 2.0, {0.0, 110.0, 0.0});
}

KnownSurface
withComponent (KnownSurface surface, const KnownSurface& more, double scale,
               const Eigen::Vector3d& place)
{
  for (const Eigen::Vector3d& p : more.points)
    surface.points.emplace_back (scale * p + place);
  surface.components += more.components;
  surface.loops += more.loops;
  surface.handles += more.handles;
  surface.area += scale * scale * more.area;
  return surface;
}

KnownSurface
withNoise (KnownSurface surface, double standard_deviation, std::uint64_t seed)
{
  surface.clean = surface.points;
  RandomStream random (seed);
  for (Eigen::Vector3d& p : surface.points)
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      p[axis] += standard_deviation * random.normal ();
  surface.area = 0.0;
  return surface;
}

KnownSurface
withOutliers (KnownSurface surface, std::size_t count, double distance, std::uint64_t seed)
{
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : surface.points)
    box.extend (p);
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant (2.0 * distance);
  const Eigen::Vector3d first = box.min () - margin, size = box.sizes () + 2.0 * margin;
  RandomStream random (seed);
  while (surface.outliers.size () < count) {
    Eigen::Vector3d p;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      p[axis] = first[axis] + size[axis] * random.uniform ();
    if (std::any_of (surface.points.begin (), surface.points.end (),
                     [&] (const Eigen::Vector3d& q) { return (q - p).norm () < distance; }))
      continue;
    surface.outliers.push_back (static_cast<Index> (surface.points.size ()));
    surface.points.push_back (p);
  }
  return surface;
}

KnownSurface
withDuplicates (KnownSurface surface, std::size_t count, std::uint64_t seed)
{
  RandomStream random (seed);
  const std::size_t distinct = surface.points.size ();
  for (std::size_t i = 0; i < count; ++i) {
    surface.duplicates.push_back (static_cast<Index> (surface.points.size ()));
    surface.points.push_back (surface.points[random.below (distinct)]);
  }
  return surface;
}

} // namespace pcl::floater::samples

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds on smooth open surfaces with windows cut into them, or with gaps that only the sampling
// has. What is a window is known, so that every boundary loop of a mesh can be told.
#pragma once

#include "samplings.h"
#include "surface_maps.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace pcl
{
namespace floater
{
/// A hole that was cut: star-shaped in the plane of the parameters.
struct Window
{
  Eigen::Vector2d centre;
  std::function<double (double angle)> radius;
  double mean_radius = 0.0; ///< that of a circle of the same area, but for dents
  double longest = 1.2;     ///< radius, in mean radii
  bool even_rim = false;    ///< points in even steps on its rim

  bool covers (const Eigen::Vector2d& place, double margin = 0.0) const;
};

struct HoleySurface
{
  Shape shape = Shape::PLANE;
  Sampling sampling = Sampling::GRID;
  double side = 0.0;                   ///< of the square of parameters, around the origin
  std::vector<Window> windows;         ///< apart from each other and from the border
  std::vector<Eigen::Vector2d> places; ///< parameters of each point
  std::vector<Eigen::Vector3d> points;
};

/// A surface of random shape, sampling and size, the same for the same seed. \param with_windows
/// false: no hole is cut, so that all loops but the border are gaps
HoleySurface
makeHoleySurface (bool with_windows, std::uint64_t seed);

} // namespace floater
} // namespace pcl

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Smooth, sharp and steep surfaces over a square of parameters.
#pragma once

#include "random_fields.h"

#include <string>

namespace pcl
{
namespace floater
{
enum class Shape
{
  PLANE,
  CYLINDER,
  SPHERE,
  SADDLE,
  TORUS,
  BUMPS,
  TERRACES, ///< flat parts and slopes between them
  CLIFFS,   ///< the same with slopes of up to 80 degrees
  ROOF,     ///< two planes with a sharp edge
  FINS,     ///< steep ridges a few spacings thick
  COUNT
};

std::string
nameOf (Shape shape);

/// A random surface of a shape. \param side of the square, around the origin, in spacings
Map
makeMap (Shape shape, double side, RandomStream& random);

} // namespace floater
} // namespace pcl

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces of solids that are given by fields.
#pragma once

#include "triangle_soup.h"

#include <functional>
#include <vector>

namespace pcl::floater::facing_cases {
/// Below zero inside a solid.
using Field = std::function<double (const Vector&)>;

Field
ellipsoid (const Vector& centre, const Vector& radii);

/// A box with these axes as columns.
Field
slab (const Vector& centre, const Vector& half, const Eigen::Matrix3d& axes);

/// A torus about the third axis.
Field
ring (const Vector& centre, double radius, double tube, const Eigen::Matrix3d& axes);

/// All solids together.
Field
unite (std::vector<Field> parts);

/// The surface of a solid within 1.3 of the origin along each axis, on a grid of 40 cells. A closed
/// oriented manifold.
Soup
levelSet (const Field& field);

} // namespace pcl::floater::facing_cases

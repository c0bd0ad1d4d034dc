// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Operations on triangles without neighbours, to make shapes of others.
#pragma once

#include "mesh/triangle_mesh.h"
#include "random_stream.h"

#include <functional>
#include <vector>

namespace pcl::floater::facing_cases {
using Vector = Eigen::Vector3d;

struct Soup
{
  std::vector<Vector> positions;
  std::vector<Triangle> triangles;
};

/// \throws std::logic_error if it is no oriented manifold
TriangleMesh
meshOf (const Soup& soup);

/// Takes out triangles, and all around points that have several fans left, until there are none.
/// \param is_out of each triangle
void
cutOut (Soup& soup, std::vector<std::uint8_t> is_out);

/// Twice the area of a triangle.
double
areaOf (const Soup& soup, const Triangle& t);

/// Removes the components but those of at least this many triangles, or all but the largest.
void
dropSmall (Soup& soup, std::size_t least);

/// Cuts round windows about random triangles.
/// \param share of the area, of all windows together
void
cutWindows (Soup& soup, int windows, double share, RandomStream& random);

void
transform (Soup& soup, const Eigen::Matrix3d& matrix);

/// Front becomes back.
void
turnRound (Soup& soup);

void
append (Soup& soup, const Soup& more);

/// A grid of u and v from 0 to 1, the front where u, v and the normal are right-handed.
/// \param wraps the last column is the first one
Soup
grid (const std::function<Vector (double, double)>& shape, int columns, int rows, bool wraps);

/// Keeps what is seen of a closed surface from far away along -direction.
void
keepSeen (Soup& soup, const Vector& direction);

/// Takes out what lies below a level along a direction.
void
cutBelow (Soup& soup, const Vector& direction, double level);

/// Takes out bands along planes.
void
tear (Soup& soup, int cuts, double width, RandomStream& random);

/// Cuts the same round windows through all walls, as cones from the middle.
void
cutCones (const std::vector<Soup*>& walls, int windows, RandomStream& random);

} // namespace pcl::floater::facing_cases

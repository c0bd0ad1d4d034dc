// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Boundary loops of a mesh and their sizes.
#pragma once

#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl::floater {
/// A closed walk along boundary edges.
struct BoundaryLoop
{
  std::vector<Index> points; ///< in order, the surface on the left, from the smallest point on
  Index component = 0;       ///< of the mesh (see findComponents)
  double length = 0.0;       ///< sum of its edges, in the unit of the positions
  double width = 0.0;        ///< largest distance between two of its points, same unit
  double spacing = 0.0;      ///< mean local spacing of its points, same unit
  bool keep_open = false;    ///< it is a boundary of the surface
};

/// Sets length, width and spacing from the points. The width of a loop of up to 256 points is
/// exact. For a longer one, at most 256 points at equal steps along the loop are used: the width is
/// too small by at most two of these steps. O(points).
/// \param spacing local spacing of each point of the mesh
void
measureLoop (BoundaryLoop& loop, const std::vector<Eigen::Vector3d>& positions,
             const std::vector<float>& spacing);

/// All boundary loops of a mesh, measured, in the order of boundaryLoops (). O(n).
std::vector<BoundaryLoop>
findBoundaryLoops (const TriangleMesh& mesh, const MeshComponents& components,
                   const std::vector<Eigen::Vector3d>& positions, const std::vector<float>& spacing,
                   const RunContext& run);

} // namespace pcl::floater

// SPDX-License-Identifier: GPL-3.0-or-later
// The consensus method: surfaces of any topology, from the triangles that stars agree on.
#pragma once

#include "local/local_geometry.h"
#include "mesh/finish.h"
#include "points/points.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// The mesh of a surface and how it came about.
struct Surface
{
  TriangleMesh mesh;
  MeshFinish finish;
  std::size_t holes_filled = 0;
  std::vector<Triangle> orientation_seam; ///< where a surface that seems one-sided was cut open;
                                          ///< see findOrientationSeam; else empty
};

/// Consensus, holes, points that are left over, flips and repair. Runs through stages CONSENSUS,
/// HOLES and FLIPS. Triangles are chosen by the working positions, and finished on the positions
/// themselves. O(n log n).
/// \param geometry its stars are consumed, but for the normals, which get the signs of the mesh
Surface
makeSurface (const Points& points, LocalGeometry& geometry, const HoleOptions& holes,
             bool flip_edges, const RunContext& run);

} // namespace floater
} // namespace pcl

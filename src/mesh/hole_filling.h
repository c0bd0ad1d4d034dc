// SPDX-License-Identifier: GPL-3.0-or-later
// Closes rims by polygons.
#pragma once

#include "mesh/boundary_loops.h"
#include "mesh/flips.h"

namespace pcl
{
namespace floater
{
/// Fills every rim that does not stay by the triangles of least cost over its points alone; a rim
/// of more than 128 points is first made shorter by cutting its cheapest ears. Chords that are
/// edges of the mesh already are not used; a rim that cannot be filled without them stays. O(m^3)
/// for a rim of m points up to that size, O(m log m) beyond.
/// \return number of rims filled
std::size_t
fillHoles (TriangleMesh& mesh, std::vector<BoundaryLoop>& loops,
           const std::vector<Eigen::Vector3d>& positions, const TriangleCost& cost,
           const RunContext& run);

} // namespace floater
} // namespace pcl

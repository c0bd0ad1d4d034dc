// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Closes boundary loops by triangulated polygons.
#pragma once

#include "mesh/boundary_loops.h"
#include "mesh/triangle_cost.h"

namespace pcl::floater {
/// How holes are filled.
struct HoleFillingLimits
{
  double area_cost = 200.0; ///< per doubled area in squared mean steps of the loop, in the unit of
                            ///< TriangleCost. Sheets that end face to face are to be joined across
                            ///< the narrow gap between them, not each closed on its own. Chosen by
                            ///< hand; no measurement is recorded
  std::size_t largest_polygon = 128; ///< corners for which the best triangulation is searched. A
                                     ///< limit of time, which grows with the third power
};

/// Fills every loop that is not kept open by triangles of least total cost between its points (see
/// PolygonFilling). A longer loop than HoleFillingLimits::largest_polygon is first made shorter by
/// cutting off the ear of least cost, again and again. Edges of the mesh are not used twice; a loop
/// that cannot be filled otherwise, or that goes round a single triangle, is kept open. O(m^3) for
/// a loop of m points up to that limit, O(m log m) beyond.
/// \param loops BoundaryLoop::keep_open is set for those that could not be filled
/// \return number of loops filled
/// \throw std::logic_error if the loops are not those of the mesh
std::size_t
fillHoles (TriangleMesh& mesh, std::vector<BoundaryLoop>& loops,
           const std::vector<Eigen::Vector3d>& positions, const TriangleCost& cost,
           const HoleFillingLimits& limits, const RunContext& run);

} // namespace pcl::floater

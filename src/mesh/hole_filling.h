// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fills boundary loops by triangulated polygons.
#pragma once

#include "mesh/boundary_loops.h"
#include "mesh/triangle_cost.h"

namespace pcl::floater {
/// Limits of hole filling.
struct HoleFillingLimits
{
  double area_cost = 200.0; ///< per doubled area in squared mean steps of the loop, in the unit of
                            ///< TriangleCost. Large enough that sheets that end face to face are
                            ///< joined across the narrow gap, instead of each being closed on its
                            ///< own. Chosen by hand; no measurement is recorded
  std::size_t largest_polygon = 128; ///< corners up to which the best triangulation is searched, to
                                     ///< limit the time, which grows with the third power
};

/// Fills every loop that is not kept open by triangles of least total cost between its points (see
/// PolygonFilling). A loop longer than HoleFillingLimits::largest_polygon is first shortened by
/// repeatedly cutting off the ear of least cost. Edges of the mesh are not used twice; a loop that
/// would need this, or that goes round a single triangle, is kept open. O(m^3) for a loop of m
/// points up to that limit, O(m log m) beyond.
/// \param loops BoundaryLoop::keep_open is set for those that could not be filled
/// \return number of loops filled
/// \throws std::logic_error if the loops do not belong to the mesh
std::size_t
fillHoles (TriangleMesh& mesh, std::vector<BoundaryLoop>& loops,
           const std::vector<Eigen::Vector3d>& positions, const TriangleCost& cost,
           const HoleFillingLimits& limits, const RunContext& run);

} // namespace pcl::floater

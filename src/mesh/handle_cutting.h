// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts handles that the points do not support.
#pragma once

#include "local/local_geometry.h"
#include "mesh/flaw_repair.h"
#include "mesh/hole_filling.h"
#include "mesh/triangle_cost.h"
#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl::floater {
/// Limits of cutHandles ().
struct HandleLimits
{
  std::size_t longest_loop = 12; ///< edges of a loop that is tried. False handles of thinned scans
                                 ///< had loops of 3 to 9
  double cost_left = 0.9; ///< share of the cost that a cut may leave. Cuts of false handles left
                          ///< 0.89 or less, and cuts of true ones more than there was, but 0.97 in
                          ///< tubes of three points around, where each edge along counts as a fold
  CostLimits cost;
  double pair_cost = RepairLimits{}.pair_cost; ///< of a crossing pair
  double area_cost = HoleFillingLimits{}.area_cost;
};

/// Cuts along short loops around and through handles (see findHandleLoops): takes out the triangles
/// at the points of a loop, on one side of it or on both, fills the two openings, and inserts points
/// that have no triangle left. The cheapest of these cuts is made if it lowers the cost of the
/// triangles around, folds and crossing pairs included. A handle that joins sheets which only come
/// close is turned against the planes of its points; across a true one, the fillings would be. O(n)
/// for a mesh without handles.
/// \param geometry normals oriented like the mesh (see orientNormals)
/// \return number of handles that were cut
std::size_t
cutHandles (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
            const LocalGeometry& geometry, const HandleLimits& limits, const RunContext& run);

} // namespace pcl::floater

// SPDX-License-Identifier: GPL-3.0-or-later
// The last changes of a mesh, whatever method made it.
#pragma once

#include "local/local_geometry.h"
#include "mesh/triangle_mesh.h"

#include <limits>
#include <vector>

namespace pcl
{
namespace floater
{
struct FinishSettings
{
  bool flip_edges = true; ///< flip edges and repair folds
  /// Share of all edges: if more are folded after the flips, nothing can mend the mesh, and the
  /// repair is left out.
  double largest_fold_share = std::numeric_limits<double>::infinity ();
};

/// What was done.
struct MeshFinish
{
  std::size_t flips = 0;
  std::size_t folds_after_flips = 0; ///< edges whose triangles were more than 120 degrees apart
  std::size_t folds = 0;             ///< those that are left
  bool is_repairable = true;         ///< false: more than FinishSettings::largest_fold_share
  std::size_t turned = 0;            ///< components that were turned round
};

/// Inserts points that have no triangle, flips edges, repairs the folds that are left, and turns
/// every component to face outwards.
/// \param positions of the mesh
/// \param geometry  normals of points that are vertices get the side of the mesh
MeshFinish
finishMesh (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
            LocalGeometry& geometry, const FinishSettings& settings, const RunContext& run);

} // namespace floater
} // namespace pcl

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The last changes of a mesh, whatever method made it: insertion, flips, repair, orientation.
#pragma once

#include "local/local_geometry.h"
#include "mesh/boundary_notches.h"
#include "mesh/facing.h"
#include "mesh/fold_repair.h"
#include "mesh/triangle_cost.h"
#include "mesh/triangle_mesh.h"
#include "points/neighbor_table.h"

#include <limits>
#include <vector>

namespace pcl::floater {
/// The limits of all steps of finishMesh.
struct FinishLimits
{
  CostLimits cost;
  RepairLimits repair;
  NotchLimits notches;
  FacingLimits facing;
};

struct FinishSettings
{
  bool flip_edges = true; ///< flip edges and repair folds

  /// Share of all edges. If more are folded after the flips, the mesh cannot be repaired, and the
  /// repair is skipped.
  double largest_fold_share = std::numeric_limits<double>::infinity ();
  FinishLimits limits = {};
  FacingHints facing = {};
  bool insert_points = true;  ///< insert points that have no triangle
  bool open_boundary = false; ///< take out what only fills notches of the boundary, or folds it
};

/// What finishMesh has done.
struct MeshFinish
{
  std::size_t flips = 0;
  std::size_t folds_after_flips = 0; ///< folded edges before the repair (see findFolds)
  std::size_t folds = 0;             ///< folded edges that are left
  bool is_repairable = true;         ///< false: more than FinishSettings::largest_fold_share of all
  MeshFacing facing;                 ///< which components were turned round, and why
};

/// What is known of the points of a mesh, or of a part of one.
struct RepairInput
{
  const std::vector<Eigen::Vector3d>& positions; ///< the vertices lie on them
  NeighborTable neighbors;                       ///< all are read only where there is something
                                                 ///< to insert or to repair
  const std::vector<float>& spacing;
  const std::vector<Index>& scatter;     ///< see LocalGeometry
  std::vector<Eigen::Vector3f>& normals; ///< are turned to the side of the mesh
};

/// The first part of finishMesh: inserts points, flips edges, repairs folds. Of a part of a mesh,
/// fixed triangles stay.
MeshFinish
repairMesh (TriangleMesh& mesh, const RepairInput& input, const FinishSettings& settings,
            const RunContext& run);

/// Takes out what only fills notches of the boundary, or folds it.
/// \param corners see openNotches
/// \param[in,out] finish of repairMesh
void
openBoundary (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
              std::vector<double> corners, const NotchLimits& limits, const RunContext& run,
              MeshFinish& finish);

/// Inserts points that have no triangle, flips edges, repairs the folds that are left, opens
/// notches and folds of the boundary, and turns every component to face outwards. O(n log n) at
/// worst.
///
/// \param positions of the points; the vertices lie on them
/// \param geometry  the normals of vertices are turned to the side of the mesh as it was before
///                  faceOutwards
MeshFinish
finishMesh (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
            LocalGeometry& geometry, const FinishSettings& settings, const RunContext& run);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Final changes of a mesh of any method: insertion, flips, repair, orientation.
#pragma once

#include "local/local_geometry.h"
#include "mesh/facing.h"
#include "mesh/fold_repair.h"
#include "mesh/open_boundary.h"
#include "mesh/remaking.h"
#include "mesh/triangle_cost.h"
#include "mesh/triangle_mesh.h"
#include "points/neighbors.h"

#include <limits>
#include <optional>
#include <vector>

namespace pcl::floater {
/// The limits of all steps of finishMesh.
struct FinishLimits
{
  CostLimits cost;
  RepairLimits repair;
  NotchLimits notches;
  RemakingLimits remaking;
  FacingLimits facing;
};

struct FinishSettings
{
  bool flip_edges = true; ///< flip edges and repair folds

  /// Share of all edges. If more are folded after the flips, the repair is skipped as hopeless.
  double largest_fold_share = std::numeric_limits<double>::infinity ();
  FinishLimits limits = {};
  FacingHints facing = {};
  bool insert_points = true;  ///< insert points that have no triangle
  bool find_crossing = false; ///< set MeshFinish::crossing
  bool remake_sheets = false; ///< make disturbed zones anew in space; needs find_crossing
  bool open_boundary = false; ///< remove triangles that fill notches of the boundary, or fold it
};

/// Result of finishMesh.
struct MeshFinish
{
  std::size_t flips = 0;
  std::size_t folds = 0;         ///< remaining folded edges
  bool is_repairable = true;     ///< false: more folds than FinishSettings::largest_fold_share
  std::size_t remade_points = 0; ///< whose triangles were made anew in space
  std::optional<CrossingPairs> crossing; ///< if asked for
  MeshFacing facing;                     ///< which components were flipped, and why
};

/// Inserts missing points, flips edges, repairs the remaining folds, opens notches and folds of the
/// boundary, and orients every component outwards. O(n log n) at worst.
/// \param positions of the points; the vertices lie on them
/// \param geometry  normals of vertices get the side of the mesh before faceOutwards ()
MeshFinish
finishMesh (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
            LocalGeometry& geometry, const FinishSettings& settings, const RunContext& run);

} // namespace pcl::floater

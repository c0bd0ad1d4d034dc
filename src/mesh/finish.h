// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Final changes of a mesh of any method: missing points, flips, repair, orientation.
#pragma once

#include "mesh/facing.h"
#include "mesh/flaw_repair.h"
#include "mesh/open_boundary.h"
#include "mesh/remaking.h"
#include "mesh/triangle_cost.h"
#include "mesh/vertex_splits.h"

namespace pcl::floater {
struct FinishSettings
{
  bool flip_edges = true;

  /// Share of all edges. If more are folded after the flips, repair is hopeless.
  double largest_fold_share = std::numeric_limits<double>::infinity ();
  RepairLimits limits = {}; ///< of the repair
  FacingHints facing = {};
  /// Asked once, if triangles cross that cannot be cured: another mesh of the same points, to be taken at
  /// chosen points. Chosen are the corners of the pairs; then those at which the other one differs. Without
  /// triangles, there is none. In noise, it is asked before the repair, which takes most of the time.
  std::function<TriangleMesh (Flags& is_chosen)> other = {};
  bool add_points = true;        ///< add points that have no triangle (see addMissingPoints)
  bool repair = false;           ///< repair flaws (see repairFlaws), and set MeshFinish::crossing
  bool remake_sheets = false;    ///< then make disturbed zones anew in space
  bool closes_gaps = true;       ///< boundary loops that are gaps between sheets may be closed then
  bool are_points_added = false; ///< leave the last repair to the caller, who adds points first
  bool open_boundary = false;    ///< remove triangles that fill notches of the boundary, or fold it
};

/// Result of finishMesh.
struct MeshFinish
{
  std::size_t flips = 0;
  std::size_t folds = 0;       ///< folded edges after the flips, before the repair
  bool is_repairable = true;   ///< false: more folds than FinishSettings::largest_fold_share
  std::size_t necks_cut = 0;   ///< necks that the points do not support
  std::size_t pairs_found = 0; ///< crossing pairs before any was removed
  Repairs repairs;
  RemadeZones remade;                    ///< made anew in space
  std::optional<CrossingPairs> crossing; ///< all pairs, if flaws were repaired
  MeshFacing facing;                     ///< which components were flipped, and why
};

/// Adds missing points, flips edges, opens notches and folds of the boundary, repairs folds and
/// self-intersections, and orients every component outwards. O(n log n) at worst.
/// \param positions of the points; the vertices lie on them
/// \param geometry  normals of vertices get the side of the mesh before faceOutwards ()
MeshFinish
finishMesh (TriangleMesh& mesh, const Positions& positions, LocalGeometry& geometry,
            const FinishSettings& settings, const RunContext& run);

/// Repairs flaws. finishMesh () does so, the last time unless points are to be added.
/// \param[in,out] finish knows all crossing pairs, and what was made anew
Repairs
repairMesh (TriangleMesh& mesh, const Positions& positions, LocalGeometry& geometry, Repair kind,
            const RepairLimits& limits, MeshFinish& finish, const RunContext& run);

/// Removes triangles at the boundary that still cross others, as long as fewer cross then and no point
/// is lost, and repairs again, except in noise.
void
openCrossings (TriangleMesh& mesh, const Positions& positions, LocalGeometry& geometry,
               const RepairLimits& limits, MeshFinish& finish, const RunContext& run);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Edge flips on a mesh in space.
#pragma once

#include "core/run_context.h"
#include "mesh/triangle_cost.h"
#include "mesh/triangle_mesh.h"

namespace pcl::floater {
/// Orients every normal towards the front of most of the area around its point. Normals of points
/// without triangles stay. Points whose triangles were made in space get the normal of these: there,
/// a tangent plane may belong to two sheets. O(n), on all threads.
/// \param is_remade of each point: its triangles were made in space; or empty
void
orientNormals (const TriangleMesh& mesh, const Positions& positions, Normals& normals,
               const RunContext& run, const Flags& is_remade = {});

/// Flips edges from a stack, and those around each flipped edge, until no flip lowers the cost of
/// the mesh. A flip changes the cost of two triangles and their five edges. In the plane, this is
/// the flip algorithm for Delaunay triangulations (Lee and Schachter 1980).
struct EdgeFlipper
{
  TriangleMesh& mesh;
  CachedCost& cost;
  RunContext run;
  std::vector<MeshEdge> stack = {};

  /// Empties the stack.
  /// \return number of flips
  std::size_t flipAll ();

  /// Whether the flip of this edge is possible and lowers the cost of the mesh.
  bool improves (MeshEdge e) const;
};

/// Flips edges of the whole mesh (see EdgeFlipper), but those of the boundary. Few edges are
/// flipped: those to begin with are found on all threads. O(n) in practice.
/// \return number of flips
std::size_t
flipEdges (TriangleMesh& mesh, const TriangleCost& cost, const RunContext& run);

} // namespace pcl::floater

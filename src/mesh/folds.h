// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Folded edges, and sharp ridges of the surface, which look like them.
#pragma once

#include "core/run_context.h"
#include "mesh/self_intersections.h"
#include "mesh/triangle_mesh.h"

namespace pcl::floater {
/// Tells a folded edge by the area vectors of its triangles: isFold (), or isBent ().
using AreFolded = bool (*) (const Vector3d&, const Vector3d&);

/// Folded edges, each once, in the order of their triangles. O(n).
std::vector<MeshEdge>
findFolds (const TriangleMesh& mesh, const Positions& positions, const RunContext& run,
           AreFolded are_folded = isFold);

/// Edges at sharp ridges, such as those of a blade.
struct Ridges
{
  std::vector<std::array<Index, 2>> ends; ///< the smaller index first; sorted

  bool has (Index a, Index b) const
  {
    return !ends.empty () && std::binary_search (ends.begin (), ends.end (),
                                                 std::array{std::min (a, b), std::max (a, b)});
  }
};

/// The edges where two triangles are more than 90 degrees apart, stick out of the body, were made
/// in space, and cross no other. In space, both sides of a ridge are seen, so such an edge is
/// trusted. Edges that point into the body are not: where sheets touch, the surface goes on
/// behind them. Outside is where a component has a positive volume, seen from its middle. O(n), or
/// O(1) if nothing was made in space.
/// \param crossing all pairs of the mesh
/// \param is_remade of each point: its triangles were made in space (see remakeZones); or empty
Ridges
findRidges (const TriangleMesh& mesh, const Positions& positions, const CrossingPairs& crossing,
            const Flags& is_remade, const RunContext& run);

} // namespace pcl::floater

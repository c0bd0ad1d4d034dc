// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts necks that the points do not support, and finds loops around necks.
#pragma once

#include "local/local_geometry.h"
#include "mesh/triangle_mesh.h"

namespace pcl::floater {
/// Cuts along short loops around necks (see findNeckLoops): takes out the triangles at the points of
/// a loop, on one side of it or on both, fills the two openings, and adds points that have no
/// triangle left. The cheapest of these cuts is made if what it changes is bent less then; of
/// cuts that overlap, the one that leaves the least share. A neck between sheets that only come close
/// bends twice by a right angle; across a true one, the fillings would. A cut takes a handle away, or
/// parts a component in two. O(n), plus about a millisecond for a loop.
/// \param geometry   normals oriented like the mesh (see orientNormals)
/// \param is_skipped of each point: none is looked for from there; empty: from all
/// \return number of necks that were cut
std::size_t
cutNecks (TriangleMesh& mesh, const Positions& positions, const LocalGeometry& geometry,
          Flags is_skipped, const RunContext& run);

/// Loops of at most `longest` edges around a neck with bent edges: a bridge between two parts of a
/// mesh, or a tunnel through a wall. Around each point of an edge that is bent by more than 60
/// degrees, triangles are taken breadth first. They are a disc, until they reach around a neck: then
/// the triangles beyond are in two parts, neither of them smaller than a sphere that such a loop
/// goes around. A short loop between these parts is taken. None is looked for beside the boundary.
/// O(n), plus some microseconds for each bent edge.
/// \param is_skipped of each point: no loop is looked for from there; empty: from all
/// \return the points of each loop, in order; the shortest loops first
std::vector<std::vector<Index>>
findNeckLoops (const TriangleMesh& mesh, const Positions& positions, const Flags& is_skipped,
               std::size_t longest, const RunContext& run);

} // namespace pcl::floater

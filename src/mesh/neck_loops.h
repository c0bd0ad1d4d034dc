// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Short loops of edges around necks of a mesh.
#pragma once

#include "core/run_context.h"
#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl::floater {
/// Loops of at most `longest` edges around a neck with bent edges: a bridge between two parts of a
/// mesh, or a tunnel through a wall. Around each point of an edge that is bent by more than 60
/// degrees, triangles are taken breadth first. They are a disc, until they reach around a neck: then
/// the triangles beyond are in two parts, neither of them smaller than a sphere that such a loop
/// goes around. A short loop between these parts is taken. None is looked for beside the boundary.
/// O(n), plus some microseconds for each bent edge.
/// \param is_skipped of each point: no loop is looked for from there; empty: from all
/// \return the points of each loop, in order; the shortest loops first
std::vector<std::vector<Index>>
findNeckLoops (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               const std::vector<std::uint8_t>& is_skipped, std::size_t longest,
               const RunContext& run);

} // namespace pcl::floater

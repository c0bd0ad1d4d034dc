// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Short loops of edges around and through the handles of a mesh.
#pragma once

#include "core/run_context.h"
#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl::floater {
/// Loops along which a mesh may be cut without falling apart, boundary loops taken for filled. One
/// of the shortest for each class of loops that are sums of each other and of triangles, modulo 2;
/// none for a class without a loop of at most `longest` edges. A random word stands for each class,
/// so that one is overlooked with a probability of 2^-64.
///
/// O(n) for a mesh without handles; otherwise also O(h d) for h handles and a mesh d triangles wide,
/// times the points within longest / 2 edges of a point. The caller's thread, but for the
/// components.
/// \return the points of each loop, in order; the shortest loops first
std::vector<std::vector<Index>>
findHandleLoops (const TriangleMesh& mesh, std::size_t longest, const RunContext& run);

} // namespace pcl::floater

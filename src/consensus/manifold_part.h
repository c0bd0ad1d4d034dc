// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The manifold part of a consensus.
#pragma once

#include "consensus/consensus.h"
#include "mesh/triangle_mesh.h"

namespace pcl::floater {
/// Keeps the fan of most votes around every point, and removes small islands. An island is an open
/// component with points of a larger component among its nearest neighbours: it lies in a hole of
/// that one. The result is an oriented manifold whose boundary loops pass each point at most once.
/// O(n).
/// \param neighbors       of each point
/// \param smallest_island smallest kept number of triangles of an island
/// \throws std::logic_error if the result is no manifold, which would be a bug
TriangleMesh
manifoldPart (Consensus consensus, const CsrLists& neighbors, std::size_t smallest_island,
              const RunContext& run);

} // namespace pcl::floater

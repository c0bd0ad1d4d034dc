// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The manifold part of a consensus.
#pragma once

#include "consensus/consensus.h"
#include "mesh/triangle_mesh.h"

namespace pcl
{
namespace floater
{
/// Keeps the fan of most votes around every point, and drops small islands. An island is an open
/// component that has points of a larger component among the nearest neighbours of its own points:
/// it lies in a hole of that one. What is left is an oriented manifold whose boundary loops pass
/// through each point once at most. O(n).
/// \param neighbors       of each point
/// \param smallest_island triangles; islands of fewer are dropped
/// \throw std::logic_error if the result is no manifold, which would be a bug
TriangleMesh
manifoldPart (Consensus consensus, const CsrLists& neighbors, std::size_t smallest_island,
              const RunContext& run);

} // namespace floater
} // namespace pcl

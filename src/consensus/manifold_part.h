// SPDX-License-Identifier: GPL-3.0-or-later
// From a consensus to a manifold.
#pragma once

#include "consensus/consensus.h"
#include "mesh/triangle_mesh.h"

namespace pcl
{
namespace floater
{
/// Keeps the largest fan of triangles around every point, and drops islands: components of fewer
/// than ISLAND triangles that are open and have points of a larger component among their nearest
/// neighbours; these lie in its holes. What is left is an oriented manifold whose rims are simple
/// loops. O(n). \throw std::logic_error if it is not
TriangleMesh
manifoldPart (Consensus consensus, const CsrLists& neighbors, const RunContext& run);

/// Smallest component that may stand alone.
constexpr std::size_t ISLAND = 32;

} // namespace floater
} // namespace pcl

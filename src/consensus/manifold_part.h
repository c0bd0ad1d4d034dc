// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The manifold part of a consensus.
#pragma once

#include "consensus/consensus.h"
#include "mesh/triangle_mesh.h"

#include <functional>
#include <optional>

namespace pcl::floater {
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

/// The nearest neighbours of a point.
using NeighborsOf = std::function<Row (Index point)>;

/// The same for a part of a larger consensus. At partial points, triangles are missing, and all
/// that there are stay. Components with such points, and those of partial points without a
/// triangle, count as large.
/// \param points number of points
/// \param neighbors_of asked of some points of small components only
/// \param is_partial of each point; empty: none is
/// \return nothing if triangles that are missing would have to be known: a triangle at a partial
///   point would be dropped
std::optional<TriangleMesh>
manifoldPart (Consensus consensus, std::size_t points, const NeighborsOf& neighbors_of,
              std::size_t smallest_island, std::vector<std::uint8_t> is_partial,
              const RunContext& run);

} // namespace pcl::floater

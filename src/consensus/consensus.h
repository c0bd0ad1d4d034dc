// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The triangles that stars agree on, as one oriented surface.
#pragma once

#include "consensus/candidates.h"
#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl::floater {
/// Consistently oriented triangles. Their sectors around each point do not overlap in its tangent
/// plane, so every edge has one or two. A point may still have several fans (see manifoldPart).
struct Consensus
{
  std::vector<Triangle> triangles; ///< ordered by their first corners, so that neighbours are close
                                   ///< in memory
  std::vector<std::uint8_t> votes; ///< of each triangle, 1 to 3
  std::vector<Triangle> seam;      ///< triangles of three votes that contradict the orientation: a
                                   ///< row of them on a one-sided surface
};

/// Accepts candidates greedily, by votes (three first), then by normal agreement. A candidate is
/// accepted if its sectors overlap no other one at its corners, and if it does not contradict the
/// orientation of the triangles connected to it (see Orientation). O(n) for sure candidates, O(m
/// log m) for m doubtful ones.
/// \param candidates see findCandidates
/// \param normals    in: unit normals by which the candidates were found; out: oriented like the
///     triangles
Consensus
buildConsensus (const std::vector<Eigen::Vector3d>& positions, std::vector<Candidate> candidates,
                const CandidateLimits& limits, std::vector<Eigen::Vector3f>& normals,
                const RunContext& run);

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

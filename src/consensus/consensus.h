// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The triangles that stars agree on, as one oriented surface.
#pragma once

#include "consensus/candidates.h"
#include "mesh/triangle_mesh.h"

#include <cstddef>
#include <optional>
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
  std::optional<std::vector<Index>> added_at; ///< extended mesh: corners of the added triangles;
                                              ///< all other points have at most one fan
};

/// Accepts candidates greedily, by votes (three first), then by normal agreement. A candidate is
/// accepted if its sectors overlap no other one at its corners, and if it does not contradict the
/// orientation of the triangles connected to it (see Orientation). O(n) for sure candidates, O(m
/// log m) for m doubtful ones.
/// \param candidates in: see findCandidates; out: accepted sure ones are marked
/// \param normals    in: unit normals by which the candidates were found; out: oriented like the
///     triangles
Consensus
buildConsensus (const std::vector<Eigen::Vector3d>& positions, CandidateLists& candidates,
                std::vector<Eigen::Vector3f>& normals, const RunContext& run);

/// Offers free candidates again along the boundary of a mesh. Its components were oriented one by
/// one; the candidates between two of them first vote on their relative orientation. O(n + m log m)
/// for m free candidates.
/// \param mesh      its triangles ordered by their first corners
/// \param normals   in: oriented like the triangles; out: like the new consensus
/// \param consensus out: the triangles of the mesh and the accepted candidates
/// \return false if no candidate is free; then nothing has changed
bool
extendConsensus (const std::vector<Eigen::Vector3d>& positions, const CandidateLists& candidates,
                 const TriangleMesh& mesh, std::vector<Eigen::Vector3f>& normals,
                 Consensus& consensus, const RunContext& run);

} // namespace pcl::floater

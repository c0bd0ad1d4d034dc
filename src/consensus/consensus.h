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
/// Consistently oriented triangles whose sectors around each point do not overlap in its tangent
/// plane, so that every edge has one or two. A point may still have several fans (see
/// manifoldPart).
struct Consensus
{
  std::vector<Triangle> triangles; ///< ordered by their first corners, so that neighbouring ones
                                   ///< are close in memory
  std::vector<std::uint8_t> votes; ///< of each triangle, 1 to 3
  std::vector<Triangle> seam;      ///< of three votes, left out because they contradict the
                                   ///< orientation: a row of them on a one-sided surface
  std::optional<std::vector<Index>> added_at; ///< of an extended mesh: corners of what was added;
                                              ///< all other points have one fan at most
};

/// Takes candidates greedily: those of three votes first, then of two, then of one; those of better
/// normal agreement first. A candidate is taken if its sector overlaps no other one at any of its
/// corners, and if it does not contradict the orientation of the triangles that are connected with
/// it (see Orientation). O(n) for sure candidates, O(m log m) for m doubtful ones.
/// \param candidates in: see findCandidates; out: the sure ones that were taken are marked
/// \param normals    in: unit normals by which the candidates were found; out: the same, oriented
///                   like the triangles
Consensus
buildConsensus (const std::vector<Eigen::Vector3d>& positions, CandidateLists& candidates,
                std::vector<Eigen::Vector3f>& normals, const RunContext& run);

/// Offers the candidates once more along the boundary of a mesh. Its components were oriented one
/// by one; now the candidates between two of them vote on whether one has to be turned round first.
/// O(n + m log m) for m candidates with room.
/// \param mesh      its triangles ordered by their first corners
/// \param normals   in: oriented like the triangles; out: like those of the new consensus
/// \param consensus out: the triangles of the mesh and the candidates that fit to them
/// \return false if there is room for no candidate; then nothing has changed
bool
extendConsensus (const std::vector<Eigen::Vector3d>& positions, const CandidateLists& candidates,
                 const TriangleMesh& mesh, std::vector<Eigen::Vector3f>& normals,
                 Consensus& consensus, const RunContext& run);

/// The same for candidates that are known to have room.
/// \param open with corners, votes and circumradius ratio; in any order, but equal ones keep it
/// \param mesh all of the mesh around the corners of the candidates, and any more of it
/// \param same_side points of one component of the mesh whose connection is not part of `mesh`
Consensus
extendConsensus (const std::vector<Eigen::Vector3d>& positions, std::vector<Candidate> open,
                 const TriangleMesh& mesh, const std::vector<std::array<Index, 2>>& same_side,
                 std::vector<Eigen::Vector3f>& normals, const RunContext& run);

} // namespace pcl::floater

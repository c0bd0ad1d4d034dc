// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles that stars agree on, put together to an oriented surface.
#pragma once

#include "consensus/candidates.h"
#include "mesh/triangle_mesh.h"

#include <cstddef>
#include <vector>

namespace pcl
{
namespace floater
{
/// Consistently oriented triangles whose sectors around each point are disjoint in its tangent
/// plane: every edge has one or two. A point may still have several fans (see manifold_part.h).
struct Consensus
{
  std::vector<Triangle> triangles; ///< ordered by their first corners: near ones near in memory
  std::vector<std::uint8_t> votes; ///< of each triangle
  std::vector<Triangle> seam;      ///< of three votes, left out since they would turn the
                                   ///< orientation round: a row of them on a one-sided surface
};

/// Accepts candidates greedily: three votes first, then two, then one; the better agreement first.
/// A candidate is taken if at none of its corners its sector overlaps one that is taken, and if it
/// is oriented like the triangles that it hangs together with: a forest of points tells whether two
/// normals point to the same side (union-find with parity). Normals get the signs so found.
/// O(n) for sure candidates, O(m log m) for m doubtful ones.
/// \param candidates what is taken of the sure ones is marked
/// \param normals in and out: unit normals of the points, those by which candidates were judged
Consensus
buildConsensus (const std::vector<Eigen::Vector3d>& positions, CandidateLists& candidates,
                std::vector<Eigen::Vector3f>& normals, const RunContext& run);

/// Offers the candidates once more to the rims of a mesh. Its components were oriented each by
/// itself; now the candidates that would join two of them vote on whether one is to be turned round
/// first. \param mesh triangles ordered by first corners \param normals as the triangles are
/// oriented \param consensus the mesh's triangles and those that fit to it; untouched if there is
/// no candidate \return false if there is no candidate
bool
extendConsensus (const std::vector<Eigen::Vector3d>& positions, const CandidateLists& candidates,
                 const TriangleMesh& mesh, std::vector<Eigen::Vector3f>& normals,
                 Consensus& consensus, const RunContext& run);

} // namespace floater
} // namespace pcl

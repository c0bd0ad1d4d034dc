// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh of one part of a cloud, and what others see of it.
#pragma once

#include "consensus/consensus_mesh.h"
#include "core/csr_lists.h"
#include "core/run_context.h"
#include "parts/parts.h"

#include <functional>
#include <vector>

namespace pcl::floater {
/// The points of a part, from the first one of the part on.
struct PartPoints
{
  Index first = 0; ///< the point that is point 0 here
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3f> normals; ///< those of the stars, of any sign
  std::vector<float> spacing;
  std::vector<Eigen::Vector3f> facing_normals = {}; ///< those of the cloud that tell its front, if
                                                    ///< they are to decide; else empty

  std::size_t size () const { return positions.size (); }
  bool has (Index point) const { return point >= first && point - first < size (); }
};

/// Candidates whose first corner is in a part.
struct PartCandidates
{
  CandidateLists inside; ///< for the mesh of the part; corners are counted from its first point on
  std::vector<Candidate> left; ///< offered when parts are stitched: those with corners in several
                               ///< parts, and doubtful ones beside these; corners are points
};

/// Divides candidates. Doubtful ones are left for the stitching if a corner has a neighbour of
/// another part in its star: else they could take the place of sure ones.
/// \param reaches_out of each point of the part: see reachesOut
PartCandidates
divideCandidates (CandidateLists of_part, Index first, Index last,
                  const std::vector<std::uint8_t>& reaches_out);

/// Of each of these points: 1 if its star has a neighbour of another part. O(entries).
/// \param stars of the points from `first` on, with points as neighbours
std::vector<std::uint8_t>
reachesOut (const CsrLists& stars, Index first, const Parts& parts);

/// The consensus mesh of a part.
struct PartMesh
{
  std::vector<Triangle> triangles; ///< corners are counted from the first point of the part on
  std::vector<Index> component;    ///< of each triangle
  Index components = 0;            ///< number of them
  std::vector<Eigen::Vector3f> smoothed; ///< smoothed normals, oriented like the triangles
  std::vector<Index> with_room;          ///< points without a triangle, and those at the boundary,
                                         ///< ascending; counted as the corners
  std::vector<Candidate> open; ///< candidates that are left, and those inside that have room at all
                               ///< corners; corners are points
};

/// The neighbours of some points of the part, nearest first: row i is that of points[i], which are
/// ascending. All are points of the cloud.
using NeighborRows = std::function<CsrLists (const std::vector<Index>& points)>;

/// The consensus of the candidates inside, and its manifold part (see makeConsensusMesh). O(n).
/// \param smoothed smoothed normals of the points
PartMesh
makePartMesh (const PartPoints& points, std::vector<Eigen::Vector3f> smoothed,
              PartCandidates candidates, const NeighborRows& neighbors,
              const ConsensusLimits& limits, const RunContext& run);

} // namespace pcl::floater

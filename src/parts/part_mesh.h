// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh of one part of a cloud.
#pragma once

#include "consensus/consensus_mesh.h"
#include "core/csr_lists.h"
#include "core/run_context.h"
#include "parts/parts.h"

#include <functional>
#include <vector>

namespace pcl::floater {
/// The points of a part, numbered from its first point.
struct PartPoints
{
  Index first = 0; ///< point of the cloud that is point 0 here
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3f> normals; ///< from the stars, of any sign
  std::vector<float> spacing;
  std::vector<Eigen::Vector3f> facing_normals = {}; ///< input normals that decide the front, if
                                                    ///< requested; otherwise empty

  std::size_t size () const { return positions.size (); }
  bool has (Index point) const { return point >= first && point - first < size (); }
};

/// Candidates whose first corner is in a part.
struct PartCandidates
{
  CandidateLists inside; ///< for the mesh of the part; corners are numbered from its first point
  std::vector<Candidate> left; ///< for the stitching: those with corners in several parts, and
                               ///< doubtful ones beside these; corners are points
};

/// Divides candidates. Doubtful ones are left for the stitching if a corner has a neighbour of
/// another part in its star: otherwise they could displace sure ones.
/// \param reaches_out of each point of the part: see reachesOut
PartCandidates
divideCandidates (CandidateLists of_part, Index first, Index last,
                  const std::vector<std::uint8_t>& reaches_out);

/// Of each point of some stars: 1 if its star has a neighbour in another part. O(entries).
/// \param stars of the points from `first` on, with points as neighbours
std::vector<std::uint8_t>
reachesOut (const CsrLists& stars, Index first, const Parts& parts);

/// The consensus mesh of a part.
struct PartMesh
{
  std::vector<Triangle> triangles;       ///< corners are numbered from the first point of the part
  std::vector<Index> component;          ///< of each triangle
  Index components = 0;                  ///< number of them
  std::vector<Eigen::Vector3f> smoothed; ///< smoothed normals, oriented like the triangles
  std::vector<Index> with_room;          ///< free points: without a triangle, or at the boundary;
                                         ///< ascending; numbered like the corners
  std::vector<Candidate> open; ///< candidates for the stitching, and free candidates inside;
                               ///< corners are points of the cloud
};

/// The neighbours of some points of the part (ascending), nearest first: row i belongs to
/// points[i]. All are points of the cloud.
using NeighborRows = std::function<CsrLists (const std::vector<Index>& points)>;

/// The consensus of the candidates inside, and its manifold part (see makeConsensusMesh). O(n).
/// \param smoothed smoothed normals of the points
PartMesh
makePartMesh (const PartPoints& points, std::vector<Eigen::Vector3f> smoothed,
              PartCandidates candidates, const NeighborRows& neighbors,
              const ConsensusLimits& limits, const RunContext& run);

} // namespace pcl::floater

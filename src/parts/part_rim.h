// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The rim of a part: its mesh near its boundary.
#pragma once

#include "parts/part_mesh.h"

#include <vector>

namespace pcl::floater {
/// The triangles of a part around its boundary, the data of their corners, and the free candidates.
/// Points are those of the cloud.
struct PartRim
{
  std::vector<Index> points; ///< of the part, ascending: corners, points without a triangle, and
                             ///< neighbours of both
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3f> normals;  ///< from the stars, of any sign
  std::vector<Eigen::Vector3f> smoothed; ///< oriented like the triangles
  std::vector<float> spacing;
  std::vector<std::uint8_t> is_partial; ///< some triangles of the point in the part are missing
                                        ///< here
  std::vector<std::uint8_t> has_room;   ///< free: it has no triangle, or is at the boundary
  CsrLists neighbors;                   ///< of free points and those beside them, nearest first;
                                        ///< otherwise empty

  std::vector<Triangle> triangles; ///< corners are indices of `points`
  std::vector<Index> numbers;      ///< of each triangle: its number in the part, ascending
  std::vector<Index> component;    ///< of each triangle
  Index components = 0;            ///< of the part

  std::vector<Candidate> open; ///< corners may be in other parts, and not free there

  std::vector<Index> others; ///< points of other parts that are neighbours, ascending
  std::vector<Eigen::Vector3d> other_positions;
  std::vector<Eigen::Vector3f> other_normals;
};

/// Appends positions and normals of points (ascending) to the arrays.
using OtherPoints =
    std::function<void (const std::vector<Index>& points, std::vector<Eigen::Vector3d>& positions,
                        std::vector<Eigen::Vector3f>& normals)>;

/// The rim of a part: all triangles with a corner fewer than `rings` edges away from a free point,
/// and all components of fewer than `smallest` triangles. O(rings n).
PartRim
findRim (const PartPoints& points, const PartMesh& mesh, const NeighborRows& neighbors,
         const OtherPoints& others, std::size_t rings, std::size_t smallest);

} // namespace pcl::floater

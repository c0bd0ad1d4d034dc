// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is known of a part where its mesh ends.
#pragma once

#include "parts/part_mesh.h"

#include <vector>

namespace pcl::floater {
/// The triangles of a part around its boundary, all that is known of their corners, and the
/// candidates for which there is room. Points are those of the cloud.
struct PartRim
{
  std::vector<Index> points; ///< of the part, ascending: corners, points without a triangle, and
                             ///< those in the lists of neighbours
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3f> normals;  ///< those of the stars, of any sign
  std::vector<Eigen::Vector3f> smoothed; ///< oriented like the triangles
  std::vector<float> spacing;
  std::vector<std::uint8_t> is_partial; ///< triangles around the point are missing here
  std::vector<std::uint8_t> has_room;   ///< it has no triangle, or is at the boundary
  CsrLists neighbors;                   ///< of points with room and those beside them, nearest
                                        ///< first; else empty

  std::vector<Triangle> triangles; ///< corners are places in `points`
  std::vector<Index> numbers;      ///< of each triangle: its number in the part, ascending
  std::vector<Index> component;    ///< of each triangle
  Index components = 0;            ///< of the part

  std::vector<Candidate> open; ///< corners may be in other parts, and have no room there

  std::vector<Index> others; ///< points of other parts that are neighbours, ascending
  std::vector<Eigen::Vector3d> other_positions;
  std::vector<Eigen::Vector3f> other_normals;
};

/// Positions and normals of points, which are ascending, appended to the arrays.
using OtherPoints =
    std::function<void (const std::vector<Index>& points, std::vector<Eigen::Vector3d>& positions,
                        std::vector<Eigen::Vector3f>& normals)>;

/// The rim of a part: all triangles with a corner that is fewer than `rings` edges away from a
/// point with room, and all of components of fewer than `smallest` triangles. O(rings n).
PartRim
findRim (const PartPoints& points, const PartMesh& mesh, const NeighborRows& neighbors,
         const OtherPoints& others, std::size_t rings, std::size_t smallest);

} // namespace pcl::floater

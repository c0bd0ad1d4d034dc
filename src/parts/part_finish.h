// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Final changes of the mesh of one part, away from the others.
#pragma once

#include "mesh/finish.h"
#include "parts/inner_check.h"
#include "parts/part_mesh.h"
#include "parts/stitching.h"

#include <vector>

namespace pcl::floater {
/// The triangles of a part around those with corners in several parts, and around the boundary,
/// with the data of their corners. Points are those of the cloud.
struct SeamZone
{
  std::vector<Index> points; ///< of the part, ascending: corners, and those without a triangle
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3f> normals; ///< oriented like the triangles
  std::vector<float> spacing;
  std::vector<std::uint8_t> is_partial; ///< some triangles of the point in the part are missing
                                        ///< here
  CsrLists neighbors;                   ///< of each point, nearest first
  std::vector<Triangle> triangles;
};

/// A finished part.
struct FinishedPart
{
  std::vector<Triangle> triangles; ///< inner triangles (outside the zone), in the order of their
                                   ///< smallest points; corners are points
  std::vector<Eigen::AlignedBox3d> buckets; ///< of the inner triangles, see makeTriangleBuckets
  InnerCheck check;                         ///< of the inner triangles
  SeamZone zone;
  std::size_t flips = 0;
  std::size_t folds_after_flips = 0; ///< see MeshFinish
  std::size_t folds = 0;             ///< remaining folds at triangles outside the zone
  std::vector<double> corners;       ///< see sampleCorners
};

/// Settings for finishing parts.
struct PartFinishSettings
{
  bool flip_edges = true;
  bool remove_self_intersections = true; ///< of inner triangles
  FinishLimits finish;
  UncrossingLimits uncrossing;
  InnerCheckSettings check;
  PartLimits parts;
  std::size_t part_count = 1; ///< parts share a sample of corners
};

/// Applies the changes of the stitching to the mesh of a part, inserts missing points, flips edges
/// and repairs folds, as finishMesh () does. Keeps triangles beside those with corners in other
/// parts. Then removes self-intersections outside the zone, and checks the triangles there. O(n log
/// n) at worst.
/// \param points    of the part; the vertices lie on their positions
/// \param triangles see PartMesh
FinishedPart
finishPart (PartPoints points, std::vector<Triangle> triangles, const PartChange& change,
            const NeighborRows& neighbors, const PartFinishSettings& settings,
            const RunContext& run);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The last changes of the mesh of one part, away from the others.
#pragma once

#include "mesh/finish.h"
#include "parts/inner_check.h"
#include "parts/part_mesh.h"
#include "parts/stitching.h"

#include <vector>

namespace pcl::floater {
/// The triangles of a part around those that have corners in several parts, and around the
/// boundary, and all that is known of their corners. Points are those of the cloud.
struct SeamZone
{
  std::vector<Index> points; ///< of the part, ascending: corners, and those without a triangle
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3f> normals; ///< oriented like the triangles
  std::vector<float> spacing;
  std::vector<std::uint8_t> is_partial; ///< triangles of the part around the point are missing here
  std::vector<std::uint8_t> is_scatter;
  CsrLists neighbors; ///< of each point, nearest first
  std::vector<Triangle> triangles;
};

/// A finished part.
struct FinishedPart
{
  std::vector<Triangle> triangles; ///< the inner ones, which are not in the zone, in the order of
                                   ///< their smallest points; corners are points
  std::vector<Eigen::AlignedBox3d> buckets; ///< of the inner triangles, see makeTriangleBuckets
  InnerCheck check;                         ///< of the inner triangles
  SeamZone zone;
  std::size_t flips = 0;
  std::size_t folds_after_flips = 0; ///< see MeshFinish
  std::size_t folds = 0;             ///< that are left, at triangles that are not in the zone
  std::vector<double> corners;       ///< see sampleCorners
};

/// How parts are finished.
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

/// Applies the changes of the stitching to the mesh of a part, inserts points that have no
/// triangle, flips edges and repairs folds, as finishMesh does. Triangles beside one that has
/// corners in another part are left as they are. What is not in the zone then is rid of triangles
/// that cross each other, and checked. O(n log n) at worst.
/// \param points    of the part; the positions are those on which the vertices lie
/// \param triangles see PartMesh
/// \param scatter   points of the part around which the cloud is flat at no scale, ascending;
///                  counted from its first point on
FinishedPart
finishPart (PartPoints points, std::vector<Triangle> triangles, const PartChange& change,
            const NeighborRows& neighbors, const std::vector<Index>& scatter,
            const PartFinishSettings& settings, const RunContext& run);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Inner triangles of parts that other parts need.
#pragma once

#include "core/types.h"
#include "parts/part_work.h"

#include <vector>

namespace pcl::floater {
/// Triangles of a mesh, and their corners, in the numbers of the mesh.
struct MeshRegion
{
  std::vector<Index> points;            ///< ascending
  std::vector<std::uint8_t> is_partial; ///< of each: some of its triangles are outside the region
  std::vector<Index> triangles;         ///< ascending
};

/// All triangles with a corner fewer than `rings` edges away from a seed, additional triangles, and
/// the seeds. O(rings n).
/// \param points number of points of the mesh
/// \param seeds points of the mesh; need not be vertices
/// \param besides of each triangle: 1 to include it anyway; empty: none
MeshRegion
regionAround (const std::vector<Triangle>& triangles, std::size_t points,
              const std::vector<Index>& seeds, std::size_t rings,
              const std::vector<std::uint8_t>& besides = {});

/// Some inner triangles.
struct NearTriangles
{
  std::vector<Triangle> triangles; ///< corners are points
  std::vector<Index> part;         ///< of each triangle
  std::vector<Index> component;    ///< of each triangle, among the inner ones of its part; NONE if
                                   ///< it has no corner in the zone
  std::vector<Index> points;       ///< all corners, ascending
  PointValues values;              ///< of these

  void reserve (std::size_t triangle_count, std::size_t point_count);

  /// In the order of the parts.
  void add (const NearTriangles& next);
};

/// The inner triangles that have a corner in a zone, that overlap (by boxes) a triangle of a zone,
/// or may overlap an inner triangle of another part. O(n / 64) for n points to test the buckets,
/// and O(m log m) for m triangles in the buckets that are read.
/// \param seam           all other triangles, in the order of their smallest points
/// \param seam_positions of their corners
/// \param checks         of all parts
NearTriangles
findNearTriangles (const std::vector<Triangle>& seam,
                   const std::vector<Eigen::Vector3d>& seam_positions,
                   const std::vector<InnerCheck>& checks, PartWork& work, const RunContext& run);

} // namespace pcl::floater

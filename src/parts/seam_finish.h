// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Final changes of a mesh where the parts meet.
#pragma once

#include "parts/part_finish.h"

#include <vector>

namespace pcl::floater {
/// The zones of all parts. Points are indices of `points`.
struct JoinedZones
{
  std::vector<Index> points; ///< ascending
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3f> normals;
  std::vector<float> spacing;
  std::vector<Index> scatter; ///< ascending
  CsrLists neighbors;         ///< points of the cloud; after the seam is finished: indices
  std::vector<std::uint8_t> is_partial;
  std::vector<Triangle> triangles;

  /// In the order of the parts.
  void add (const SeamZone& zone);
};

/// The finished mesh where parts meet, and around its boundary.
struct FinishedSeam
{
  JoinedZones zones;               ///< with normals on the side of the mesh; without triangles
  std::vector<Triangle> triangles; ///< of all zones, and between them; corners are indices
  MeshFinish finish; ///< without the reports of the parts; folds: remaining ones in all zones
};

/// Inserts missing points, flips edges and repairs folds around the triangles with corners in
/// several parts (see repairMesh), and opens the boundary of the whole mesh (see openBoundary).
/// Triangles beside inner ones stay. O(m log m) at worst, for m points in all zones.
/// \param seam    see Stitching
/// \param corners of all parts, see sampleCorners
/// \param rings   of triangles to be repaired around the seam
FinishedSeam
finishSeam (JoinedZones zones, const std::vector<Triangle>& seam, std::vector<double> corners,
            const FinishSettings& settings, std::size_t rings, const RunContext& run);

} // namespace pcl::floater

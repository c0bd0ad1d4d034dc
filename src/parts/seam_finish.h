// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Final changes of a mesh where the parts meet.
#pragma once

#include "mesh/triangle_mesh.h"
#include "parts/joined_rims.h"
#include "parts/near_triangles.h"
#include "parts/part_finish.h"

#include <vector>

namespace pcl::floater {
/// Components in the order of their smallest points.
struct SeamComponents
{
  std::vector<std::size_t> points;          ///< number of points of each component
  std::vector<Index> first;                 ///< the smallest point of each
  std::vector<Index> of_point;              ///< of each point of a zone, NONE without a triangle;
                                            ///< undefined for other points
  std::vector<std::vector<Index>> of_inner; ///< of the components of the inner triangles of each
                                            ///< part

  std::size_t count () const { return points.size (); }
};

/// Joins the components of the parts.
/// \param points of zones, and of inner triangles near them: the latter are partial
/// \param mesh   zone triangles, then the near ones; corners are indices of `points`
/// \param seam   number of zone triangles
SeamComponents
joinComponents (const JoinedPoints& points, const TriangleMesh& mesh, std::size_t seam,
                const NearTriangles& near, const std::vector<InnerCheck>& checks);

/// The zones of all parts. Points are indices of `points`.
struct JoinedZones
{
  std::vector<Index> points; ///< ascending
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3f> normals;
  std::vector<float> spacing;
  CsrLists neighbors; ///< points of the cloud; after the seam is finished: indices
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

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A zone of a mesh as a place whose triangles are made anew.
#pragma once

#include "core/csr_lists.h"
#include "mesh/disturbed_zones.h"
#include "mesh/two_sides.h"

#include <vector>

namespace pcl::floater {
/// A place, and what it is of the mesh.
struct PlaceOfMesh
{
  Place place;
  std::vector<Index> points; ///< of each point of the place: which it is; ascending
  std::vector<Index> frame;  ///< of each triangle of the frame: which it is
  std::vector<Triangle> old; ///< triangles that go, by points of the place
};

/// The place of some free points, with two rings around: points that share an edge, and the nearest
/// ones. The free points need not be a zone, and may be more than one. O(points in the place).
/// \param neighbors of each point of the mesh, nearest first
/// \param zones     all zones of the mesh: triangles at their free points are not in the frame
PlaceOfMesh
placeOf (Row free, const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
         const CsrLists& neighbors, const DisturbedZones& zones);

} // namespace pcl::floater

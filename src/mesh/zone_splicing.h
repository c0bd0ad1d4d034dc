// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Zones of a mesh as places whose triangles are made anew, and how they are put back.
#pragma once

#include "mesh/disturbed_zones.h"
#include "mesh/two_sides.h"

namespace pcl::floater {
/// A zone made anew.
struct NewZone
{
  std::vector<Index> points; ///< whose triangles go
  std::vector<Triangle> triangles;
  std::vector<std::pair<Index, bool>> patches; ///< of the frame: a triangle of the mesh in it, and
                                               ///< whether it is turned against the new ones
};

/// The triangles of the mesh with new zones, turned so that neighbours face one side; where sides
/// differ, that of most triangles is kept. O(n log n).
/// \param[in,out] made loses zones that overlap an earlier one or contradict the sides of others
std::vector<Triangle>
spliceZones (const TriangleMesh& mesh, std::vector<std::optional<NewZone>>& made);

/// What another mesh of the same points has at chosen points, as zones of a mesh. Triangles that only one of the
/// two has, and that are connected by corners, come and go together. O(n).
/// \param[in,out] is_chosen of each point; then: it is in a zone
std::vector<std::optional<NewZone>>
placesOf (const TriangleMesh& other, const TriangleMesh& mesh, Flags& is_chosen);

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
placeOf (Row free, const TriangleMesh& mesh, const Positions& positions, const CsrLists& neighbors,
         const DisturbedZones& zones);

} // namespace pcl::floater

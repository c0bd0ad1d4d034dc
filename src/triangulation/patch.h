// SPDX-License-Identifier: GPL-3.0-or-later
// A small piece of a mesh, cut out to be triangulated anew.
#pragma once

#include "triangulation/surface_mesh.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Triangles around a place and their vertices, numbered from 0. The rim, and the edges of the
/// surface's own boundary, stay as they are.
struct Patch
{
  /// An edge of the rim with the triangle behind it.
  struct RimEdge
  {
    Index from, to;         // of the patch, the patch on the left
    MeshEdge outside;       // the edge of the mesh as seen from outside
    Eigen::Vector3d normal; // of the outside triangle, unit length
  };

  SurfaceMesh mesh;          ///< over the patch's own points
  std::vector<Index> points; ///< of the whole mesh, by patch point; ascending
  std::vector<Index> slots;  ///< triangles of the whole mesh that the patch stands for
  std::vector<RimEdge> rim;  ///< ordered by (from, to)
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3f> normals; ///< oriented like the mesh
};

/// Cuts out the triangles within `rings` vertex rings of some triangles.
Patch
cutPatch (const SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
          const std::vector<Eigen::Vector3f>& normals, const std::vector<Index>& triangles,
          int rings);

/// Puts a patch, triangulated anew with as many triangles and the same rim, back in its place.
void
pastePatch (const Patch& patch, SurfaceMesh& mesh);

/// True if p and q of the patch are joined by an edge of the whole mesh outside of the patch.
bool
joinedOutside (const Patch& patch, const SurfaceMesh& whole, Index p, Index q);

} // namespace floater
} // namespace pcl

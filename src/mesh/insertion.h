// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Insertion of points that have no triangle yet.
#pragma once

#include "mesh/flips.h"
#include "mesh/triangle_mesh.h"

namespace pcl::floater {
/// Whether there are points that insertMissingPoints would insert if it could. O(n).
bool
isAnyMissing (const TriangleMesh& mesh);

/// Inserts every point that is not a vertex but has vertices among its nearest neighbours. Of the
/// triangles around these, the one whose split at the point costs least is split. The point whose
/// split costs least comes first, since it shows the next ones where the surface is; a point that
/// has only missing neighbours follows once one of these is inserted. Fixed triangles stay. O(m log
/// m) for m missing points.
/// \param neighbors of each point, nearest first
/// \param flip      whether edges around each inserted point are flipped at once
/// \return number of points inserted
std::size_t
insertMissingPoints (TriangleMesh& mesh, const CsrLists& neighbors, const TriangleCost& cost,
                     bool flip, const RunContext& run);

/// Gives the normal of a point that is not a vertex the side of the mean normal of those of these
/// neighbours that are vertices.
void
orientMissingNormal (const TriangleMesh& mesh, Index p, const Row& neighbors,
                     std::vector<Eigen::Vector3f>& normals);

/// Gives the normal of every point that is not a vertex the side of the mean normal of those
/// nearest neighbours that are vertices. O(n).
void
orientMissingNormals (const TriangleMesh& mesh, const CsrLists& neighbors,
                      std::vector<Eigen::Vector3f>& normals, const RunContext& run);

} // namespace pcl::floater

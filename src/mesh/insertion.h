// SPDX-License-Identifier: GPL-3.0-or-later
// Points that have no triangle yet.
#pragma once

#include "mesh/flips.h"
#include "mesh/triangle_mesh.h"

namespace pcl
{
namespace floater
{
/// Inserts every point that is not a vertex but has vertices among its nearest neighbours: the
/// triangle around those whose split costs least is split at the point, which goes on until nothing
/// changes, so that a row of points finds its way in. The point whose place costs least comes
/// first, for it tells the next ones where the surface runs. O(m log m) for m missing points.
/// \param flip whether edges are flipped around each point as soon as it is in
/// \return number of points inserted
std::size_t
insertMissingPoints (TriangleMesh& mesh, const CsrLists& neighbors, const TriangleCost& cost,
                     bool flip, const RunContext& run);

/// Gives the normal of every point that is no vertex the sign that most of its nearest neighbours
/// have which are.
void
orientMissingNormals (const TriangleMesh& mesh, const CsrLists& neighbors,
                      std::vector<Eigen::Vector3f>& normals);

} // namespace floater
} // namespace pcl

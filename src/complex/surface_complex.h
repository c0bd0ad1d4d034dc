// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles that stars agree on, put together to an oriented surface.
#pragma once

#include "complex/candidate_triangles.h"
#include "triangulation/surface_mesh.h"

#include <cstddef>
#include <vector>

namespace pcl
{
namespace floater
{
/// Consistently oriented triangles whose sectors around each point are disjoint in its tangent
/// plane: every edge has one or two. A point may still have several fans (see manifold_part.h).
struct SurfaceComplex
{
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> votes; ///< of each triangle
  std::vector<Triangle> misfits;   ///< of three votes, left out since they would turn the
                                   ///< orientation round: a row of them on a one-sided surface
};

/// Accepts candidates greedily: three votes first, then two, then one; the better agreement first.
/// A candidate is taken if at none of its corners its sector overlaps one that is taken, and if it
/// is oriented like the triangles that it hangs together with: a forest of points tells whether two
/// normals point to the same side (union-find with parity). Normals get the signs so found.
/// O(n log n) for the candidates of one and two votes.
/// \param normals in and out: unit normals of the points
SurfaceComplex
buildComplex (const std::vector<Eigen::Vector3d>& positions,
              const std::vector<Candidate>& candidates, std::vector<Eigen::Vector3f>& normals);

/// Offers the candidates once more to the rims of a mesh. Its pieces were oriented each by itself;
/// now the candidates that would join two of them vote on whether one is to be turned round first.
/// \param normals as the triangles are oriented
SurfaceComplex
extendComplex (const std::vector<Eigen::Vector3d>& positions,
               const std::vector<Candidate>& candidates, const SurfaceMesh& mesh,
               std::vector<Eigen::Vector3f>& normals);

} // namespace floater
} // namespace pcl

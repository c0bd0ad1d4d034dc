// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The surface without its noise, where that is strong.
#pragma once

#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// What counts as noise.
struct SmoothingLimits
{
  /// Mean over the edges at a vertex of the angles at which the surface bends outwards, and of
  /// those at which it bends inwards; rough is where both are larger. Bodies, however coarse, and
  /// creases bend one way. A vertex is rough if half of those beside it bend both ways, too. Noise
  /// of a tenth of the spacing bends both ways by 10 degrees; in radians.
  double bend = 0.14;

  int rounds = 20; ///< at most; noise as large as the spacing takes 10
};

/// Moves rough vertices to the mean of their neighbours, on the boundary to that of the two along
/// it, until no vertex is rough. Charts are found and laid out on this surface: on the noisy one,
/// triangles face all ways, and there are as many charts as bumps. O(n) for each round; one if
/// there is no noise.
/// \return positions per point; those of other vertices are unchanged
std::vector<Eigen::Vector3d>
smoothNoise (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
             const SmoothingLimits& limits, const RunContext& run);

} // namespace floater
} // namespace pcl

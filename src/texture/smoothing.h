// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The surface without its noise, where that is strong.
#pragma once

#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl::floater {
/// What counts as noise.
struct SmoothingLimits
{
  /// Mean over the edges at a vertex and at those beside it of the angles at which the surface
  /// bends outwards, and of those at which it bends inwards, in radians; where both are larger, it
  /// bends both ways. Bodies, however coarse, and creases bend one way. With angles that scatter by
  /// 20 degrees, as noise of a tenth of the spacing makes them, it is 0.14. A vertex is rough if it
  /// and half of those beside it bend both ways.
  double bend = 0.14;

  /// The same mean around a vertex of noise at which it is smooth. With it, noise as large as the
  /// spacing leaves normals of a plane that differ by 4 degrees from triangle to triangle, and by 6
  /// from that of the plane (medians).
  double smooth = 0.06;

  /// Rings of vertices around rough ones that are smoothed as well, where they are not smooth yet:
  /// what is measured in steps, as depth is, is flat between them.
  int rings = 3;

  int rounds = 20; ///< at most; noise as large as the spacing takes 10

  /// How far a vertex may be moved, in mean lengths of the edges at the vertices around it, where
  /// these are longest: as far as noise that can still be connected. Without this, thin parts would
  /// shrink to lines.
  double farthest = 1.0;
};

/// Moves rough vertices, and those around them, to the mean of their neighbours, on the boundary to
/// that of the two along it, until they are smooth. Charts are found and laid out on this surface:
/// on the noisy one, triangles face all ways, and there are as many charts as bumps. O(n) for each
/// round; one if there is no noise.
/// \return positions per point; those of other vertices are unchanged
std::vector<Eigen::Vector3d>
smoothNoise (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
             const SmoothingLimits& limits, const RunContext& run);

} // namespace pcl::floater

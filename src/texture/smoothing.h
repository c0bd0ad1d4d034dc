// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Smoothing of strong noise.
#pragma once

#include "mesh/triangle_mesh.h"

namespace pcl::floater {
/// Thresholds of noise.
struct SmoothingLimits
{
  /// Threshold in radians for the mean outward and the mean inward bend at the edges of a vertex
  /// and its neighbours: if both are above, the surface bends both ways. Bodies, however coarse,
  /// and creases bend one way. With angles that scatter by 20 degrees, as for noise of a tenth of
  /// the spacing, it is 0.14. A vertex is rough if it and half of its neighbours bend both ways.
  double bend = 0.14;

  /// Bend below which a vertex of noise is smooth. With it, noise as large as the spacing leaves
  /// normals of a plane that differ by 4 degrees between triangles, and by 6 from the plane
  /// (medians).
  double smooth = 0.06;

  /// Rings of vertices around rough ones that are smoothed as well, unless smooth: quantized depths
  /// are flat between their steps.
  int rings = 3;

  int rounds = 20; ///< maximum; noise as large as the spacing takes 10

  /// Largest displacement of a vertex, in mean lengths of the edges at the vertices around it,
  /// where these are longest: the largest noise that can be connected. Without this, thin parts
  /// would shrink to lines.
  double farthest = 1.0;
};

/// Moves rough vertices, and those around them, to the mean of their neighbours (at the boundary,
/// of those along it) until they are smooth. Charts are found and laid out on this surface: on the
/// noisy one, normals are random, and every bump becomes a chart. O(n) for each round; one if there
/// is no noise.
/// \return positions per point; other vertices are unchanged
Positions
smoothNoise (const TriangleMesh& mesh, const Positions& positions, const SmoothingLimits& limits,
             const RunContext& run);

} // namespace pcl::floater

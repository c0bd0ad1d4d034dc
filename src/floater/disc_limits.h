// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Thresholds of the disc method, from the boundary loop to the mesh.
#pragma once

#include <cstddef>

namespace pcl::floater {
/// Thresholds for the mesh of a disc.
struct DiscLimits
{
  /// Smallest share of all points connected with the boundary loop; below, the cloud counts as
  /// several components (UNREACHABLE). Not derived from data, and not certain.
  /// others together. Not derived from data, and not certain.
  double least_reached_share = 0.5;

  /// Maximum number of links of a point that is not connected with the loop. With one link a lone
  /// point would coincide with its neighbour, and with two lie on the line between them; three is
  /// the least number that places it freely in the plane.
  std::size_t links_per_point = 3;

  /// Scale of the parameterization (length in the plane over length in space) relative to that of
  /// the loop, below which a triangle has collapsed. Neighbours among a million points are about
  /// 1e-3 apart on the circle, and parameters are accurate to about 1e-13, so at this depth
  /// positions are accurate to 1e-4 of their distance. No real cloud with a clean disc has such a
  /// region; 1e-3 made one real cloud (nefertiti) worse.
  double collapsed_scale = 1e-6;

  /// Share of all edges: if more are folded after the flips, the surface is no disc. On 24 clouds,
  /// discs had up to 0.01 and closed surfaces that were laid out as discs 0.04 or more.
  double largest_fold_share = 0.03;
};

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Thresholds of the disc method, from the boundary loop to the mesh.
#pragma once

#include <cstddef>

namespace pcl::floater {
/// Thresholds that decide what the mesh of a disc is, or whether there is one.
struct DiscLimits
{
  /// Share of all points, from 0 to 1: if fewer are connected with the boundary loop, the cloud is
  /// taken for several components (UNREACHABLE). The loop's component then holds less than the
  /// others together. Not derived from data, and not certain.
  double least_reached_share = 0.5;

  /// Links that a point gets at most if it is not connected with the loop. With a single link a
  /// lone point would fall on the point that it is linked to, and with two on the line between
  /// them; three is the least number that places it freely in the plane.
  std::size_t links_per_point = 3;

  /// Scale of the parameterization (length in the plane over length in space) relative to that of
  /// the loop. A triangle with a smaller scale has collapsed. Neighbours among a million points are
  /// about 1e-3 apart on the circle, and parameters are accurate to about 1e-13, so at this depth
  /// places are still good to 1e-4 of their distance. No real cloud with a clean disc has such a
  /// region; 1e-3 made one real cloud (nefertiti) worse.
  double collapsed_scale = 1e-6;

  /// Share of all edges, from 0 to 1: if more are folded after the flips, the surface is no disc.
  /// On 24 clouds, discs had up to 0.01 and closed surfaces that were laid out as discs 0.04 or
  /// more; the value lies between.
  double largest_fold_share = 0.03;
};

} // namespace pcl::floater

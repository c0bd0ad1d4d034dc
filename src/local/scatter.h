// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Scatter: points that lie on no surface at any scale, such as leaves.
#pragma once

#include "local/local_geometry.h"
#include "points/noise.h"

namespace pcl::floater {
/// Thresholds of scatter. Measures of a point: its unevenness and its dimension (see Noise), and
/// the share of the triangles of the stars around it that are in the stars of all their corners.
/// Measured on 24 generated families of 1.4 million points. Points strewn into volumes and lattices
/// have an unevenness of 0.49 or more and a share of 0.49 or less, leaves 0.25 to 0.6 and 0.2 to
/// 0.85. Sheets with noise of one spacing have 0.37 or less; thin walls, edges and contacts 0.5 or
/// less, with a share of 0.4 or more. Neither measure tells these apart, nor both of them at single
/// points. Regions of thin, noisy things, such as legs, ears and heads with eyes inside, look the
/// same by both, but only a volume has more than two dimensions.
struct ScatterLimits
{
  double strong_share = 0.6;    ///< of agreeing triangles; at most so many at a strong point, where
                                ///< the cloud is uneven
  double weak_unevenness = 0.2; ///< a point may be scatter from here on, ...
  double weak_share = 0.9;      ///< ... and with at most this share
  std::size_t least = 250;      ///< strong points of a region
  /// Mean of the strong points of a region that certainly is scatter: of their dimension, or of the
  /// one to expect at the next scale, by what it has grown since the scale before. Half way between
  /// surface and volume. Volumes, lattices, leaves and trees of more than 800 points have 2.57 or
  /// more; smaller trees 1.5 to 2.5, since the outside of a small volume counts. 16 models of 800 to
  /// 37,000 points with noise of up to 0.5 spacings have 2.48 or less, sheets with noise of up to 3,
  /// and two near ones, 2.52.
  double dimension = 2.55;
  /// Less is enough for a region whose strong points mostly are not noisy, a tree for instance. The
  /// noise of a sheet or body falls with the scale: these models have 0.72 or less.
  double dimension_if_not_noisy = 2.31, not_noisy = 0.75;

  /// Spacing, in medians of the cloud, from which on a point is far: such triangles have 64 times
  /// the area, so that 2 % of them are more than half of a mesh.
  double far_spacing = 8.0;
  double around_far = 2.0; ///< the same of points that may belong to a region of far ones
  /// Share at far points on no surface. Points strewn into a cone have 0.28 to 0.35 on average,
  /// coarse walls, terrain and balls with noise of up to 0.3 of their spacings 0.54 or more. Half
  /// of the far points of a region must have so little.
  double far_share = 0.45;
  std::size_t least_far = 10; ///< far points of a region, so that the half is certain
};

/// Finds scatter as regions: points that may be scatter and hang together by their nearest
/// neighbours, many of which are strong; and likewise among far points. O(n).
/// \param noise      its unevenness may be empty
/// \param uneven     unevenness of strong points
/// \param is_certain only regions that certainly are scatter
/// \return ascending
std::vector<Index>
findScatter (const LocalGeometry& geometry, const Noise& noise, double uneven, bool is_certain,
             const ScatterLimits& limits, const RunContext& run);

} // namespace pcl::floater

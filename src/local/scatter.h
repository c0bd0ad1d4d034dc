// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Scatter: points that lie on no surface at any scale, such as leaves.
#pragma once

#include "local/stars.h"

#include <vector>

namespace pcl::floater {
/// Thresholds of scatter. Two measures of a point: its unevenness (see Noise), and the share of the
/// triangles of the stars around it that are in the stars of all their corners. Measured on 17
/// generated families of 300,000 points: points strewn into volumes and lattices have an unevenness
/// of 0.49 or more and a share of 0.49 or less, leaves 0.25 to 0.6 and 0.2 to 0.85. Sheets with
/// noise of one spacing have 0.37 or less; thin walls, edges and contacts 0.5 or less, with a share
/// of 0.4 or more. Neither measure alone tells these apart, nor both of them at single points. In
/// regions, each threshold can be moved by a fifth without one point of a sheet being lost.
struct ScatterLimits
{
  double strong_share = 0.6;    ///< of agreeing triangles; at most so many at a strong point, where
                                ///< the cloud is uneven
  double weak_unevenness = 0.2; ///< a point may be scatter from here on, ...
  double weak_share = 0.9;      ///< ... and with at most this share
  std::size_t least = 150; ///< strong points of a region: thin walls of scanned statues have up
                           ///< to 48

  /// The same for what is certainly scatter. The head of a sparsely sampled cat, with eyes and jaws
  /// inside, has 330 strong points by the limits above, and 190 by this share.
  double certain_share = 0.45;
  std::size_t certain_least = 500;
};

/// Finds scatter as regions: points that may be scatter and hang together by their nearest
/// neighbours, many of which are strong. O(n).
/// \param neighbors  of each point, nearest first
/// \param unevenness of each point
/// \param uneven     unevenness of strong points
/// \param is_certain only regions that certainly are scatter
/// \return ascending
std::vector<Index>
findScatter (const CsrLists& neighbors, const Stars& stars, const std::vector<float>& unevenness,
             double uneven, bool is_certain, const ScatterLimits& limits, const RunContext& run);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Thresholds of the boundary stage.
#pragma once

#include "core/types.h"

#include <array>

namespace pcl::floater {
/// Thresholds for the loop of a disc. Lengths are in local spacings (see localSpacing ()) unless
/// noted.
///
/// The values of the spanning tree and of the refinement were chosen together on 33 real clouds; 28
/// of these got the right loop. They were not varied one by one, so none of them is certain.
struct LoopLimits
{
  // Spanning tree.

  /// Circumradius ratios (circumradius over the mean spacing of the corners) above which a triangle
  /// of a star counts as missing. Each gives one loop; the longest trusted loop wins. For
  /// comparison: an equilateral triangle has a ratio of 0.58, half a square one of 0.71.
  std::array<double, 3> circumradius_ratios{1.5, 2.0, 2.5};
  /// Longest edge between two candidates.
  double longest_edge = 6.0;
  /// A loop without a longer step is trusted. The experiments used values from 3 to 5.
  double largest_trusted_step = 4.0;
  /// Cost per length of an edge whose ends are both at the end of the other's gap. An edge between
  /// candidates that are only near each other costs 1 per length.
  double mutual_cost = 0.05;
  /// Cost per length of an edge where only one end is at the end of the other's gap.
  double one_sided_cost = 0.4;
  /// Factor of length by which a loop replaces an equally trustworthy earlier one. Keeps the
  /// smaller circumradius ratio if loops differ little more than their jags.
  double least_gain = 1.02;

  // Refinement.

  /// Longest detour over a candidate that is inserted.
  double largest_detour = 3.0;
  /// Share of an edge's length: a candidate at most so far on the inner side of the edge still
  /// counts as beyond it.
  double edge_margin = 0.1;

  // Two segments.

  /// k at which a segment begins to grow (TW 385, section 3.3).
  Index first_k = 3;
  /// k up to which it is incremented. Beyond that, a segment continues over the bridges of the
  /// neighbour graph. Tested on generated borders only; not certain.
  Index largest_k = 16;
  /// Numbers of neighbours that are tried in the univariate parameterization; the shortest order is
  /// taken. Tested on generated borders, smooth and jagged; not certain.
  std::array<Index, 3> univariate_k{3, 4, 5};

  // Check of a loop that was found.

  /// Fewest points of a loop in a cloud of more than `few_points` points. A shorter loop is a gap
  /// in the sampling of a closed surface. Of the real discs, the shortest boundary has 36 points;
  /// not certain.
  std::size_t shortest_loop = 10;
  /// Points of a cloud up to which any loop is accepted. Not derived from data.
  std::size_t few_points = 100;
};

} // namespace pcl::floater

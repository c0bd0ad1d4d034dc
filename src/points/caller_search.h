// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The caller's search structure, for points of the working set.
#pragma once

#include "points/kd_tree.h"
#include "points/points.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl::floater {
/// Translates between points and cloud indices, and validates the answers: repeated and unknown
/// indices are ignored, distances are measured here. For one thread.
class CallerSearch
{
public:
  /// Builds the search on the points of the set. O(n log n) plus the time of the search.
  CallerSearch (const Points& points, NeighborSearch& search);

  /// The k nearest other points, nearest first, ties by index; fewer if the search finds fewer.
  void nearest (Index p, std::size_t k, std::vector<Neighbor>& found);

  /// The other points within `radius` (that distance included), nearest first, ties by index.
  void within (Index p, double radius, std::vector<Neighbor>& found);

private:
  void translate (Index p, std::vector<Neighbor>& found) const;

  const Points& points_;
  NeighborSearch& search_;
  std::vector<Index> point_of_;      // by cloud index
  std::vector<Index> cloud_indices_; // scratch: the answer of the search
};

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/net.h"

#include "core/geometry.h"
#include "core/order_statistics.h"
#include "core/parallel.h"

namespace pcl::floater {
namespace {
// Spacing around a point, by its row of neighbours; that of a cluster, by the points around it.
double
spacingAround (const Positions& positions, Index p, const Row& row)
{
  // A point that has its six nearest within this part of the distance to the last one is in a
  // cluster: its spacing is CLUSTER_SPACING of that distance, as between 20 points on a plane.
  constexpr double CLUSTER = 0.1, CLUSTER_SPACING = 0.4;
  const std::size_t count = std::min<std::size_t> (row.size (), SPACING_NEIGHBORS);
  const double last = distanceBetween (positions, p, row[row.size () - 1]);
  return distanceBetween (positions, p, row[count - 1]) < CLUSTER * last
             ? CLUSTER_SPACING * last
             : spacingOf (positions, p, row);
}

// Calls visit (q, distance, spacing) for the neighbours nearer than a gap, nearest first, until it
// returns false.
// \param gap in spacings
template <typename Visit>
void
visitTooNear (const Positions& positions, Index p, const Row& row, double gap, Visit&& visit)
{
  if (row.size () == 0)
    return;
  const double spacing = spacingAround (positions, p, row);
  for (const Index q : row) {
    const double d = distanceBetween (positions, p, q);
    if (d >= gap * spacing || !visit (q, d, spacing))
      return;
  }
}

// Points that an earlier one sets aside, ascending.
std::vector<Index>
pointsTooNear (const Positions& positions, const CsrLists& neighbors, const Flags& is_stacked)
{
  // Spacings, between points of the net. With 0.2, several points of a stack as high as 0.15 were in
  // it, and made it noisy.
  constexpr double GAP = 0.3;
  std::vector<Index> aside;
  Flags is_aside (positions.size (), 0);
  for (Index p = 0; p < positions.size (); ++p)
    if (is_stacked[p] != 0)
      visitTooNear (positions, p, neighbors.row (p), GAP, [&] (Index q, double, double) {
        if (q > p || is_aside[q] != 0)
          return true;
        is_aside[p] = 1;
        aside.push_back (p);
        return false;
      });
  return aside;
}

// Flags of the points in whose surroundings points lie on one another; empty if there are none. 0.05
// microseconds a point where there are none.
Flags
findStackedPlaces (const Positions& positions, const CsrLists& neighbors, const RunContext& run)
{
  constexpr double NEAR = 0.2; // spacings; nearer points show that there are stacks
  // Spacings; nearer points are the same but for rounding. Among 100,000 random points there is one
  // such pair by chance in every third cloud.
  constexpr double EQUAL = 1e-3;
  constexpr std::size_t LEAST_POINTS = 100; // in smaller clouds, shares are chance
  // Share of points in a block that others set aside, and the median cosine between normal and
  // offset: above both, there are stacks. A random sample has the share 0.04, and offsets in all
  // directions the cosine 0.5. Points on lines, with random steps, are near each other in the plane.
  constexpr double SHARE = 0.1, LEAST_COSINE = 0.25;
  // Share above which stacks along the normal are set aside, and the median cosine between normal and
  // offset that shows them. Random samples with noise reach the share up to noise of 0.1 spacings, and
  // the cosine from 0.3 spacings on.
  constexpr double SHARE_ALONG_NORMAL = 0.03, COSINE = 0.55;
  // Middle over largest eigenvalue of the points around; below, they are a line, on which points may
  // be as uneven as they like.
  constexpr double LEAST_ASPECT = 0.01;
  const std::size_t n = positions.size ();
  Flags is_equal (n, 0), is_stacked_block (n / RANGE_LENGTH + 1, 0);
  RangeLists<double> all_cosines (n);
  const auto areStacked = [] (std::vector<double> cosines, std::size_t points) {
    const double share = static_cast<double> (cosines.size ()) / static_cast<double> (points);
    return points >= LEAST_POINTS && ((share > SHARE && median (cosines) > LEAST_COSINE) ||
                                      (share > SHARE_ALONG_NORMAL && median (cosines) > COSINE));
  };
  parallelRanges (run, n, [&] (std::size_t first, std::size_t last) {
    std::vector<double>& cosines = all_cosines.of (first);
    for (auto p = static_cast<Index> (first); p < last; ++p) {
      const Row row = neighbors.row (p);
      Index by = NONE;
      visitTooNear (positions, p, row, NEAR, [&] (Index q, double d, double spacing) {
        if (d < EQUAL * spacing)
          is_equal[p] = 1;
        if (q < p)
          by = q;
        return by == NONE;
      });
      if (by == NONE)
        continue;
      PlaneFit fit;
      for (const Index q : row)
        fit.add (positions[q] - positions[p]);
      const Plane plane = fit.plane ();
      if (plane.aspect >= LEAST_ASPECT)
        cosines.push_back (
            std::abs (plane.normal.dot ((positions[by] - positions[p]).normalized ())));
    }
    is_stacked_block[first / RANGE_LENGTH] = areStacked (cosines, last - first) ? 1 : 0;
  });
  const auto isAny = [] (const Flags& flags) {
    return std::find (flags.begin (), flags.end (), 1) != flags.end ();
  };
  const bool is_any_block = isAny (is_stacked_block);
  if (!is_any_block && !isAny (is_equal))
    return {};
  if (areStacked (all_cosines.join (), n))
    return Flags (n, 1);
  Flags is_stacked = std::move (is_equal);
  const auto isInBlock = [&] (Index p) { return is_stacked_block[p / RANGE_LENGTH] != 0; };
  if (is_any_block)
    parallelPoints (run, n, [&] (Index p) {
      const Row row = neighbors.row (p);
      if (isInBlock (p) || std::any_of (row.begin (), row.end (), isInBlock))
        is_stacked[p] = 1;
    });
  return is_stacked;
}

} // namespace

Stacks
chooseNet (Points& points, CsrLists& neighbors, const NeighborSettings& settings,
           const RunContext& run, std::optional<KdTree>* tree)
{
  constexpr std::size_t ROUNDS = 20; // at most. Clouds of the air took up to 10
  constexpr std::size_t FEWEST = 4;  // of a surface
  Flags is_stacked = findStackedPlaces (points.positions, neighbors, run);
  if (is_stacked.empty ())
    return {};
  Points net; // without scaling it again
  net.positions = points.positions;
  net.cloud_index = points.cloud_index;
  std::vector<Index> kept = indicesBelow (points.size ());
  for (std::size_t round = 0; round < ROUNDS; ++round) {
    const std::vector<Index> aside = pointsTooNear (net.positions, neighbors, is_stacked);
    if (aside.empty ())
      break;
    eraseRows (net.positions, aside);
    eraseRows (net.cloud_index, aside);
    eraseRows (is_stacked, aside);
    eraseRows (kept, aside);
    neighbors = renewNeighbors (net, aside, neighbors, settings, run);
  }
  Stacks stacks;
  stacks.points = points.size () - kept.size ();
  if (stacks.points == 0)
    return {};
  if (kept.size () < FEWEST) {
    neighbors = findNeighbors (points, settings, run, tree);
    return {};
  }
  setAside (points, kept, run);
  const StackedPoints& stacked = points.stacked;
  std::vector<double> heights;
  for (std::size_t i = 0; i < stacked.of.size (); ++i) {
    const Index p = stacked.of[i];
    const double spacing = spacingAround (stacked.own, p, neighbors.row (p));
    heights.push_back ((stacked.positions[i] - stacked.own[p]).norm () / spacing);
    if (heights.back () > stacks.largest || stacks.at == NONE) {
      stacks.largest = heights.back ();
      stacks.at = p;
    }
  }
  stacks.median = median (heights);
  neighbors = findNeighbors (points, settings, run, tree);
  return stacks;
}

} // namespace pcl::floater

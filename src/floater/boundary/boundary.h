// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary stage (TW 385, section 3): from the geometry around each point to one ordered loop.
#pragma once

#include "core/problem.h"
#include "core/run_context.h"
#include "core/types.h"
#include "local/local_geometry.h"
#include "local/stars.h"
#include "points/points.h"

#include <pcl/surface/floater/options.h>

#include <array>
#include <vector>

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
  /// k up to which it is incremented, or that of the cluster, if it is larger: its points are
  /// connected by that many neighbours. Tested on generated borders only; not certain.
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

/// A run of consecutive sectors of one star without a triangle, or with too wide a circumcircle.
/// The neighbours at its two ends are the next boundary points from this one.
struct Gap
{
  Index point;
  Index first; ///< neighbour at which the gap begins, anti-clockwise in the point's star
  Index last;  ///< neighbour at which it ends; the same as `first` if only one neighbour is left
};

/// The gaps of all stars, ordered by point. A star without any triangle has one gap, from its
/// nearest neighbour to itself. O(entries).
/// \param stars              with their offsets
/// \param circumradius_ratio a triangle counts as missing if its circumradius exceeds this many
///                           times the mean local spacing of its corners
std::vector<Gap>
findGaps (const Stars& stars, const std::vector<float>& spacing, double circumradius_ratio,
          const RunContext& run);

/// The boundary loop of a disc.
struct Boundary
{
  std::vector<Index> loop;    ///< points in order, each once; empty if there is a problem
  std::size_t candidates = 0; ///< points that may lie on the boundary
  double largest_step = 0.0;  ///< longest edge of the loop, in local spacings
  Index longest_from = NONE;  ///< point where that edge begins
  Problem problem;            ///< NO_BOUNDARY or INVALID_LOOP
};

/// Finds the longest boundary loop. This method is not in TW 385.
///
/// Candidates are the points with a gap in their star (see findGaps ()). An edge between them is
/// cheapest if each end is at the end of the other's gap, dearer if only one is, and dearest
/// between candidates that are only near each other. A minimum spanning tree then runs along the
/// borders. Of all other edges, the one that closes the longest cycle gives the loop; spurs and
/// clusters of false candidates close short cycles only. The loop is then refined. The longest loop
/// without a large step over all circumradius ratios of the limits wins.
///
/// Weakness: two borders that come within about 3 spacings of each other in more than one place
/// may be joined, and a border stays open where its steps exceed LoopLimits::longest_edge.
/// O(n + c log c) for c candidates.
/// \param stars   with their offsets
/// \param spacing per point: local spacing, in the unit of the positions
/// \return loop, candidates and steps; the loop is empty if none was found. There is no problem.
Boundary
spanningTreeLoop (const std::vector<Eigen::Vector3d>& positions, const Stars& stars,
                  const std::vector<float>& spacing, const RunContext& run,
                  const LoopLimits& limits = {});

/// Clusters by region growing, each from the densest untaken point.
/// O(n log n) for n points along curves.
/// \param boundary_points ascending
/// \param tolerance       largest growing distance and radius in which density is counted, in the
///                        unit of the positions (xi D in TW 385)
/// \param k               nearest boundary points that are appended at a time
/// \return disjoint clusters of points, ascending in each; the largest cluster first, of equally
///         large ones that with the smallest point
std::vector<std::vector<Index>>
clusterBoundaryPoints (const std::vector<Eigen::Vector3d>& positions,
                       const std::vector<Index>& boundary_points, double tolerance, int k,
                       const RunContext& run);

/// Splits a cluster into two connected segments with common ends, orders each of them between its
/// ends by the univariate Floater parameterization (reciprocal distance weights), and joins them to
/// a loop. O(n log n).
///
/// The choices that TW 385 leaves open, or that differ here: the seed is the first point of the
/// cluster (TW 385: a random one); a segment first takes the point nearest to the seed along the
/// segment; neighbourhoods are symmetric; the parameterization uses the number of neighbours with
/// the shortest order (LoopLimits::univariate_k).
///
/// Weakness: where the cluster is a thick band, or the border turns back on itself within a
/// neighbourhood, the order is not that along the border.
/// \param cluster   distinct points, in any order
/// \return every point of the cluster once, in order; empty if the cluster has fewer than 4 points,
///         if two of them coincide, or if the system of a segment is singular
std::vector<Index>
twoSegmentLoop (const std::vector<Eigen::Vector3d>& positions, const std::vector<Index>& cluster,
                const RunContext& run, const LoopLimits& limits = {});

/// Inserts candidates that lie on or beyond an edge of the loop where the detour is small.
/// Otherwise such a point would be an interior point outside of the boundary, and the surface would
/// fold there. O(points + c log n) for c candidates and a loop of n points.
/// \param stars      with normals, which give the side of the surface
/// \param spacing    per point: local spacing
/// \param candidates points that may lie on the boundary, on the loop or not
/// \param loop       at least 3 points in order
void
refineLoop (const std::vector<Eigen::Vector3d>& positions, const Stars& stars,
            const std::vector<float>& spacing, const std::vector<Index>& candidates,
            std::vector<Index>& loop, const RunContext& run, const LoopLimits& limits = {});

/// The loop in the options, or otherwise the one that their method finds (SPANNING_TREE or
/// TWO_SEGMENTS; for CONSENSUS see consensus_loop.h). May report INVALID_LOOP; for other problems
/// call checkBoundary ().
Boundary
findBoundary (const Points& points, const LocalGeometry& geometry, const BoundaryOptions& options,
              const RunContext& run, const LoopLimits& limits = {});

/// Measures the steps of the loop (see measureSteps ()). Reports NO_BOUNDARY for a loop of fewer
/// than 3 points, or a found one so short that it is a gap in the sampling. Does nothing after a
/// problem.
/// \param spacing  per point: local spacing
/// \param is_given the loop was given by the user
void
checkBoundary (const Points& points, const std::vector<float>& spacing, bool is_given,
               Boundary& boundary, const LoopLimits& limits = {});

/// Sets the largest step of the loop and the point where it begins. A step is measured in the mean
/// of the local spacings at its two ends. O(loop).
/// \param spacing per point: local spacing, in the unit of the positions
void
measureSteps (const std::vector<Eigen::Vector3d>& positions, const std::vector<float>& spacing,
              Boundary& boundary);

} // namespace pcl::floater

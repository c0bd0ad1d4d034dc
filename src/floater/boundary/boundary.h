// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary stage (TW 385, section 3): from the geometry around each point to one ordered loop.
#pragma once

#include "core/problem.h"
#include "core/run_context.h"
#include "core/types.h"
#include "local/local_geometry.h"
#include "points/points.h"

#include <pcl/surface/floater/options.h>

namespace pcl::floater {
/// The boundary loop of a disc.
struct Boundary
{
  std::vector<Index> loop;    ///< points in order, each once; empty if there is a problem
  std::size_t candidates = 0; ///< points that may lie on the boundary
  double largest_step = 0.0;  ///< longest edge of the loop, in local spacings
  Index longest_from = NONE;  ///< point where that edge begins
  Problem problem;            ///< NO_BOUNDARY or INVALID_LOOP
};

/// Clusters by region growing, each from the densest untaken point.
/// O(n log n) for n points along curves.
/// \param boundary_points ascending
/// \param tolerance       largest growing distance and radius in which density is counted, in the
///                        unit of the positions (xi D in TW 385)
/// \param k               nearest boundary points that are appended at a time
/// \return disjoint clusters of points, ascending in each; the largest cluster first, of equally
///         large ones that with the smallest point
std::vector<std::vector<Index>>
clusterBoundaryPoints (const Positions& positions, const std::vector<Index>& boundary_points,
                       double tolerance, int k, const RunContext& run);

/// Splits a cluster into two connected segments with common ends, orders each of them between its
/// ends by the univariate Floater parameterization (reciprocal distance weights), and joins them to
/// a loop. O(n log n).
///
/// The choices that TW 385 leaves open, or that differ here: the seed is the first point of the
/// cluster (TW 385: a random one); a segment first takes the point nearest to the seed along the
/// segment; neighbourhoods are symmetric; the parameterization uses the number of neighbours with
/// the shortest order.
///
/// Weakness: where the cluster is a thick band, or the border turns back on itself within a
/// neighbourhood, the order is not that along the border.
/// \param cluster   distinct points, in any order
/// \param cluster_k its points are connected by so many neighbours
/// \return every point of the cluster once, in order; empty if the cluster has fewer than 4 points,
///         if two of them coincide, or if the system of a segment is singular
std::vector<Index>
twoSegmentLoop (const Positions& positions, const std::vector<Index>& cluster, int cluster_k,
                const RunContext& run);

/// The user's loop. Duplicates are replaced by the points that stand for them.
/// \param loop in cloud indices
/// \return may have the problem INVALID_LOOP
Boundary
givenLoop (const Points& points, const std::vector<Index>& loop);

/// The loop as in TW 385, section 3: the largest cluster of the points with a wide opening angle,
/// ordered in two segments; empty if there is none.
Boundary
publishedLoop (const Points& points, const LocalGeometry& geometry, const BoundaryOptions& options,
               const RunContext& run);

/// Measures the steps of the loop, in the means of the local spacings at their ends. Reports
/// NO_BOUNDARY for a loop of fewer than 3 points, or a found one so short that it is a gap in the
/// sampling. Does nothing after a problem. O(loop).
/// \param spacing  per point: local spacing, in the unit of the positions
/// \param is_given the loop was given by the user
void
checkBoundary (const Points& points, const std::vector<float>& spacing, bool is_given,
               Boundary& boundary);

} // namespace pcl::floater

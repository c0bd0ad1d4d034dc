// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Boundary points and their clusters (TW 385, sections 3.1 and 3.2).
#include "floater/boundary/neighbor_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace pcl::floater {
namespace {
using Positions = std::vector<Eigen::Vector3d>;
using Clusters = std::vector<std::vector<Index>>;

void
appendCircle (Positions& positions, const Eigen::Vector3d& centre, double radius, int count)
{
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * PI * i / count;
    positions.push_back (centre +
                         radius * Eigen::Vector3d (std::cos (angle), std::sin (angle), 0.0));
  }
}

std::vector<Index>
range (Index first, Index last)
{
  std::vector<Index> points (last - first);
  std::iota (points.begin (), points.end (), first);
  return points;
}

// Steps 2 to 5 of TW 385, section 3.2, exactly as they are written.
Clusters
literalClusters (const Positions& positions, const std::vector<Index>& boundary_points,
                 double tolerance, int k)
{
  const auto sqrDistance = [&positions] (Index p, Index q) {
    return (positions[p] - positions[q]).squaredNorm ();
  };
  const double sqr_tolerance = tolerance * tolerance;
  std::vector<std::pair<int, Index>> by_density; // (-density, point)
  for (const Index p : boundary_points)
    by_density.emplace_back (-static_cast<int> (std::count_if (
                                 boundary_points.begin (), boundary_points.end (),
                                 [&] (Index q) { return sqrDistance (p, q) <= sqr_tolerance; })),
                             p);
  std::sort (by_density.begin (), by_density.end ());

  std::vector<std::uint8_t> clustered (positions.size (), 0);
  Clusters clusters;
  for (const auto& [density, start] : by_density) {
    if (clustered[start])
      continue;
    std::vector<Index> cluster;
    std::vector<Index> unprocessed{start};
    clustered[start] = 1;
    while (!unprocessed.empty ()) {
      const Index p = unprocessed.back ();
      unprocessed.pop_back ();
      cluster.push_back (p);
      std::vector<std::pair<double, Index>> others;
      for (const Index q : boundary_points)
        if (q != p)
          others.emplace_back (sqrDistance (p, q), q);
      std::sort (others.begin (), others.end ());
      others.resize (std::min (others.size (), static_cast<std::size_t> (k)));
      for (const auto& [sqr_distance, q] : others)
        if (sqr_distance <= sqr_tolerance && !clustered[q]) {
          clustered[q] = 1;
          unprocessed.push_back (q);
        }
    }
    std::sort (cluster.begin (), cluster.end ());
    clusters.push_back (cluster);
  }
  std::sort (clusters.begin (), clusters.end (), [] (const auto& a, const auto& b) {
    return a.size () != b.size () ? a.size () > b.size () : a < b;
  });
  return clusters;
}

TEST (Clusters, SeparateLoopsLargestFirst)
{
  Positions positions;
  appendCircle (positions, {0, 0, 0}, 0.1, 20);
  appendCircle (positions, {3, 0, 0}, 1.0, 100);
  appendCircle (positions, {6, 0, 0}, 0.2, 40);
  EXPECT_EQ (clusterBoundaryPoints (positions, samples::indices (positions.size ()), 0.3, 10, 1),
             (Clusters{range (20, 120), range (120, 160), range (0, 20)}));
}

TEST (Clusters, EqualSizesComeBySmallestPoint)
{
  Positions positions;
  for (int i = 0; i < 5; ++i) {
    positions.emplace_back (10.0 + i, 0.0, 0.0);
    positions.emplace_back (0.0 + i, 5.0, 0.0);
  }
  EXPECT_EQ (clusterBoundaryPoints (positions, samples::indices (positions.size ()), 1.5, 10, 1),
             (Clusters{{0, 2, 4, 6, 8}, {1, 3, 5, 7, 9}}));
}

TEST (Clusters, ContainOnlyBoundaryPoints)
{
  Positions positions;
  for (int i = 0; i < 30; ++i)
    positions.emplace_back (0.1 * i, 0.0, 0.0);
  // Without points 10 to 12 there is a gap of 0.4 in the line.
  std::vector<Index> boundary_points = range (0, 10);
  for (Index p = 13; p < 30; ++p)
    boundary_points.push_back (p);
  EXPECT_EQ (clusterBoundaryPoints (positions, boundary_points, 0.35, 8, 1),
             (Clusters{range (13, 30), range (0, 10)}));
  EXPECT_EQ (clusterBoundaryPoints (positions, boundary_points, 0.45, 8, 1),
             (Clusters{boundary_points}));
}

TEST (Clusters, DistanceOfTheToleranceIsStillInside)
{
  Positions positions;
  for (int i = 0; i < 8; ++i)
    positions.emplace_back (0.25 * i, 0.0, 0.0); // exact in binary
  EXPECT_EQ (
      clusterBoundaryPoints (positions, samples::indices (positions.size ()), 0.25, 2, 1).size (),
      1U);
  EXPECT_EQ (
      clusterBoundaryPoints (positions, samples::indices (positions.size ()), 0.2499, 2, 1).size (),
      8U);
}

TEST (Clusters, FewNeighborsSplitWhatManyJoin)
{
  // Two dense clumps, nearer than the tolerance.
  Positions positions;
  appendCircle (positions, {0, 0, 0}, 0.1, 12);
  appendCircle (positions, {0.5, 0, 0}, 0.1, 12);
  EXPECT_EQ (
      clusterBoundaryPoints (positions, samples::indices (positions.size ()), 0.5, 4, 1).size (),
      2U);
  EXPECT_EQ (
      clusterBoundaryPoints (positions, samples::indices (positions.size ()), 0.5, 12, 1).size (),
      1U);
}

TEST (Clusters, OfNothingAndOfOnePoint)
{
  const Positions positions{{0, 0, 0}, {1, 0, 0}};
  EXPECT_TRUE (clusterBoundaryPoints (positions, {}, 1.0, 10, 1).empty ());
  EXPECT_EQ (clusterBoundaryPoints (positions, {1}, 1.0, 10, 1), (Clusters{{1}}));
  EXPECT_EQ (clusterBoundaryPoints (positions, {0, 1}, 0.5, 10, 1), (Clusters{{0}, {1}}));
}

TEST (Clusters, EqualTheStepsOfTw385OnRandomPoints)
{
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE (testing::Message () << "seed " << seed);
    std::mt19937 random (seed);
    std::uniform_real_distribution<double> uniform (0.0, 1.0);
    Positions positions;
    appendCircle (positions, {0.5, 0.5, 0.5}, 0.4, 60);
    for (int i = 0; i < 120; ++i)
      positions.emplace_back (uniform (random), uniform (random),
                              uniform (random) * uniform (random));
    std::vector<Index> boundary_points;
    for (Index p = 0; p < positions.size (); ++p)
      if (uniform (random) < 0.8)
        boundary_points.push_back (p);
    for (const double tolerance : {0.05, 0.1, 0.2})
      for (const int k : {2, 10})
        EXPECT_EQ (clusterBoundaryPoints (positions, boundary_points, tolerance, k, 1),
                   literalClusters (positions, boundary_points, tolerance, k));
  }
}

TEST (Clusters, EqualTheStepsOfTw385WhereDistancesTie)
{
  std::mt19937 random (7);
  Positions positions;
  for (int x = 0; x < 12; ++x)
    for (int y = 0; y < 12; ++y)
      if (random () % 4 != 0)
        positions.emplace_back (x, y, 0.0);
  std::shuffle (positions.begin (), positions.end (), random);
  for (const double tolerance : {1.0, 1.5, 2.0})
    for (const int k : {1, 3, 5})
      EXPECT_EQ (
          clusterBoundaryPoints (positions, samples::indices (positions.size ()), tolerance, k, 1),
          literalClusters (positions, samples::indices (positions.size ()), tolerance, k));
}

} // namespace
} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/trimming.h"

#include "mesh/known_meshes.h"
#include "mesh/self_intersections.h"
#include "samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::asInput;
using samples::Mesh;
using samples::Positions;
using samples::sheet;
using samples::unordered;

TrimmingOptions
longestEdge (double length)
{
  return {length, 0.0, false, 0};
}

TrimmingOptions
longestRatio (double spacings)
{
  return {0.0, spacings, false, 0};
}

TrimmingOptions
smallestComponent (int points)
{
  return {0.0, 0.0, false, points};
}

// Trims a mesh whose spacing is 0.1, and whose unit of length is 10 units of the cloud.
Trimming
trim (Mesh& mesh, const TrimmingOptions& options)
{
  TriangleMesh connected = samples::connected (mesh);
  const Trimming trimming =
      trimMesh (connected, samples::pointsAt (mesh.positions),
                std::vector<float> (mesh.positions.size (), 0.1F), options, 1);
  EXPECT_EQ (trimming.triangles, mesh.triangles.size () - connected.triangles.size ());
  // Points that were vertices and are none now.
  std::set<Index> lost;
  for (const Triangle& t : mesh.triangles)
    lost.insert (t.begin (), t.end ());
  for (const Triangle& t : connected.triangles)
    for (const Index p : t)
      lost.erase (p);
  EXPECT_EQ (trimming.points, (std::vector<Index> (lost.begin (), lost.end ())));
  const std::set<Triangle> before = unordered (mesh.triangles);
  for (const Triangle& t : unordered (connected.triangles))
    EXPECT_EQ (before.count (t), 1U);
  mesh.triangles = connected.triangles;
  samples::expectConsistent (connected);
  return trimming;
}

double
longestEdgeOf (const Positions& positions, const std::vector<Triangle>& triangles)
{
  double longest = 0.0;
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      longest = std::max (longest, (positions[t[i]] - positions[t[(i + 1) % 3]]).norm ());
  return longest;
}

TEST (Trimming, NothingByDefaultOrIfAllIsWithinTheLimits)
{
  EXPECT_FALSE (asksForTrimming ({}));
  EXPECT_TRUE (asksForTrimming (longestEdge (1e-9)));
  EXPECT_TRUE (asksForTrimming (longestRatio (3.0)));
  EXPECT_TRUE (asksForTrimming (smallestComponent (1)));
  Mesh mesh = sheet (5);
  const double longest = longestEdgeOf (mesh.positions, mesh.triangles); // of every triangle
  for (const TrimmingOptions& options : {TrimmingOptions (), longestEdge (10.0 * longest),
                                         longestRatio (1.42), smallestComponent (36)})
    EXPECT_EQ (trim (mesh, options).triangles, 0U);
  EXPECT_EQ (trim (mesh, longestEdge (9.99 * longest)).triangles, 50U);
}

TEST (Trimming, AGapBecomesABoundary)
{
  for (const TrimmingOptions& options : {longestEdge (3.0), longestRatio (3.0)}) {
    Mesh mesh = sheet (10);
    for (Eigen::Vector3d& p : mesh.positions)
      p.x () += p.x () > 0.55 ? 0.5 : 0.0;
    const Trimming trimming = trim (mesh, options);
    EXPECT_EQ (trimming.triangles, 20U);
    EXPECT_TRUE (trimming.points.empty ());
    EXPECT_EQ (trimming.components, 0U);
    const samples::Topology topology = samples::topologyOf (mesh.triangles);
    EXPECT_EQ (topology.components, 2U);
    EXPECT_EQ (topology.loops.size (), 2U);
    EXPECT_EQ (topology.vertices, 121U);
  }
}

TEST (Trimming, TrianglesThatCrossAreOpened)
{
  const TrimmingOptions options{0.0, 0.0, true, 0};
  EXPECT_TRUE (asksForTrimming (options));
  Mesh mesh = sheet (10);
  EXPECT_EQ (trim (mesh, options).triangles, 0U);
  // Another sheet stands upright in it.
  samples::append (mesh, samples::cells (10, 10, [] (Index x, Index y) {
                     return Eigen::Vector3d (0.1 * x + 0.013, 0.47, 0.1 * y - 0.52);
                   }));
  const std::vector<CrossingPair> pairs = findSelfIntersections (mesh.triangles, mesh.positions, 1);
  ASSERT_GT (pairs.size (), 3U);
  const Trimming trimming = trim (mesh, options);
  EXPECT_EQ (trimming.crossing, trimming.triangles);
  EXPECT_GT (trimming.triangles, 0U);
  EXPECT_LT (trimming.triangles, 2 * pairs.size ());
  EXPECT_TRUE (findSelfIntersections (mesh.triangles, mesh.positions, 1).empty ());
}

TEST (Trimming, WhateverIsCutTheMeshStaysAManifold)
{
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U})
    for (const std::size_t one_in : {2U, 3U, 5U, 10U, 30U})
      for (const Mesh& whole : {sheet (20), samples::torus (30, 20), samples::annulus (40)}) {
        Mesh mesh = whole;
        RandomStream random (100 * seed + one_in);
        for (std::size_t p = 0; p < mesh.positions.size (); ++p)
          if (random.below (one_in) == 0)
            mesh.positions[p].z () += 20.0 + static_cast<double> (5 * p);
        trim (mesh, longestEdge (10.0));
        EXPECT_LE (longestEdgeOf (mesh.positions, mesh.triangles), 1.0);
        EXPECT_GT (mesh.triangles.size (), one_in < 30 ? 0 : whole.triangles.size () / 2);
      }
}

TEST (Trimming, SmallComponents)
{
  Mesh mesh = samples::beside (sheet (4), samples::tetrahedron ());
  EXPECT_EQ (trim (mesh, smallestComponent (4)).triangles, 0U);
  Trimming trimming = trim (mesh, smallestComponent (5));
  EXPECT_EQ (trimming.triangles, 4U);
  EXPECT_EQ (trimming.components, 1U);
  EXPECT_EQ (trimming.points, (std::vector<Index>{25, 26, 27, 28}));
  trimming = trim (mesh, smallestComponent (26));
  EXPECT_EQ (trimming.components, 1U);
  EXPECT_TRUE (mesh.triangles.empty ());
}

TEST (Trimming, NothingLeftIsAFailure)
{
  const std::pair<TrimmingOptions, const char*> cases[]{
      {longestEdge (1e-3), "as asked for (edges longer than 0.001 units of the cloud)"},
      {smallestComponent (1 << 20), "as asked for (components of fewer than 1048576 points)"}};
  for (const auto& [trimming, cause] : cases) {
    Options options;
    options.trimming = trimming;
    const Result result = reconstruct (asInput (samples::disc (0.1, 1).positions), options);
    EXPECT_EQ (result.report.status, RunStatus::DEGENERATE);
    EXPECT_NE (result.report.message.find ("no triangle is left"), std::string::npos);
    EXPECT_NE (result.report.message.find (cause), std::string::npos) << result.report.message;
    EXPECT_TRUE (result.triangles.empty ());
  }
}

} // namespace
} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the parameters of FloaterReconstruction do to a run.
#include "mesh_check.h"

#include <algorithm>
#include <limits>
#include <random>

namespace pcl::floater {
namespace {
TEST_F (FloaterClass, LongEdgesAreCutOff)
{
  const Cloud::Ptr cloud = heightField ();
  for (const Topology topology : {Topology::DISC, Topology::SURFACE}) {
    pcl::FloaterReconstruction<pcl::PointXYZ> floater;
    floater.setInputCloud (cloud);
    floater.setTopology (topology);
    pcl::PolygonMesh whole, mesh;
    floater.reconstruct (whole);
    floater.setMaximumEdgeLength (1.5);
    floater.reconstruct (mesh);
    ASSERT_EQ (floater.getStatus (), RunStatus::SUCCESS) << floater.getMessage ();
    EXPECT_GT (floater.getStatistics ().trimmed_triangles, 0U);
    EXPECT_EQ (mesh.polygons.size () + floater.getStatistics ().trimmed_triangles,
               whole.polygons.size ());
    EXPECT_EQ (floater.getUnusedIndices ().size (), floater.getStatistics ().trimmed_points);
    for (const pcl::Vertices& polygon : mesh.polygons)
      for (std::size_t i = 0; i < 3; ++i) {
        const pcl::PointXYZ& a = (*cloud)[polygon.vertices[i]];
        const pcl::PointXYZ& b = (*cloud)[polygon.vertices[(i + 1) % 3]];
        EXPECT_LE ((a.getVector3fMap () - b.getVector3fMap ()).norm (), 1.5F + 1e-6F);
      }
    floater.setMaximumEdgeRatio (-1.0);
    floater.reconstruct (mesh);
    EXPECT_EQ (floater.getStatus (), RunStatus::INVALID_OPTION);
    EXPECT_TRUE (mesh.polygons.empty ());
  }
}

// A point far from all others changes nothing about the balls around these.
TEST_F (FloaterClass, AGrossOutlierDoesNotHarmBalls)
{
  const Cloud::Ptr cloud = heightField ();
  pcl::FloaterReconstruction<pcl::PointXYZ> floater;
  floater.setNeighborhood (Neighborhood::BALL_DELAUNAY);
  floater.setInputCloud (cloud);
  pcl::PolygonMesh expected, mesh;
  floater.reconstruct (expected);
  const Cloud::Ptr with_outlier (new Cloud (*cloud));
  with_outlier->push_back (pcl::PointXYZ (std::numeric_limits<float>::max (), 0.0F, 0.0F));
  floater.setInputCloud (with_outlier);
  floater.reconstruct (mesh);
  ASSERT_EQ (floater.getStatus (), RunStatus::SUCCESS) << floater.getMessage ();
  EXPECT_EQ (floater.getOutlierIndices (), pcl::Indices (1, 500));
  ASSERT_EQ (mesh.polygons.size (), expected.polygons.size ());
  for (std::size_t t = 0; t < mesh.polygons.size (); ++t)
    EXPECT_EQ (mesh.polygons[t].vertices, expected.polygons[t].vertices);
}

// A sheet, and beside it a bush: points strewn into a box.
TEST_F (FloaterClass, ScatterIsToldAndDropped)
{
  std::mt19937 random (1);
  const auto coordinate = [&random] { return static_cast<float> (random ()) / 4294967296.0F; };
  const Cloud::Ptr cloud (new Cloud);
  for (int i = 0; i < 4500; ++i) {
    const float x = coordinate (), y = coordinate (), z = coordinate ();
    const bool is_bush = i >= 3000;
    cloud->push_back (is_bush ? pcl::PointXYZ (1.5F + 0.2F * x, 0.2F * y, 0.2F * z)
                              : pcl::PointXYZ (x, y, 0.0F));
  }
  pcl::FloaterReconstruction<pcl::PointXYZ> floater;
  floater.setInputCloud (cloud);
  pcl::PolygonMesh mesh;
  floater.reconstruct (mesh);
  const pcl::Indices scatter = floater.getScatterIndices ();
  ASSERT_GT (scatter.size (), 1200U);
  EXPECT_GE (scatter.front (), 3000);
  floater.setScatterPolicy (ScatterPolicy::DROP);
  floater.reconstruct (mesh);
  EXPECT_EQ (floater.getScatterIndices (), scatter);
  ASSERT_FALSE (mesh.polygons.empty ());
  for (const pcl::Vertices& triangle : mesh.polygons)
    for (const pcl::index_t p : triangle.vertices)
      EXPECT_FALSE (std::binary_search (scatter.begin (), scatter.end (), p));
}

TEST_F (FloaterClass, ParametersChangeTheRun)
{
  Floater floater;
  floater.setInputCloud (heightField ());
  runWell (floater);
  const std::vector<Eigen::Vector2d> on_circle = floater.getParameters ();
  DiscOptions options;
  options.weighting = Weighting::UNIFORM;
  floater.setDiscOptions (options);
  runWell (floater);
  EXPECT_NE (floater.getParameters (), on_circle);
  options.weighting = Weighting::MEAN_VALUE;
  floater.setDiscOptions (options);
  floater.setFlipEdges (false);
  runWell (floater);
  EXPECT_EQ (floater.getParameters (), on_circle);
  EXPECT_EQ (floater.getStatistics ().flips, 0U);

  // Border points lie on the domain. On a triangle they are at least half as far from the centre as
  // its corners, on the circle all equally far.
  options.domain.curve = Domain::POLYGON;
  options.domain.polygon_sides = 3;
  floater.setDiscOptions (options);
  runWell (floater);
  double nearest = 1.0;
  for (const pcl::index_t i : floater.getBoundaryLoop ())
    nearest = std::min (nearest, floater.getParameters ()[static_cast<std::size_t> (i)].norm ());
  EXPECT_GE (nearest, 0.5 - 1e-12);
  EXPECT_LT (nearest, 0.6);
  for (const pcl::index_t i : floater.getBoundaryLoop ())
    EXPECT_NEAR (on_circle[static_cast<std::size_t> (i)].norm (), 1.0, 1e-12);
}

TEST_F (FloaterClass, TwoSegmentsFollowTheClusterParameters)
{
  // The border of 500 points is sparse: the distance that suits a real scan is too short for it.
  Floater floater;
  floater.setInputCloud (heightField ());
  DiscOptions options;
  options.boundary.method = BoundaryMethod::TWO_SEGMENTS;
  options.boundary.cluster_tolerance = 0.2;
  floater.setDiscOptions (options);
  runDisc (floater, allOf (500));
  const std::size_t whole = floater.getBoundaryLoop ().size ();
  EXPECT_EQ (floater.getStatistics ().boundary_candidates, whole);

  options.boundary.opening_angle = 140.0; // more points see a sector as wide as that
  floater.setDiscOptions (options);
  runDisc (floater, allOf (500));
  EXPECT_GT (floater.getBoundaryLoop ().size (), whole);

  // A cluster that may not grow so far holds only a part of the border.
  const auto expect_less = [&] {
    floater.setDiscOptions (options);
    Cloud points;
    Polygons polygons;
    testing::internal::CaptureStderr ();
    floater.reconstruct (points, polygons);
    testing::internal::GetCapturedStderr ();
    EXPECT_LT (floater.getBoundaryLoop ().size (), whole);
    EXPECT_EQ (floater.getStatistics ().boundary_candidates, whole);
  };
  options.boundary.opening_angle = 160.0;
  options.boundary.cluster_tolerance = 0.05;
  expect_less ();
  options.boundary.cluster_tolerance = 0.2;
  options.boundary.cluster_k = 1;
  expect_less ();
}

TEST_F (FloaterClass, ThreadsDoNotChangeTheResult)
{
  const Cloud::Ptr cloud = makeCloud<pcl::PointXYZ> (SurfaceKind::HEMISPHERE, 3000);
  Floater floater;
  floater.setInputCloud (cloud);
  Cloud points;
  Polygons polygons;
  floater.setNumberOfThreads (1);
  floater.reconstruct (points, polygons);
  ASSERT_EQ (floater.getStatus (), RunStatus::SUCCESS);
  const std::vector<Eigen::Vector2d> parameters = floater.getParameters ();
  const pcl::Indices loop = floater.getBoundaryLoop ();
  for (const unsigned int threads : {2U, 5U, 0U}) {
    SCOPED_TRACE (threads);
    floater.setNumberOfThreads (threads);
    floater.setNumberOfBlocks (static_cast<int> (threads));
    Polygons again;
    floater.reconstruct (points, again);
    ASSERT_EQ (again.size (), polygons.size ());
    for (std::size_t i = 0; i < polygons.size (); ++i)
      ASSERT_EQ (again[i].vertices, polygons[i].vertices);
    EXPECT_EQ (floater.getParameters (), parameters);
    EXPECT_EQ (floater.getBoundaryLoop (), loop);
  }
}

} // namespace
} // namespace pcl::floater

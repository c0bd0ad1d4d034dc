// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Input and output of FloaterReconstruction: clouds, indices, meshes, failures.
#include "mesh_check.h"

#include <pcl/point_types.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

namespace pcl::floater {
namespace {
constexpr float NOWHERE = std::numeric_limits<float>::quiet_NaN ();

/// A wavy grid in row order, moved a little off its places.
Cloud::Ptr
organizedSheet (std::uint32_t width, std::uint32_t height)
{
  RandomStream random (SEED);
  Cloud::Ptr cloud (new Cloud (width, height));
  for (std::uint32_t row = 0; row < height; ++row)
    for (std::uint32_t column = 0; column < width; ++column) {
      const auto x = static_cast<double> (column) + 0.2 * random.uniform ();
      const auto y = static_cast<double> (row) + 0.2 * random.uniform ();
      (*cloud) (column, row).getVector3fMap () =
          Eigen::Vector3d (x, y, std::sin (0.3 * x) + std::cos (0.2 * y)).cast<float> ();
    }
  return cloud;
}

TEST_F (FloaterClass, MakesADiscOfAHeightField)
{
  Floater floater;
  const Cloud::Ptr cloud = heightField ();
  floater.setInputCloud (cloud);
  const Triangles triangles = runDisc (floater, allOf (cloud->size ()));
  EXPECT_TRUE (floater.getReport ().warnings.empty ());
  EXPECT_TRUE (floater.getUnusedIndices ().empty ());
  EXPECT_TRUE (floater.getNonFiniteIndices ().empty ());
  EXPECT_TRUE (floater.getDuplicates ().empty ());
  // Seen from above no triangle is turned over.
  int upward = 0;
  for (const auto& t : triangles) {
    const Eigen::Vector3f a = (*cloud)[t[0]].getVector3fMap ();
    const Eigen::Vector3f b = (*cloud)[t[1]].getVector3fMap ();
    const Eigen::Vector3f c = (*cloud)[t[2]].getVector3fMap ();
    upward += (b - a).cross (c - a).z () > 0.0F ? 1 : 0;
  }
  EXPECT_TRUE (upward == 0 || upward == static_cast<int> (triangles.size ())) << upward;

  ASSERT_EQ (floater.getParameters ().size (), cloud->size ());
  for (const Eigen::Vector2d& uv : floater.getParameters ())
    EXPECT_LE (uv.norm (), 1.0 + 1e-12); // round-off of points on the circle
  const Statistics& statistics = floater.getStatistics ();
  EXPECT_EQ (statistics.cloud_points, cloud->size ());
  EXPECT_EQ (statistics.used_points, cloud->size ());
  EXPECT_EQ (statistics.triangles, triangles.size ());
  EXPECT_EQ (statistics.loop_points, floater.getBoundaryLoop ().size ());
  EXPECT_EQ (statistics.unknowns, cloud->size () - floater.getBoundaryLoop ().size ());
}

TEST_F (FloaterClass, IsDropInThroughTheBaseClasses)
{
  const Cloud::Ptr cloud = heightField ();
  cloud->header.frame_id = "scanner";
  cloud->header.seq = 7;
  cloud->header.stamp = 1234567;

  const pcl::PCLSurfaceBase<pcl::PointXYZ>::Ptr surface (new Floater);
  surface->setInputCloud (cloud);
  pcl::PolygonMesh mesh;
  mesh.polygons.resize (5);
  surface->reconstruct (mesh);
  EXPECT_EQ (mesh.header.frame_id, "scanner");
  EXPECT_EQ (mesh.header.seq, 7U);
  EXPECT_EQ (mesh.header.stamp, 1234567U);
  pcl::PCLPointCloud2 expected;
  pcl::toPCLPointCloud2 (*cloud, expected);
  EXPECT_EQ (mesh.cloud.data, expected.data);
  EXPECT_EQ (mesh.cloud.width, expected.width);
  EXPECT_EQ (mesh.cloud.header.frame_id, "scanner");

  const pcl::SurfaceReconstruction<pcl::PointXYZ>::Ptr reconstruction (new Floater);
  reconstruction->setInputCloud (cloud);
  Cloud points;
  Polygons polygons (5);
  reconstruction->reconstruct (points, polygons);
  EXPECT_EQ (points.header.frame_id, "scanner");
  ASSERT_EQ (points.size (), cloud->size ());
  for (std::size_t i = 0; i < points.size (); ++i)
    EXPECT_EQ (points[i].getVector3fMap (), (*cloud)[i].getVector3fMap ());

  EXPECT_FALSE (polygons.empty ());
  EXPECT_EQ (trianglesOf (polygons), trianglesOf (mesh.polygons));
}

TEST_F (FloaterClass, KeepsAllFields)
{
  const auto cloud = makeCloud<pcl::PointXYZRGBNormal> (SurfaceKind::HEIGHT_FIELD, 300);
  for (std::size_t i = 0; i < cloud->size (); ++i) {
    (*cloud)[i].rgba = static_cast<std::uint32_t> (i);
    (*cloud)[i].curvature = static_cast<float> (i) + 0.5F;
    (*cloud)[i].normal_x = NOWHERE; // not read
  }
  pcl::FloaterReconstruction<pcl::PointXYZRGBNormal> floater;
  floater.setTopology (Topology::DISC);
  floater.setInputCloud (cloud);
  pcl::PolygonMesh mesh;
  floater.reconstruct (mesh);
  ASSERT_EQ (floater.getStatus (), RunStatus::SUCCESS);
  expectDisc (trianglesOf (mesh.polygons), allOf (cloud->size ()), floater.getBoundaryLoop ());
  pcl::PointCloud<pcl::PointXYZRGBNormal> points;
  pcl::fromPCLPointCloud2 (mesh.cloud, points);
  ASSERT_EQ (points.size (), cloud->size ());
  for (std::size_t i = 0; i < points.size (); ++i) {
    EXPECT_EQ (points[i].rgba, i);
    EXPECT_EQ (points[i].curvature, static_cast<float> (i) + 0.5F);
  }
}

TEST_F (FloaterClass, IndicesSelectAndPolygonsCountInTheWholeCloud)
{
  // Every third point is on the surface, in reverse order; the others are a heap beside it.
  const Cloud::Ptr surface = heightField ();
  const std::size_t n = surface->size ();
  RandomStream random (SEED);
  Cloud::Ptr cloud (new Cloud (static_cast<std::uint32_t> (3 * n), 1));
  for (pcl::PointXYZ& point : *cloud)
    for (float& coordinate : point.data)
      coordinate = static_cast<float> (random.uniform ());
  pcl::IndicesPtr indices (new pcl::Indices);
  for (std::size_t i = 0; i < n; ++i) {
    indices->push_back (static_cast<pcl::index_t> (3 * (n - 1 - i)));
    (*cloud)[3 * (n - 1 - i)] = (*surface)[i];
  }
  Floater floater;
  floater.setInputCloud (surface);
  Triangles expected;
  for (const auto& t : runWell (floater)) {
    std::array<pcl::index_t, 3> moved{(*indices)[t[0]], (*indices)[t[1]], (*indices)[t[2]]};
    std::rotate (moved.begin (), std::min_element (moved.begin (), moved.end ()), moved.end ());
    expected.insert (moved);
  }

  floater.setInputCloud (cloud);
  floater.setIndices (indices);
  Cloud points;
  Polygons polygons;
  floater.reconstruct (points, polygons);
  ASSERT_EQ (floater.getStatus (), RunStatus::SUCCESS);
  EXPECT_EQ (points.size (), cloud->size ());
  const Triangles triangles = trianglesOf (polygons);
  EXPECT_TRUE (triangles == expected || turnedOver (triangles) == expected);
  expectDisc (triangles, {indices->begin (), indices->end ()}, floater.getBoundaryLoop ());
  EXPECT_EQ (floater.getParameters ().size (), cloud->size ());
  EXPECT_TRUE (std::isnan (floater.getParameters ()[1].x ()));
  EXPECT_EQ (floater.getStatistics ().selected_points, n);

  // An index given again changes nothing.
  pcl::IndicesPtr repeated (new pcl::Indices (*indices));
  repeated->insert (repeated->end (), indices->begin (), indices->begin () + 50);
  floater.setIndices (repeated);
  EXPECT_EQ (runWell (floater), triangles);
  EXPECT_EQ (floater.getStatistics ().selected_points, n);
  EXPECT_TRUE (floater.getDuplicates ().empty ());
  EXPECT_EQ (repeated->size (), n + 50);
}

TEST_F (FloaterClass, RefusesIndicesOutsideTheCloud)
{
  Floater floater;
  const Cloud::Ptr cloud = heightField (100);
  floater.setInputCloud (cloud);
  for (const pcl::index_t outside :
       {static_cast<pcl::index_t> (100), static_cast<pcl::index_t> (-1),
        std::numeric_limits<pcl::index_t>::max ()}) {
    pcl::IndicesPtr indices (new pcl::Indices (50));
    std::iota (indices->begin (), indices->end (), 0);
    indices->push_back (outside);
    floater.setIndices (indices);
    expectFailure (floater, RunStatus::INVALID_INDICES);
    EXPECT_NE (floater.getMessage ().find (std::to_string (outside)), std::string::npos);
  }
  floater.setIndices (pcl::IndicesPtr (new pcl::Indices));
  expectFailure (floater, RunStatus::TOO_FEW_POINTS);
  floater.setIndices (pcl::IndicesPtr ());
  runDisc (floater, allOf (100));
}

TEST_F (FloaterClass, LeavesOutNonFiniteAndDuplicatePoints)
{
  const Cloud::Ptr clean = heightField ();
  Floater floater;
  floater.setInputCloud (clean);
  const Triangles expected = runWell (floater);

  const auto n = static_cast<pcl::index_t> (clean->size ());
  const Cloud::Ptr cloud (new Cloud (*clean));
  cloud->push_back (pcl::PointXYZ (NOWHERE, 0.0F, 0.0F));
  cloud->push_back ((*clean)[17]);
  cloud->push_back (pcl::PointXYZ (0.0F, 0.0F, std::numeric_limits<float>::infinity ()));
  cloud->push_back ((*clean)[3]);
  cloud->push_back ((*clean)[17]);
  cloud->is_dense = true; // and it is not
  floater.setInputCloud (cloud);
  EXPECT_EQ (runWell (floater), expected);
  EXPECT_EQ (floater.getNonFiniteIndices (), (pcl::Indices{n, n + 2}));
  const std::vector<std::array<pcl::index_t, 2>> duplicates{{n + 1, 17}, {n + 3, 3}, {n + 4, 17}};
  EXPECT_EQ (floater.getDuplicates (), duplicates);
  EXPECT_TRUE (std::isnan (floater.getParameters ()[n].x ()));
  EXPECT_EQ (floater.getParameters ()[n + 1], floater.getParameters ()[17]);
}

TEST_F (FloaterClass, RefusesNoInput)
{
  Floater floater;
  expectFailure (floater, RunStatus::NO_INPUT);
  EXPECT_EQ (floater.getSearchMethod (), nullptr);
  floater.setInputCloud (Cloud::Ptr (new Cloud));
  expectFailure (floater, RunStatus::NO_INPUT);
  floater.setInputCloud (heightField (100));
  runWell (floater);
  floater.setInputCloud (nullptr);
  expectFailure (floater, RunStatus::NO_INPUT);
  EXPECT_TRUE (floater.getBoundaryLoop ().empty ());
}

TEST_F (FloaterClass, WarnsOfPointsApart)
{
  const Cloud::Ptr cloud = heightField ();
  pcl::Indices island;
  for (int i = 0; i < 36; ++i) {
    const int row = i / 6;
    island.push_back (static_cast<pcl::index_t> (cloud->size ()));
    cloud->push_back (
        pcl::PointXYZ (100.0F + static_cast<float> (i % 6), static_cast<float> (row), 50.0F));
  }
  Floater floater;
  floater.setInputCloud (cloud);
  runDisc (floater, allOf (500)); // expects the warnings on the console
  EXPECT_EQ (floater.getUnusedIndices (), island);
  EXPECT_FALSE (floater.getReport ().warnings.empty ());
}

TEST_F (FloaterClass, AcceptsOrganizedClouds)
{
  const Cloud::Ptr cloud = organizedSheet (30, 20);
  std::set<pcl::index_t> valid = allOf (cloud->size ());
  for (std::uint32_t row = 0; row < 20; ++row) { // a scanner that saw nothing on the left
    (*cloud) (0, row).x = NOWHERE;
    valid.erase (static_cast<pcl::index_t> (30 * row));
  }
  cloud->is_dense = false;
  Floater floater;
  floater.setInputCloud (cloud);
  Cloud points;
  Polygons polygons;
  floater.reconstruct (points, polygons);
  ASSERT_EQ (floater.getStatus (), RunStatus::SUCCESS);
  EXPECT_EQ (points.width, 30U);
  EXPECT_EQ (points.height, 20U);
  expectDisc (trianglesOf (polygons), valid, floater.getBoundaryLoop ());
  EXPECT_EQ (floater.getSearchMethod (), nullptr); // which PCL's own classes would now keep
}

TEST_F (FloaterClass, ServesOneCloudAfterAnother)
{
  const Cloud::Ptr large = heightField (700);
  const Cloud::Ptr small = makeCloud<pcl::PointXYZ> (SurfaceKind::HEMISPHERE, 300);
  const Cloud::Ptr organized = organizedSheet (20, 20);
  const auto alone = [] (const Cloud::Ptr& cloud) {
    Floater floater;
    floater.setInputCloud (cloud);
    return runWell (floater);
  };
  const Triangles of_large = alone (large);
  Floater floater;
  EXPECT_EQ (floater.getStatus (), RunStatus::NOT_RUN);
  const Cloud::Ptr line (new Cloud (10, 1, pcl::PointXYZ (1.0F, 2.0F, 3.0F)));
  for (const Cloud::Ptr& cloud : {large, small, line, organized, large, small, large}) {
    floater.setInputCloud (cloud);
    if (cloud == line)
      expectFailure (floater, RunStatus::TOO_FEW_POINTS);
    else
      EXPECT_EQ (runWell (floater), alone (cloud));
  }
  // The results of a run are kept until the next run.
  const pcl::Indices loop = floater.getBoundaryLoop ();
  floater.setInputCloud (small);
  EXPECT_EQ (floater.getBoundaryLoop (), loop);
  // A cloud that shrinks in place.
  large->resize (650);
  EXPECT_EQ (alone (large) == of_large, false);
  floater.setInputCloud (large);
  EXPECT_EQ (runWell (floater), alone (large));
}

template <typename PointT>
class FloaterClassOf : public FloaterClass
{
};

using OtherTypes = testing::Types<pcl::PointXYZI, pcl::PointXYZRGB, pcl::PointXYZRGBA,
                                  pcl::PointNormal, pcl::PointXYZINormal, pcl::PointWithRange>;
TYPED_TEST_SUITE (FloaterClassOf, OtherTypes, );

TYPED_TEST (FloaterClassOf, IsInstantiated)
{
  const auto cloud = makeCloud<TypeParam> (SurfaceKind::HEIGHT_FIELD, 100);
  pcl::FloaterReconstruction<TypeParam> floater;
  floater.setTopology (Topology::DISC);
  floater.setInputCloud (cloud);
  runDisc (floater, allOf (cloud->size ()));
}

} // namespace
} // namespace pcl::floater

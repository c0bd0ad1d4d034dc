// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Single scans: the viewpoint that the caller or the cloud tells.
#include "random_stream.h"

#include <pcl/point_types.h>
#include <pcl/surface/floater_reconstruction.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace pcl::floater {
namespace {
// A wave behind a square, seen by a camera at `at`, with noise along the rays.
pcl::PointCloud<pcl::PointXYZ>::Ptr
frameFrom (const Eigen::Vector3d& at)
{
  RandomStream random (1);
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>> ();
  for (int i = 0; i < 140; ++i)
    for (int j = 0; j < 110; ++j) {
      const bool is_square = i > 40 && i < 80 && j > 30 && j < 70;
      const double depth =
          (is_square ? 1.0 : 2.0 + 0.1 * std::sin (0.1 * i)) * (1.0 + 0.01 * random.normal ());
      const Eigen::Vector3d ray (0.006 * (i - 70), 0.006 * (j - 55), 1.0);
      const Eigen::Vector3f point = (at + depth * ray).cast<float> ();
      cloud->emplace_back (point.x (), point.y (), point.z ());
    }
  return cloud;
}

class ViewpointOfTheClass : public testing::Test
{
protected:
  ViewpointOfTheClass () { floater_.setInputCloud (frameFrom ({0.0, 0.0, 0.0})); }

  const Report& reconstruct ()
  {
    pcl::PolygonMesh mesh;
    floater_.reconstruct (mesh);
    EXPECT_EQ (floater_.getStatus (), RunStatus::SUCCESS) << floater_.getMessage ();
    return floater_.getReport ();
  }

  pcl::FloaterReconstruction<pcl::PointXYZ> floater_;
};

TEST_F (ViewpointOfTheClass, TheOriginIsTheDefault)
{
  const Report& report = reconstruct ();
  EXPECT_TRUE (report.is_view);
  EXPECT_FALSE (report.is_far_view);
  EXPECT_EQ (report.viewpoint, (std::array<double, 3>{}));
  EXPECT_EQ (report.check.components, 2U); // the square, and the wave around it
}

TEST_F (ViewpointOfTheClass, TheSensorOriginOfTheCloudIsTried)
{
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud = frameFrom ({3.0, -2.0, 5.0});
  cloud->sensor_origin_ = {3.0F, -2.0F, 5.0F, 0.0F};
  floater_.setInputCloud (cloud);
  const Report& report = reconstruct ();
  EXPECT_TRUE (report.is_view);
  EXPECT_NEAR (report.viewpoint[0], 3.0, 1e-9);
  EXPECT_NEAR (report.viewpoint[1], -2.0, 1e-9);
  EXPECT_NEAR (report.viewpoint[2], 5.0, 1e-9);
}

// The pixels of a depth image, some of which have no point, tell the same as their rays.
TEST_F (ViewpointOfTheClass, AnOrganizedCloudHasTheSameMesh)
{
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud = frameFrom ({0.0, 0.0, 0.0});
  cloud->is_dense = false;
  for (std::size_t p = 0; p < cloud->size (); p += 37)
    (*cloud)[p].x = (*cloud)[p].y = (*cloud)[p].z = std::nanf ("");
  std::vector<std::vector<pcl::Vertices>> meshes;
  for (const std::uint32_t height : {1U, 140U, 110U}) { // the last one is wrong
    cloud->height = height;
    cloud->width = static_cast<std::uint32_t> (cloud->size ()) / height;
    floater_.setInputCloud (cloud);
    reconstruct ();
    EXPECT_TRUE (floater_.getReport ().is_view);
    EXPECT_EQ (floater_.getReport ().is_view_by_pixels, height == 140);
    floater_.reconstruct (meshes.emplace_back ());
  }
  for (const std::vector<pcl::Vertices>& mesh : meshes) {
    ASSERT_EQ (mesh.size (), meshes.front ().size ());
    for (std::size_t t = 0; t < mesh.size (); ++t)
      ASSERT_EQ (mesh[t].vertices, meshes.front ()[t].vertices) << t;
  }
}

TEST_F (ViewpointOfTheClass, ASheetFacesTheSensorOfItsCloud)
{
  // Points at random, so that their rays are not those of one view.
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>> ();
  RandomStream random (2);
  for (int i = 0; i < 3000; ++i) {
    const double x = random.uniform (), y = random.uniform ();
    cloud->emplace_back (static_cast<float> (x), static_cast<float> (y),
                         static_cast<float> (0.05 * std::sin (5.0 * x)));
  }
  floater_.setInputCloud (cloud);
  for (const float height : {4.0F, -4.0F}) {
    cloud->sensor_origin_ = {0.5F, 0.5F, height, 0.0F};
    pcl::PolygonMesh mesh;
    floater_.reconstruct (mesh);
    ASSERT_EQ (floater_.getStatus (), RunStatus::SUCCESS) << floater_.getMessage ();
    EXPECT_FALSE (floater_.getReport ().is_view);
    EXPECT_EQ (floater_.getReport ().facing_certainty, 1.0);
    ASSERT_FALSE (mesh.polygons.empty ());
    for (const pcl::Vertices& polygon : mesh.polygons) {
      std::array<Eigen::Vector3f, 3> corners;
      for (std::size_t i = 0; i < 3; ++i)
        corners[i] = (*cloud)[static_cast<std::size_t> (polygon.vertices[i])].getVector3fMap ();
      const float z = (corners[1] - corners[0]).cross (corners[2] - corners[0]).z ();
      ASSERT_GT (z * height, 0.0F);
    }
  }
}

} // namespace
} // namespace pcl::floater

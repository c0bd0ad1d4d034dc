// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Texture coordinates from the class.
#include "mesh_check.h"

#include <pcl/TextureMesh.h>
#include <pcl/conversions.h>

#include <gtest/gtest.h>

#include <cmath>

namespace pcl::floater {
namespace {
using Floaters = pcl::FloaterReconstruction<pcl::PointXYZ>;

double
signedArea (const TextureCoordinates& texture, const std::array<std::uint32_t, 3>& corners)
{
  const Eigen::Vector2d a = texture.coordinates[corners[0]].cast<double> (),
                        b = texture.coordinates[corners[1]].cast<double> (),
                        c = texture.coordinates[corners[2]].cast<double> ();
  return (b - a).x () * (c - a).y () - (b - a).y () * (c - a).x ();
}

TEST_F (FloaterClass, TextureCoordinatesAreThoseOfTheMesh)
{
  Floaters floater;
  floater.setInputCloud (makeCloud<pcl::PointXYZ> (SurfaceKind::SPHERE, 1500));
  EXPECT_FALSE (floater.getComputeTextureCoordinates ());
  Polygons polygons;
  floater.reconstruct (polygons);
  EXPECT_EQ (floater.getTextureCoordinates ().status, RunStatus::NOT_RUN);

  floater.setComputeTextureCoordinates (true);
  floater.reconstruct (polygons);
  const TextureCoordinates texture = floater.getTextureCoordinates ();
  ASSERT_EQ (texture.status, RunStatus::SUCCESS);
  ASSERT_EQ (texture.corners.size (), polygons.size ());
  EXPECT_GT (texture.chart_count, 1U);
  EXPECT_EQ (texture.flipped, 0U);
  for (std::size_t t = 0; t < polygons.size (); ++t) {
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ (texture.points[texture.corners[t][i]], polygons[t].vertices[i]);
    EXPECT_GT (signedArea (texture, texture.corners[t]), 0.0);
  }

  // Another stretch, other charts.
  floater.setLargestStretch (1.001);
  floater.reconstruct (polygons);
  EXPECT_GT (floater.getTextureCoordinates ().chart_count, texture.chart_count);
  // A later run without them forgets them; so does a run that fails.
  floater.setComputeTextureCoordinates (false);
  floater.reconstruct (polygons);
  EXPECT_TRUE (floater.getTextureCoordinates ().coordinates.empty ());
}

// Points that are not selected, or not finite, have none. A disc is one chart.
TEST_F (FloaterClass, TextureCoordinatesOfSelectedPoints)
{
  Cloud::Ptr cloud = makeCloud<pcl::PointXYZ> (SurfaceKind::FINGER, 1500);
  cloud->insert (cloud->begin (), 5, pcl::PointXYZ (1.0F, 2.0F, std::nanf ("")));
  pcl::IndicesPtr indices (new pcl::Indices);
  for (int i = 3; i < static_cast<int> (cloud->size ()); ++i)
    indices->push_back (i);
  Floaters floater;
  floater.setInputCloud (cloud);
  floater.setIndices (indices);
  floater.setTopology (Topology::DISC);
  floater.setComputeTextureCoordinates (true);
  Polygons polygons;
  floater.reconstruct (polygons);
  const TextureCoordinates& texture = floater.getTextureCoordinates ();
  ASSERT_EQ (texture.status, RunStatus::SUCCESS);
  EXPECT_EQ (texture.chart_count, 1U);
  EXPECT_TRUE (texture.seams.empty ());
  for (std::size_t t = 0; t < polygons.size (); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ (texture.points[texture.corners[t][i]], polygons[t].vertices[i]);
}

TEST_F (FloaterClass, TextureMesh)
{
  Floaters floater;
  const Cloud::Ptr cloud = makeCloud<pcl::PointXYZ> (SurfaceKind::TORUS, 1200);
  floater.setInputCloud (cloud);
  pcl::TextureMesh mesh;
  floater.reconstruct (mesh);
  ASSERT_EQ (floater.getStatus (), RunStatus::SUCCESS);
  EXPECT_FALSE (floater.getComputeTextureCoordinates ()); // as it was
  ASSERT_EQ (mesh.tex_polygons.size (), 1U);
  ASSERT_EQ (mesh.tex_materials.size (), 1U);
  ASSERT_EQ (mesh.tex_coordinates.size (), 1U);
  EXPECT_EQ (mesh.cloud.width * mesh.cloud.height, cloud->size ());
  EXPECT_EQ (mesh.tex_coordinates[0].size (), 3 * mesh.tex_polygons[0].size ());
  const TextureCoordinates& texture = floater.getTextureCoordinates ();
  for (std::size_t t = 0; t < texture.corners.size (); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ (mesh.tex_coordinates[0][3 * t + i], texture.coordinates[texture.corners[t][i]]);

  // After a failure it is empty.
  floater.setInputCloud (Cloud::Ptr (new Cloud));
  floater.reconstruct (mesh);
  EXPECT_EQ (floater.getStatus (), RunStatus::NO_INPUT);
  EXPECT_TRUE (mesh.tex_polygons.empty ());
  EXPECT_TRUE (mesh.cloud.data.empty ());
  EXPECT_EQ (floater.getTextureCoordinates ().status, RunStatus::NOT_RUN);
}

TEST_F (FloaterClass, TextureFailuresAreThoseOfTheRun)
{
  Floaters floater;
  floater.setInputCloud (makeCloud<pcl::PointXYZ> (SurfaceKind::SPHERE, 600));
  floater.setComputeTextureCoordinates (true);
  floater.setLargestStretch (0.5);
  Polygons polygons;
  floater.reconstruct (polygons);
  EXPECT_EQ (floater.getStatus (), RunStatus::INVALID_OPTION);
  EXPECT_TRUE (polygons.empty ());
  EXPECT_TRUE (floater.getPartIDs ().empty ());
  EXPECT_NE (floater.getMessage ().find ("stretch"), std::string::npos);

  // Progress goes through both parts, and either can be cancelled.
  floater.setLargestStretch (1.06);
  std::vector<double> fractions;
  floater.setProgressCallback ([&fractions] (double done) { fractions.push_back (done); });
  floater.reconstruct (polygons);
  EXPECT_TRUE (std::is_sorted (fractions.begin (), fractions.end ()));
  EXPECT_EQ (fractions.back (), 1.0);
  EXPECT_EQ (std::count (fractions.begin (), fractions.end (), 1.0), 1);
  double reached = 0.0;
  floater.setProgressCallback ([&reached] (double done) { reached = done; });
  floater.setCancelledCallback ([&reached] { return reached >= 0.5; });
  floater.reconstruct (polygons);
  EXPECT_EQ (floater.getStatus (), RunStatus::CANCELLED);
  EXPECT_TRUE (polygons.empty ());
  EXPECT_EQ (floater.getTextureCoordinates ().status, RunStatus::CANCELLED);
}

} // namespace
} // namespace pcl::floater

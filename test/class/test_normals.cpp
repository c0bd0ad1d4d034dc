// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Normals of the input, and the method of TW 385 with PCL's own parts.
#include "mesh_check.h"

#include <pcl/PolygonMesh.h>
#include <pcl/conversions.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/floater/vertex_normals.h>

#include <cmath>

namespace pcl::floater {
namespace {
using NormalCloud = pcl::PointCloud<pcl::PointNormal>;

TEST_F (FloaterClass, TakesTheNormalsOfPoints)
{
  const NormalCloud::Ptr cloud = makeCloud<pcl::PointNormal> (SurfaceKind::HEIGHT_FIELD, 2000);
  const auto triangles = [&cloud] (bool use) {
    pcl::FloaterReconstruction<pcl::PointNormal> floater;
    EXPECT_FALSE (floater.getUseInputNormals ());
    floater.setUseInputNormals (use);
    EXPECT_EQ (floater.getUseInputNormals (), use);
    floater.setInputCloud (cloud);
    Polygons polygons;
    floater.reconstruct (polygons);
    EXPECT_EQ (floater.getStatus (), RunStatus::SUCCESS) << floater.getMessage ();
    return trianglesOf (polygons);
  };
  const Triangles expected = triangles (false);
  // The normals of such points are zero until they are set: then planes are fitted.
  EXPECT_EQ (triangles (true), expected);
  for (pcl::PointNormal& point : *cloud)
    point.normal_x = 1.0F;
  EXPECT_EQ (triangles (false), expected);
  EXPECT_NE (triangles (true), expected);
}

// A sphere around the origin whose normals point to its middle.
NormalCloud::Ptr
bodyWithInwardNormals ()
{
  NormalCloud::Ptr cloud = makeCloud<pcl::PointNormal> (SurfaceKind::SPHERE, 2000);
  for (pcl::PointNormal& point : *cloud)
    point.getNormalVector3fMap () = -point.getVector3fMap ().normalized ();
  return cloud;
}

// Share of the triangles that face away from the origin.
double
shareOutwards (const NormalCloud& cloud, const Polygons& polygons)
{
  std::size_t outwards = 0;
  for (const pcl::Vertices& polygon : polygons) {
    const auto corner = [&] (std::size_t i) -> Eigen::Vector3f {
      return cloud[static_cast<std::size_t> (polygon.vertices[i])].getVector3fMap ();
    };
    const Eigen::Vector3f normal = (corner (1) - corner (0)).cross (corner (2) - corner (0));
    outwards += normal.dot (corner (0)) > 0.0F ? 1 : 0;
  }
  return static_cast<double> (outwards) / static_cast<double> (polygons.size ());
}

TEST_F (FloaterClass, NormalsDecideWhichSideIsTheFront)
{
  const NormalCloud::Ptr cloud = bodyWithInwardNormals ();
  pcl::FloaterReconstruction<pcl::PointNormal> floater;
  floater.setInputCloud (cloud);
  EXPECT_EQ (floater.getFacing (), Facing::AUTO);
  Polygons polygons;
  const auto outwards = [&] (Facing facing, bool use_normals) {
    floater.setFacing (facing);
    EXPECT_EQ (floater.getFacing (), facing);
    floater.setUseInputNormals (use_normals);
    floater.reconstruct (polygons);
    EXPECT_EQ (floater.getStatus (), RunStatus::SUCCESS) << floater.getMessage ();
    return shareOutwards (*cloud, polygons);
  };
  EXPECT_EQ (outwards (Facing::AUTO, false), 1.0);
  EXPECT_EQ (outwards (Facing::NORMALS, false), 0.0);
  EXPECT_EQ (outwards (Facing::AUTO, true), 0.0);
  const auto by_normals = static_cast<std::size_t> (FacingRule::NORMALS);
  EXPECT_EQ (floater.getReport ().facing_parts[by_normals], 1U);
  EXPECT_EQ (outwards (Facing::OUTWARDS, true), 1.0);
  EXPECT_EQ (floater.getReport ().facing_parts[by_normals], 0U);

  // As pcl::NormalEstimation leaves them where nobody tells a viewpoint.
  for (pcl::PointNormal& point : *cloud)
    if (point.normal_z < 0.0F)
      point.getNormalVector3fMap () *= -1.0F;
  EXPECT_EQ (outwards (Facing::NORMALS, false), 1.0);
  ASSERT_EQ (floater.getReport ().warnings.size (), 1U);
  EXPECT_NE (floater.getReport ().warnings.front ().find ("contradict"), std::string::npos);
}

// The neighbours and planes of PCL give the mesh that the core's own give, but for ties.
TEST_F (FloaterClass, TheMethodOfTheReportTakesPclsOwnParts)
{
  const Cloud::Ptr cloud = heightField (3000);
  pcl::FloaterReconstruction<pcl::PointXYZ> floater;
  floater.setDiscOptions (DiscOptions::tw385 ());
  floater.setInputCloud (cloud);
  Polygons polygons;
  floater.reconstruct (polygons);
  ASSERT_EQ (floater.getStatus (), RunStatus::SUCCESS) << floater.getMessage ();
  const Triangles by_pcl = trianglesOf (polygons);

  std::vector<Eigen::Vector3d> positions;
  for (const pcl::PointXYZ& point : *cloud)
    positions.emplace_back (point.x, point.y, point.z);
  Options options;
  options.disc = DiscOptions::tw385 ();
  const Result own = reconstruct (positions, options);
  ASSERT_EQ (own.report.status, RunStatus::SUCCESS) << own.report.message;
  std::size_t same = 0;
  for (const auto& t : own.triangles) {
    pcl::Indices corners (t.begin (), t.end ());
    std::rotate (corners.begin (), std::min_element (corners.begin (), corners.end ()),
                 corners.end ());
    same += by_pcl.count ({corners[0], corners[1], corners[2]});
  }
  EXPECT_EQ (own.triangles.size (), by_pcl.size ());
  EXPECT_GE (same * 100, by_pcl.size () * 99);
}

// Selected points only, a point that is not finite, and a search method of the user's.
TEST_F (FloaterClass, TheMethodOfTheReportTakesIndicesAndASearchMethod)
{
  const Cloud::Ptr cloud = heightField (3000);
  pcl::IndicesPtr indices (new pcl::Indices);
  for (pcl::index_t i = 0; i < static_cast<pcl::index_t> (cloud->size ()); ++i)
    if ((*cloud)[i].x < 40.0F)
      indices->push_back (i);
  (*cloud)[(*indices)[10]].z = std::numeric_limits<float>::infinity ();
  pcl::FloaterReconstruction<pcl::PointXYZ> floater;
  floater.setDiscOptions (DiscOptions::tw385 ());
  floater.setInputCloud (cloud);
  floater.setIndices (indices);
  Polygons by_default, by_tree;
  floater.reconstruct (by_default);
  ASSERT_EQ (floater.getStatus (), RunStatus::SUCCESS) << floater.getMessage ();
  EXPECT_EQ (floater.getNonFiniteIndices (), pcl::Indices{(*indices)[10]});
  floater.setSearchMethod (
      pcl::search::Search<pcl::PointXYZ>::Ptr (new pcl::search::KdTree<pcl::PointXYZ>));
  floater.reconstruct (by_tree);
  ASSERT_EQ (floater.getStatus (), RunStatus::SUCCESS) << floater.getMessage ();
  EXPECT_EQ (by_tree.size (), by_default.size ());
  for (const pcl::Vertices& polygon : by_default)
    for (const pcl::index_t corner : polygon.vertices)
      EXPECT_TRUE (std::binary_search (indices->begin (), indices->end (), corner));
}

// The normals that the triangles of a cloud have, made by the core.
std::vector<Eigen::Vector3f>
normalsOf (const Cloud& cloud, const Polygons& polygons)
{
  std::vector<Eigen::Vector3d> positions;
  for (const pcl::PointXYZ& point : cloud)
    positions.emplace_back (point.x, point.y, point.z);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const pcl::Vertices& polygon : polygons)
    triangles.push_back ({static_cast<std::uint32_t> (polygon.vertices[0]),
                          static_cast<std::uint32_t> (polygon.vertices[1]),
                          static_cast<std::uint32_t> (polygon.vertices[2])});
  return vertexNormals (positions, triangles);
}

TEST_F (FloaterClass, NormalsOfTheMeshAreFieldsOfItsCloud)
{
  const Cloud::Ptr cloud = heightField ();
  cloud->points[7].x = std::nanf (""); // in no triangle, as the first point, which is not selected
  const pcl::IndicesPtr indices (new pcl::Indices);
  for (pcl::index_t p = 1; p < 500; ++p)
    indices->push_back (p);
  pcl::FloaterReconstruction<pcl::PointXYZ> floater;
  floater.setInputCloud (cloud);
  floater.setIndices (indices);
  pcl::PolygonMesh plain, mesh;
  floater.reconstruct (plain);
  EXPECT_FALSE (floater.getComputeNormals ());
  EXPECT_TRUE (floater.getNormals ().empty ());
  floater.setComputeNormals (true);
  EXPECT_TRUE (floater.getComputeNormals ());
  floater.reconstruct (mesh);
  ASSERT_EQ (floater.getStatus (), RunStatus::SUCCESS) << floater.getMessage ();
  EXPECT_EQ (trianglesOf (mesh.polygons), trianglesOf (plain.polygons));
  EXPECT_EQ (plain.cloud.fields.size () + 3, mesh.cloud.fields.size ());
  NormalCloud points;
  pcl::fromPCLPointCloud2 (mesh.cloud, points);
  ASSERT_EQ (points.size (), cloud->size ());
  const std::vector<Eigen::Vector3f> normals = normalsOf (*cloud, mesh.polygons);
  EXPECT_EQ (floater.getNormals (), normals);
  for (std::size_t p = 0; p < points.size (); ++p) {
    EXPECT_EQ (points[p].getNormalVector3fMap (), normals[p]);
    if (p != 7) {
      EXPECT_EQ (points[p].getVector3fMap (), (*cloud)[p].getVector3fMap ());
    }
    EXPECT_EQ (normals[p].norm () == 0.0F, p == 7 || p == 0) << p; // the others face up
    EXPECT_GE (normals[p].z (), 0.0F);
  }
  // Nothing of them is left by a run that fails, or is not asked for them.
  floater.setKSearch (1);
  floater.reconstruct (mesh);
  EXPECT_NE (floater.getStatus (), RunStatus::SUCCESS);
  EXPECT_TRUE (floater.getNormals ().empty ());
}

TEST_F (FloaterClass, NormalsOfTheMeshReplaceThoseOfTheInput)
{
  const NormalCloud::Ptr cloud = bodyWithInwardNormals ();
  for (pcl::PointNormal& point : *cloud)
    point.curvature = 0.5F;
  pcl::FloaterReconstruction<pcl::PointNormal> floater;
  floater.setInputCloud (cloud);
  floater.setComputeNormals (true);
  NormalCloud points;
  Polygons polygons;
  floater.reconstruct (points, polygons);
  pcl::PolygonMesh mesh;
  floater.reconstruct (mesh);
  ASSERT_EQ (floater.getStatus (), RunStatus::SUCCESS) << floater.getMessage ();
  NormalCloud of_mesh;
  pcl::fromPCLPointCloud2 (mesh.cloud, of_mesh);
  ASSERT_EQ (points.size (), cloud->size ());
  ASSERT_EQ (of_mesh.size (), cloud->size ());
  for (std::size_t p = 0; p < points.size (); ++p) {
    EXPECT_GT (points[p].getNormalVector3fMap ().dot (points[p].getVector3fMap ().normalized ()),
               0.95F);
    EXPECT_EQ (points[p].getNormalVector3fMap (), floater.getNormals ()[p]);
    EXPECT_EQ (of_mesh[p].getNormalVector3fMap (), floater.getNormals ()[p]);
    EXPECT_EQ (points[p].curvature, 0.5F);
    EXPECT_LT ((*cloud)[p].getNormalVector3fMap ().dot ((*cloud)[p].getVector3fMap ()), 0.0F);
  }
}

} // namespace
} // namespace pcl::floater

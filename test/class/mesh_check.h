// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds on known surfaces and checks of the meshes made from them, for the tests of the PCL class.
#pragma once

#include "mesh_oracle.h"
#include "surfaces.h"

#include <pcl/Vertices.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/surface/floater_reconstruction.h>

#include <gtest/gtest.h>

namespace pcl::floater {
constexpr std::uint64_t SEED = 385; ///< of all clouds of these tests

constexpr const char* LINE_START = "[pcl::FloaterReconstruction::performReconstruction] ";

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Polygons = std::vector<pcl::Vertices>;
using Triangles = std::set<std::array<pcl::index_t, 3>>;

/// Points of a surface; fields other than x, y and z have the default values of PointT.
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr
makeCloud (SurfaceKind kind, std::size_t points)
{
  typename pcl::PointCloud<PointT>::Ptr cloud (new pcl::PointCloud<PointT>);
  for (const Eigen::Vector3d& position : generateSurface ({kind, points, SEED})) {
    PointT point;
    point.getVector3fMap () = position.cast<float> ();
    cloud->push_back (point);
  }
  return cloud;
}

inline Cloud::Ptr
heightField (std::size_t points = 500)
{
  return makeCloud<pcl::PointXYZ> (SurfaceKind::HEIGHT_FIELD, points);
}

/// The class with the topology of a disc, for what only discs have: parameters, and one loop.
class Floater : public pcl::FloaterReconstruction<pcl::PointXYZ>
{
public:
  Floater () { setTopology (Topology::DISC); }
};

/// Triangles without their order. Each begins at its smallest corner and keeps its orientation.
inline Triangles
trianglesOf (const Polygons& polygons)
{
  Triangles triangles;
  for (const pcl::Vertices& polygon : polygons) {
    pcl::Indices corners = polygon.vertices;
    EXPECT_EQ (corners.size (), 3U);
    std::rotate (corners.begin (), std::min_element (corners.begin (), corners.end ()),
                 corners.end ());
    EXPECT_TRUE (triangles.insert ({corners[0], corners[1], corners[2]}).second)
        << "a triangle twice";
  }
  return triangles;
}

/// Checks that triangles are one oriented disc over so many points, the first of a cloud, with so
/// many on its border.
inline void
expectDisc (const Triangles& triangles, std::size_t points, std::size_t border)
{
  const samples::MeshTopology topology = samples::topologyOf (triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (topology.vertices, points);
  EXPECT_EQ (topology.euler, 1);
  ASSERT_EQ (topology.loops.size (), 1U);
  EXPECT_EQ (topology.loops.front ().size (), border);
}

/// Runs and returns the triangles; expects success, and nothing but the warnings on the console.
template <typename PointT>
Triangles
runWell (pcl::FloaterReconstruction<PointT>& floater)
{
  pcl::PointCloud<PointT> points;
  Polygons polygons;
  testing::internal::CaptureStdout ();
  testing::internal::CaptureStderr ();
  floater.reconstruct (points, polygons);
  const std::string printed = testing::internal::GetCapturedStderr ();
  EXPECT_EQ (testing::internal::GetCapturedStdout (), "");
  const std::vector<std::string>& warnings = floater.getReport ().warnings;
  EXPECT_EQ (static_cast<std::size_t> (std::count (printed.begin (), printed.end (), '\n')),
             warnings.size ())
      << printed;
  for (const std::string& warning : warnings)
    EXPECT_NE (printed.find (LINE_START + warning + '\n'), std::string::npos) << printed;
  EXPECT_EQ (floater.getStatus (), RunStatus::SUCCESS) << floater.getMessage ();
  EXPECT_EQ (floater.getMessage (), "");
  return trianglesOf (polygons);
}

/// Runs both forms of reconstruct (), with an old mesh in the output. Expects the status, an empty
/// mesh, and one line of error on the console.
template <typename PointT>
void
expectFailure (pcl::FloaterReconstruction<PointT>& floater, RunStatus status)
{
  pcl::PointCloud<PointT> points (4, 1);
  Polygons polygons (2);
  pcl::PolygonMesh mesh;
  pcl::toPCLPointCloud2 (points, mesh.cloud);
  mesh.polygons.resize (2);
  for (const bool is_mesh : {true, false}) {
    testing::internal::CaptureStdout ();
    testing::internal::CaptureStderr ();
    is_mesh ? floater.reconstruct (mesh) : floater.reconstruct (points, polygons);
    const std::string error = testing::internal::GetCapturedStderr ();
    EXPECT_EQ (testing::internal::GetCapturedStdout (), "");
    EXPECT_EQ (std::count (error.begin (), error.end (), '\n'), 1) << error;
    const std::string line =
        LINE_START + std::string (statusName (status)) + ": " + floater.getMessage () + '\n';
    EXPECT_NE (error.find (line), std::string::npos) << error;
    EXPECT_FALSE (floater.getMessage ().empty ());
    EXPECT_STREQ (statusName (floater.getStatus ()), statusName (status)) << floater.getMessage ();
  }
  EXPECT_EQ (mesh.cloud.width * mesh.cloud.height, 0U);
  EXPECT_TRUE (mesh.cloud.data.empty () && mesh.polygons.empty ());
  EXPECT_EQ (points.width * points.height, 0U);
  EXPECT_TRUE (points.empty () && polygons.empty ());
}

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds on known surfaces and checks of the meshes made from them, for the tests of the PCL class.
#pragma once

#include "random_stream.h"
#include "surfaces.h"

#include <pcl/Vertices.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/surface/floater_reconstruction.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace pcl::floater {
constexpr std::uint64_t SEED = 385; ///< of all clouds of these tests

constexpr const char* LINE_START = "[pcl::FloaterReconstruction::performReconstruction] ";

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Polygons = std::vector<pcl::Vertices>;
using Triangles = std::set<std::array<pcl::index_t, 3>>;

/// Every failure shows the seed.
class FloaterClass : public testing::Test
{
private:
  testing::ScopedTrace trace_{__FILE__, __LINE__, "seed " + std::to_string (SEED)};
};

/// Points of a surface; fields other than x, y and z have the default values of PointT.
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr
makeCloud (SurfaceKind kind, std::size_t points)
{
  SurfaceSpec spec;
  spec.kind = kind;
  spec.points = points;
  spec.seed = SEED;
  typename pcl::PointCloud<PointT>::Ptr cloud (new pcl::PointCloud<PointT>);
  for (const Eigen::Vector3d& position : generateSurface (spec)) {
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

/// The same with all triangles turned over.
inline Triangles
turnedOver (const Triangles& triangles)
{
  Triangles turned;
  for (const auto& t : triangles)
    turned.insert ({t[0], t[2], t[1]});
  return turned;
}

/// Checks that triangles are one oriented manifold disc over exactly these points with this border.
inline void
expectDisc (const Triangles& triangles, const std::set<pcl::index_t>& points,
            const pcl::Indices& loop)
{
  std::set<std::pair<pcl::index_t, pcl::index_t>> edges;
  std::set<pcl::index_t> vertices;
  for (const auto& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      vertices.insert (t[i]);
      EXPECT_TRUE (edges.emplace (t[i], t[(i + 1) % 3]).second)
          << "two triangles run along the edge " << t[i] << ", " << t[(i + 1) % 3];
    }
  EXPECT_EQ (vertices, points);

  std::map<pcl::index_t, pcl::index_t> next_on_border;
  for (const auto& [from, to] : edges) {
    const bool on_border = edges.count ({to, from}) == 0;
    EXPECT_TRUE (!on_border || next_on_border.emplace (from, to).second)
        << "the border passes twice through " << from;
  }
  ASSERT_EQ (next_on_border.size (), loop.size ());
  const bool forward = next_on_border[loop[0]] == loop[1];
  for (std::size_t i = 0; i < loop.size (); ++i) {
    const pcl::index_t from = loop[i];
    const pcl::index_t to = loop[(i + 1) % loop.size ()];
    EXPECT_EQ (next_on_border[forward ? from : to], forward ? to : from);
  }
  // One border and Euler characteristic 1: V - E + F with 2E = 3F + border.
  EXPECT_EQ (triangles.size (), 2 * vertices.size () - 2 - loop.size ());
}

/// All indices of a cloud.
inline std::set<pcl::index_t>
allOf (std::size_t size)
{
  std::set<pcl::index_t> all;
  for (std::size_t i = 0; i < size; ++i)
    all.insert (all.end (), static_cast<pcl::index_t> (i));
  return all;
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

/// The same for a surface that is a disc over exactly these points.
template <typename PointT>
Triangles
runDisc (pcl::FloaterReconstruction<PointT>& floater, const std::set<pcl::index_t>& points)
{
  Triangles triangles = runWell (floater);
  expectDisc (triangles, points, floater.getBoundaryLoop ());
  return triangles;
}

/// Runs both forms of reconstruct (), with an old mesh in the output. Expects the status, an empty
/// mesh, and one line of error on the console.
template <typename PointT>
void
expectFailure (pcl::FloaterReconstruction<PointT>& floater, RunStatus status)
{
  const auto expect_error = [&] {
    const std::string error = testing::internal::GetCapturedStderr ();
    EXPECT_EQ (testing::internal::GetCapturedStdout (), "");
    EXPECT_EQ (std::count (error.begin (), error.end (), '\n'), 1) << error;
    const std::string line =
        LINE_START + std::string (statusName (status)) + ": " + floater.getMessage () + '\n';
    EXPECT_NE (error.find (line), std::string::npos) << error;
    EXPECT_FALSE (floater.getMessage ().empty ());
    EXPECT_STREQ (statusName (floater.getStatus ()), statusName (status)) << floater.getMessage ();
  };

  pcl::PolygonMesh mesh;
  pcl::toPCLPointCloud2 (pcl::PointCloud<PointT> (4, 1), mesh.cloud);
  mesh.polygons.resize (2);
  testing::internal::CaptureStdout ();
  testing::internal::CaptureStderr ();
  floater.reconstruct (mesh);
  expect_error ();
  EXPECT_EQ (mesh.cloud.width * mesh.cloud.height, 0U);
  EXPECT_TRUE (mesh.cloud.data.empty ());
  EXPECT_TRUE (mesh.polygons.empty ());

  pcl::PointCloud<PointT> points (4, 1);
  Polygons polygons (2);
  testing::internal::CaptureStdout ();
  testing::internal::CaptureStderr ();
  floater.reconstruct (points, polygons);
  expect_error ();
  EXPECT_TRUE (points.empty ());
  EXPECT_EQ (points.width * points.height, 0U);
  EXPECT_TRUE (polygons.empty ());
}

} // namespace pcl::floater

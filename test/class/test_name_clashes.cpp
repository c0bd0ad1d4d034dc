// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Our headers after those of X11 and curses, whose macros are plain words. What is used of Eigen,
// PCL and GoogleTest is included first: some of them do not stand these macros.
#include <pcl/Vertices.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/surface/reconstruction.h>
#include <pcl/types.h>

#include <Eigen/Core>

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

// clang-format off
#if __has_include(<X11/Xlib.h>)
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#endif
#if __has_include(<curses.h>)
#include <curses.h>
#endif
// clang-format on
// Where these headers are missing, the macros of theirs that are words.
#ifndef Status
#define Status int
#endif
#ifndef Bool
#define Bool int
#endif
#ifndef None
#define None 0L
#endif
#ifndef Success
#define Success 0
#endif
#ifndef Always
#define Always 2
#endif
#ifndef Complex
#define Complex 0
#endif
#ifndef OK
#define OK (0)
#endif
#ifndef ERR
#define ERR (-1)
#endif

#include <pcl/surface/floater_mesh_construction.h>

namespace pcl::floater {
namespace {
TEST (NameClashes, MacrosOfX11AndCursesDoNoHarm)
{
  static_assert (OK == 0 && ERR == -1 && None == 0 && Success == 0 && Always == 2 && Complex == 0,
                 "the macros are those of X11 and curses");
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud (new pcl::PointCloud<pcl::PointXYZ>);
  for (int row = 0; row < 10; ++row)
    for (int column = 0; column < 10; ++column)
      cloud->push_back (
          pcl::PointXYZ (static_cast<float> (column),
                         static_cast<float> (row) + 0.1F * static_cast<float> (column),
                         0.01F * static_cast<float> (row * row)));
  pcl::FloaterReconstruction<pcl::PointXYZ> floater;
  floater.setInputCloud (cloud);
  pcl::PolygonMesh mesh;
  floater.reconstruct (mesh);
  EXPECT_EQ (floater.getStatus (), RunStatus::SUCCESS) << floater.getMessage ();
  EXPECT_STREQ (statusName (floater.getStatus ()), "SUCCESS");
  EXPECT_EQ (mesh.polygons.size (), 162U);
  pcl::FloaterMeshConstruction<pcl::PointXYZ> mesher;
  mesher.setInputCloud (cloud);
  std::vector<pcl::Vertices> polygons;
  mesher.reconstruct (polygons);
  EXPECT_EQ (polygons.size (), mesh.polygons.size ());
}

} // namespace
} // namespace pcl::floater

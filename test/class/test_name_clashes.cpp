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
#else
#define Status int
#define Bool int
#define None 0L
#define Success 0
#define Always 2
#define Complex 0
#endif
#if __has_include(<curses.h>)
#include <curses.h>
#else
#define OK (0)
#define ERR (-1)
#endif
// clang-format on

#include <pcl/surface/floater_mesh_construction.h>

namespace pcl::floater {
namespace {
TEST (NameClashes, MacrosOfX11AndCursesDoNoHarm)
{
  static_assert (OK == 0 && ERR == -1 && None == 0 && Success == 0 && Always == 2 && Complex == 0,
                 "the macros are those of X11 and curses");
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud (new pcl::PointCloud<pcl::PointXYZ>);
  for (int i = 0; i < 100; ++i)
    cloud->push_back (pcl::PointXYZ (static_cast<float> (i % 10), 0.1F * static_cast<float> (i),
                                     0.0001F * static_cast<float> (i * i)));
  pcl::FloaterMeshConstruction<pcl::PointXYZ> mesher;
  mesher.setInputCloud (cloud);
  std::vector<pcl::Vertices> polygons;
  mesher.reconstruct (polygons);
  EXPECT_EQ (mesher.floater ().getStatus (), RunStatus::SUCCESS);
  EXPECT_EQ (polygons.size (), 162U);
}

} // namespace
} // namespace pcl::floater

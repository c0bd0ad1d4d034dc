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
#define None 0L
#define Success 0
#endif
#if __has_include(<curses.h>)
#include <curses.h>
#endif
// clang-format on

#include <pcl/surface/floater_mesh_construction.h>

TEST (NameClashes, MacrosOfX11AndCursesDoNoHarm)
{
  static_assert (None == 0 && Success == 0, "the macros are those of X11");
  pcl::FloaterMeshConstruction<pcl::PointXYZ> mesher;
  EXPECT_EQ (mesher.floater ().getStatus (), pcl::floater::RunStatus::NOT_RUN);
}

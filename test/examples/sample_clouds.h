// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds on known surfaces, where a program of yours would load a file.
#pragma once

#include <pcl/point_cloud.h>

#include <cmath>
#include <random>

constexpr float PI = 3.14159265F;

/// Displaces the points of a grid, so that they lie as irregularly as those of a scan.
class Jitter
{
public:
  /// \return a number from -0.25 to 0.25
  float operator() ()
  {
    return 0.5F * static_cast<float> (random_ ()) / static_cast<float> (std::mt19937::max ()) -
           0.25F;
  }

private:
  std::mt19937 random_{385};
};

/// A closed surface with one handle: 100 times 40 points on a torus with the radii 5 and 2.
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr
makeTorus ()
{
  constexpr int AROUND = 100, ACROSS = 40;
  Jitter jitter;
  typename pcl::PointCloud<PointT>::Ptr cloud (new pcl::PointCloud<PointT>);
  for (int i = 0; i < AROUND; ++i)
    for (int j = 0; j < ACROSS; ++j) {
      const float u = 2.0F * PI * (static_cast<float> (i) + jitter ()) / AROUND;
      const float v = 2.0F * PI * (static_cast<float> (j) + jitter ()) / ACROSS;
      const float to_axis = 5.0F + 2.0F * std::cos (v);
      PointT point;
      point.x = to_axis * std::cos (u);
      point.y = to_axis * std::sin (u);
      point.z = 2.0F * std::sin (v);
      cloud->push_back (point);
    }
  return cloud;
}

/// A disc: 50 times 50 points of hilly terrain.
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr
makeTerrain ()
{
  constexpr int SIDE = 50;
  Jitter jitter;
  typename pcl::PointCloud<PointT>::Ptr cloud (new pcl::PointCloud<PointT>);
  for (int i = 0; i < SIDE; ++i)
    for (int j = 0; j < SIDE; ++j) {
      PointT point;
      point.x = static_cast<float> (i) + jitter ();
      point.y = static_cast<float> (j) + jitter ();
      point.z = 2.0F * std::sin (0.3F * point.x) * std::cos (0.2F * point.y);
      cloud->push_back (point);
    }
  return cloud;
}

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Part of a pipeline: a coloured cloud is thinned out and connected, and each point gets the normal
// of its triangles. Normals are a result here, not an input.
#include "sample_clouds.h"

#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>
#include <pcl/surface/floater_reconstruction.h>

#include <Eigen/Geometry>

#include <iostream>

using Point = pcl::PointXYZRGBNormal;

/// Gives each point the mean normal of its triangles, weighted by their areas. All triangles face
/// outwards, so that all normals do.
static void
addNormals (pcl::PointCloud<Point>& points, const std::vector<pcl::Vertices>& triangles)
{
  for (Point& point : points)
    point.getNormalVector3fMap ().setZero ();
  for (const pcl::Vertices& triangle : triangles) {
    const Eigen::Vector3f a = points[triangle.vertices[0]].getVector3fMap ();
    const Eigen::Vector3f b = points[triangle.vertices[1]].getVector3fMap ();
    const Eigen::Vector3f c = points[triangle.vertices[2]].getVector3fMap ();
    for (const pcl::index_t corner : triangle.vertices)
      points[corner].getNormalVector3fMap () += (b - a).cross (c - a);
  }
  for (Point& point : points)
    point.getNormalVector3fMap ().normalize ();
}

int
main ()
{
  const pcl::PointCloud<Point>::Ptr cloud = makeTorus<Point> ();
  for (Point& point : *cloud) { // red on top, blue below
    point.r = point.z > 0.0F ? 255 : 0;
    point.b = point.z > 0.0F ? 0 : 255;
  }

  // The points of a voxel become one, with their mean place and colour.
  const pcl::PointCloud<Point>::Ptr thinned (new pcl::PointCloud<Point>);
  pcl::VoxelGrid<Point> grid;
  grid.setInputCloud (cloud);
  grid.setLeafSize (0.4F, 0.4F, 0.4F);
  grid.filter (*thinned);

  pcl::FloaterReconstruction<Point> floater;
  floater.setInputCloud (thinned);
  pcl::PointCloud<Point> points;
  std::vector<pcl::Vertices> triangles;
  floater.reconstruct (points, triangles);
  if (floater.getStatus () != pcl::floater::RunStatus::SUCCESS) {
    std::cerr << floater.getMessage () << '\n';
    return 1;
  }
  addNormals (points, triangles);
  std::cout << cloud->size () << " points, " << points.size () << " after thinning, "
            << triangles.size () << " triangles\n";

  std::size_t wrong = 0;
  for (const Point& point : points) {
    // From the middle of the tube, a normal leads outwards.
    const Eigen::Vector3f at = point.getVector3fMap ();
    const Eigen::Vector3f middle = 5.0F * Eigen::Vector3f (at.x (), at.y (), 0.0F).normalized ();
    const bool is_outwards = point.getNormalVector3fMap ().dot ((at - middle).normalized ()) > 0.8F;
    const bool is_coloured = std::abs (at.z ()) < 0.5F || (point.r > point.b) == (at.z () > 0.0F);
    wrong += is_outwards && is_coloured ? 0 : 1;
  }
  if (wrong > 0)
    std::cerr << wrong << " points with a wrong normal or colour\n";
  return wrong == 0 ? 0 : 1;
}

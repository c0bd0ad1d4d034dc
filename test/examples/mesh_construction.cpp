// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The same step of a program by pcl::GreedyProjectionTriangulation, and by what takes its place.
#include "sample_clouds.h"

#include <pcl/common/io.h>
#include <pcl/features/normal_3d.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/floater_mesh_construction.h>
#include <pcl/surface/gp3.h>
#include <pcl/surface/impl/gp3.hpp> // instead of linking pcl_surface, which loads VTK

#include <algorithm>
#include <iostream>

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

static std::vector<pcl::Vertices>
byGreedyProjection (const Cloud::Ptr& cloud)
{
  pcl::search::KdTree<pcl::PointXYZ>::Ptr tree (new pcl::search::KdTree<pcl::PointXYZ>);
  tree->setInputCloud (cloud);
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud (cloud);
  estimation.setSearchMethod (tree);
  estimation.setKSearch (20);
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute (normals);
  pcl::PointCloud<pcl::PointNormal>::Ptr with_normals (new pcl::PointCloud<pcl::PointNormal>);
  pcl::concatenateFields (*cloud, normals, *with_normals);

  pcl::GreedyProjectionTriangulation<pcl::PointNormal> mesher;
  mesher.setSearchRadius (1.5);
  mesher.setMu (2.5);
  mesher.setMaximumNearestNeighbors (100);
  mesher.setMaximumSurfaceAngle (M_PI / 4);
  mesher.setMinimumAngle (M_PI / 18);
  mesher.setMaximumAngle (2 * M_PI / 3);
  mesher.setNormalConsistency (false);
  mesher.setInputCloud (with_normals);
  mesher.setSearchMethod (pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>> ());
  std::vector<pcl::Vertices> triangles;
  mesher.reconstruct (triangles);
  return triangles;
}

int
main ()
{
  const Cloud::Ptr cloud = makeTorus<pcl::PointXYZ> ();
  std::cout << "before: " << byGreedyProjection (cloud).size () << " triangles\n";

  pcl::FloaterMeshConstruction<pcl::PointXYZ> mesher;
  mesher.setInputCloud (cloud);
  std::vector<pcl::Vertices> triangles;
  mesher.reconstruct (triangles);
  if (triangles.empty ()) {
    std::cerr << mesher.floater ().getMessage () << '\n';
    return 1;
  }
  const std::vector<int> parts = mesher.floater ().getPartIDs ();
  const std::vector<int> states = mesher.floater ().getPointStates ();
  std::cout << "after:  " << triangles.size () << " triangles\n";

  // One closed component: all points are in part 0 and surrounded by triangles.
  const auto completed = pcl::FloaterReconstruction<pcl::PointXYZ>::COMPLETED;
  const auto points = static_cast<std::ptrdiff_t> (cloud->size ());
  return std::count (parts.begin (), parts.end (), 0) == points &&
                 std::count (states.begin (), states.end (), completed) == points
             ? 0
             : 1;
}

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A pipeline of PCL: a cloud is thinned out, freed of strays, and connected.
#include "sample_clouds.h"

#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>
#include <pcl/surface/floater_reconstruction.h>

#include <iostream>

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/// A torus of which every place was measured three times, and a hundred strays around it.
static Cloud::Ptr
measure ()
{
  const Cloud::Ptr cloud = makeTorus<pcl::PointXYZ> ();
  Jitter jitter;
  const std::size_t places = cloud->size ();
  for (std::size_t i = 0; i < 2 * places; ++i) {
    pcl::PointXYZ point = (*cloud)[i % places];
    for (float* coordinate : {&point.x, &point.y, &point.z})
      *coordinate += 0.04F * jitter ();
    cloud->push_back (point);
  }
  for (int i = 0; i < 100; ++i)
    cloud->push_back ({40.0F * jitter (), 40.0F * jitter (), 40.0F * jitter ()});
  return cloud;
}

int
main ()
{
  const Cloud::Ptr cloud = measure ();

  // All points of a voxel become one. A voxel is about as wide as the triangles shall be.
  const Cloud::Ptr thinned (new Cloud);
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setInputCloud (cloud);
  grid.setLeafSize (0.3F, 0.3F, 0.3F);
  grid.filter (*thinned);

  // Points that are much farther from their neighbours than usual are no part of the surface.
  const Cloud::Ptr cleaned (new Cloud);
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> strays;
  strays.setInputCloud (thinned);
  strays.setMeanK (20);
  strays.setStddevMulThresh (2.0);
  strays.filter (*cleaned);

  pcl::FloaterReconstruction<pcl::PointXYZ> floater;
  floater.setInputCloud (cleaned);
  pcl::PolygonMesh mesh;
  floater.reconstruct (mesh);
  if (floater.getStatus () != pcl::floater::RunStatus::SUCCESS) {
    std::cerr << floater.getMessage () << '\n';
    return 1;
  }
  std::cout << cloud->size () << " points, " << thinned->size () << " after thinning, "
            << cleaned->size () << " without strays, " << mesh.polygons.size () << " triangles\n";

  const pcl::floater::MeshCheck& check = floater.getMeshCheck ();
  const bool is_torus = check.components == 1 && check.genus == 1 && check.loops.empty ();
  return is_torus && thinned->size () < cloud->size () && cleaned->size () < thinned->size () ? 0
                                                                                              : 1;
}

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A point type of one's own: all of its fields are in the mesh.
#define PCL_NO_PRECOMPILE // before the first header of PCL; link FLANN::FLANN as well
#include "sample_clouds.h"

#include <pcl/conversions.h>
#include <pcl/point_types.h>
#include <pcl/register_point_struct.h>
#include <pcl/surface/floater_reconstruction.h>

#include <cstdint>
#include <iostream>

struct LidarPoint
{
  PCL_ADD_POINT4D
  std::uint16_t ring = 0;
  double time = 0.0;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

POINT_CLOUD_REGISTER_POINT_STRUCT (LidarPoint, (float, x, x) (float, y, y) (float, z, z) (
                                                   std::uint16_t, ring, ring) (double, time, time))

int
main ()
{
  const pcl::PointCloud<LidarPoint>::Ptr cloud = makeTerrain<LidarPoint> ();
  for (std::size_t i = 0; i < cloud->size (); ++i) {
    (*cloud)[i].ring = static_cast<std::uint16_t> (i % 64);
    (*cloud)[i].time = 1e9 + static_cast<double> (i);
  }

  pcl::FloaterReconstruction<LidarPoint> floater;
  floater.setInputCloud (cloud);
  pcl::PolygonMesh mesh;
  floater.reconstruct (mesh);
  if (floater.getStatus () != pcl::floater::RunStatus::SUCCESS) {
    std::cerr << floater.getMessage () << '\n';
    return 1;
  }

  // The vertices are the points of the cloud, in its order.
  pcl::PointCloud<LidarPoint> vertices;
  pcl::fromPCLPointCloud2 (mesh.cloud, vertices);
  if (vertices.size () != cloud->size ())
    return 1;
  for (std::size_t i = 0; i < vertices.size (); ++i)
    if (vertices[i].ring != (*cloud)[i].ring || vertices[i].time != (*cloud)[i].time) {
      std::cerr << "vertex " << i << " has lost its fields\n";
      return 1;
    }
  std::cout << mesh.polygons.size () << " triangles, all fields kept\n";
  return floater.getMeshCheck ().loops.size () == 1 ? 0 : 1;
}

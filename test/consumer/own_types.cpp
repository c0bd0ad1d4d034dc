// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A point type of PCL's own: the library holds the class for it.
#include <pcl/point_types.h>
#include <pcl/surface/floater_reconstruction.h>

#include <cmath>
#include <iostream>

int
main ()
{
  constexpr std::size_t SIDE = 20;
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud (new pcl::PointCloud<pcl::PointXYZ>);
  for (std::size_t i = 0; i < SIDE * SIDE; ++i) {
    const auto x = static_cast<float> (i % SIDE), y = static_cast<float> (i / SIDE) + 0.01F * x;
    cloud->push_back (pcl::PointXYZ (x, y, std::sin (0.4F * x) * std::cos (0.3F * y)));
  }
  pcl::FloaterReconstruction<pcl::PointXYZ> floater;
  floater.setInputCloud (cloud);
  pcl::PolygonMesh mesh;
  floater.reconstruct (mesh);
  std::cout << pcl::floater::statusName (floater.getStatus ()) << ": " << mesh.polygons.size ()
            << " triangles\n"
            << floater.getMessage ();
  return mesh.polygons.size () == 2 * (SIDE - 1) * (SIDE - 1) ? 0 : 1;
}

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// From a cloud to a mesh, and what the report tells about it.
#include "sample_clouds.h"

#include <pcl/point_types.h>
#include <pcl/surface/floater_reconstruction.h>

#include <iostream>

int
main ()
{
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud = makeTorus<pcl::PointXYZ> ();

  pcl::FloaterReconstruction<pcl::PointXYZ> floater;
  floater.setInputCloud (cloud);
  pcl::PolygonMesh mesh;
  floater.reconstruct (mesh);
  if (floater.getStatus () != pcl::floater::RunStatus::SUCCESS) {
    std::cerr << floater.getMessage () << '\n';
    return 1;
  }
  for (const std::string& warning : floater.getReport ().warnings)
    std::cerr << "warning: " << warning << '\n';

  const pcl::floater::MeshCheck& check = floater.getMeshCheck ();
  std::cout << mesh.polygons.size () << " triangles, components: " << check.components
            << ", handles: " << check.genus << ", boundary loops: " << check.loops.size () << '\n';

  const bool is_torus = check.components == 1 && check.genus == 1 && check.loops.empty ();
  const bool has_all_points = floater.getStatistics ().used_points == cloud->size ();
  return is_torus && has_all_points ? 0 : 1;
}

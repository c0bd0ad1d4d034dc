// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A surface with one boundary loop, laid out in a square: the same triangles in space and in the
// plane, for texture coordinates, say.
#include "sample_clouds.h"

#include <pcl/point_types.h>
#include <pcl/surface/floater_reconstruction.h>

#include <Eigen/Core>

#include <iostream>

int
main ()
{
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud = makeTerrain<pcl::PointXYZ> ();

  pcl::FloaterReconstruction<pcl::PointXYZ> floater;
  floater.setInputCloud (cloud);
  floater.setTopology (pcl::floater::Topology::DISC);
  pcl::floater::DiscOptions options = floater.getDiscOptions ();
  options.domain.curve = pcl::floater::Domain::SQUARE;
  floater.setDiscOptions (options);

  pcl::PolygonMesh mesh;
  floater.reconstruct (mesh);
  if (floater.getStatus () != pcl::floater::RunStatus::SUCCESS) {
    std::cerr << floater.getMessage () << '\n';
    return 1;
  }

  // One place in the plane for each point of the cloud; NaN for points that are in no triangle.
  const std::vector<Eigen::Vector2d>& uv = floater.getParameters ();
  const std::vector<pcl::index_t>& loop = floater.getBoundaryLoop ();
  std::cout << mesh.polygons.size () << " triangles, boundary loop of " << loop.size ()
            << " points\n";

  // The corners of the square are on the unit circle. Its sides are bent outwards a little.
  std::size_t outside = 0;
  for (const Eigen::Vector2d& place : uv)
    outside += place.norm () < 1.0 + 1e-9 ? 0 : 1; // NaN counts, too
  return uv.size () == cloud->size () && outside == 0 ? 0 : 1;
}

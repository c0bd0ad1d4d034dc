// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh with the colours of its points and normals of its triangles, for MeshLab, CloudCompare or
// Blender.
#include "sample_clouds.h"

#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>
#include <pcl/surface/floater_reconstruction.h>

#include <cstdio>
#include <iostream>

using Point = pcl::PointXYZRGBNormal;

int
main ()
{
  // A coloured torus, where a program of yours would load a scan.
  const pcl::PointCloud<Point>::Ptr cloud = makeTorus<Point> ();
  for (Point& point : *cloud) { // red on top, blue below
    point.r = point.z > 0.0F ? 255 : 0;
    point.b = point.z > 0.0F ? 0 : 255;
  }
  const std::string file = "example_mesh_for_viewers.ply";

  pcl::FloaterReconstruction<Point> floater;
  floater.setInputCloud (cloud);
  floater.setComputeNormals (true); // those of the triangles around each point
  pcl::PolygonMesh mesh;
  floater.reconstruct (mesh);
  if (mesh.polygons.empty () || pcl::io::savePLYFileBinary (file, mesh) != 0) {
    std::cerr << floater.getMessage () << '\n';
    return 1;
  }

  // What a viewer finds in the file.
  pcl::PolygonMesh read;
  pcl::PointCloud<Point> vertices;
  const bool is_read = pcl::io::loadPLYFile (file, read) == 0;
  if (is_read)
    pcl::fromPCLPointCloud2 (read.cloud, vertices);
  std::remove (file.c_str ());
  std::size_t right = 0;
  for (std::size_t i = 0; i < vertices.size (); ++i) {
    // From the middle of the tube, a normal leads outwards.
    const Eigen::Vector3f at = vertices[i].getVector3fMap ();
    const Eigen::Vector3f middle = 5.0F * Eigen::Vector3f (at.x (), at.y (), 0.0F).normalized ();
    const float outwards = vertices[i].getNormalVector3fMap ().dot ((at - middle).normalized ());
    right += outwards > 0.8F && vertices[i].rgba << 8U == (*cloud)[i].rgba << 8U ? 1 : 0;
  }
  std::cout << read.polygons.size ()
            << " triangles, vertices with their colour and a normal: " << right << '\n';
  return right == cloud->size () && read.polygons.size () == 2 * cloud->size () ? 0 : 1;
}

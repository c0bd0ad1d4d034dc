// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh with the colours and normals of its points, for MeshLab, CloudCompare or Blender.
#include "sample_clouds.h"

#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>
#include <pcl/surface/floater_reconstruction.h>

#include <cstdio>
#include <iostream>

using Point = pcl::PointXYZRGBNormal;

/// A coloured torus with normals, where a program of yours would load a scan.
static pcl::PointCloud<Point>::Ptr
makeColouredTorus ()
{
  pcl::PointCloud<Point>::Ptr cloud = makeTorus<Point> ();
  for (Point& point : *cloud) {
    const Eigen::Vector3f at = point.getVector3fMap ();
    const Eigen::Vector3f middle = 5.0F * Eigen::Vector3f (at.x (), at.y (), 0.0F).normalized ();
    point.getNormalVector3fMap () = (at - middle).normalized ();
    point.r = point.z > 0.0F ? 255 : 40;
    point.g = 120;
    point.b = point.x > 0.0F ? 255 : 40;
  }
  return cloud;
}

int
main ()
{
  const pcl::PointCloud<Point>::Ptr cloud = makeColouredTorus ();
  const std::string file = "example_mesh_for_viewers.ply";

  pcl::FloaterReconstruction<Point> floater;
  floater.setInputCloud (cloud);
  floater.setFacing (pcl::floater::Facing::NORMALS); // the mesh faces where they point to
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
  if (!is_read || vertices.size () != cloud->size () || read.polygons.size () != 2 * cloud->size ())
    return 1;
  for (std::size_t i = 0; i < vertices.size (); ++i)
    if (vertices[i].rgba << 8U != (*cloud)[i].rgba << 8U ||
        vertices[i].getNormalVector3fMap () != (*cloud)[i].getNormalVector3fMap ()) {
      std::cerr << "vertex " << i << " has lost its colour or its normal\n";
      return 1;
    }
  std::cout << read.polygons.size () << " triangles with colours and normals\n";
  return 0;
}

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A point type of the user's own: the class is instantiated here, from the installed templates.
#define PCL_NO_PRECOMPILE
#include "height_field.h"

#include <pcl/point_types.h>
#include <pcl/register_point_struct.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/floater_mesh_construction.h>

#include <cstdint>

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
  const pcl::PointCloud<LidarPoint>::Ptr cloud = makeHeightField<LidarPoint> ();
  for (std::size_t i = 0; i < cloud->size (); ++i) {
    (*cloud)[i].ring = static_cast<std::uint16_t> (i % 64);
    (*cloud)[i].time = 1e9 + static_cast<double> (i);
  }
  pcl::PolygonMesh mesh;
  if (const int failure = reconstructHeightField (*cloud, mesh))
    return failure;

  pcl::PointCloud<LidarPoint> vertices;
  pcl::fromPCLPointCloud2 (mesh.cloud, vertices);
  for (std::size_t i = 0; i < vertices.size (); ++i)
    if (vertices[i].ring != (*cloud)[i].ring || vertices[i].time != (*cloud)[i].time) {
      std::cerr << "vertex " << i << " has lost its fields\n";
      return 1;
    }

  // With a search method of this type, too.
  pcl::FloaterReconstruction<LidarPoint> floater;
  floater.setInputCloud (cloud);
  floater.setSearchMethod (pcl::make_shared<pcl::search::KdTree<LidarPoint>> ());
  pcl::PointCloud<LidarPoint> points;
  std::vector<pcl::Vertices> polygons;
  floater.reconstruct (points, polygons);
  if (!isHeightField (points, polygons)) {
    std::cerr << "with a search method of the user: " << floater.getMessage () << '\n';
    return 1;
  }

  // As a mesh construction, and what it tells of the points.
  pcl::FloaterMeshConstruction<LidarPoint> mesher;
  mesher.setInputCloud (cloud);
  mesher.reconstruct (polygons);
  if (!isHeightField (*cloud, polygons) ||
      mesher.floater ().getPartIDs () != std::vector<int> (cloud->size (), 0)) {
    std::cerr << "as a mesh construction: " << mesher.floater ().getMessage () << '\n';
    return 1;
  }
  return 0;
}

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The way from a map of coloured scans to a textured mesh: the scans are merged, their normals
// point to the cameras, a mesh is made, and each triangle is shown by a camera that sees it. The
// mesh is made by pcl::GreedyProjectionTriangulation, and then by what takes its place, in the same
// program.
#include "sample_clouds.h"

#include <pcl/common/io.h>
#include <pcl/common/transforms.h>
#include <pcl/conversions.h>
#include <pcl/features/normal_3d.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/floater_mesh_construction.h>
#include <pcl/surface/gp3.h>
#include <pcl/surface/impl/gp3.hpp> // instead of linking pcl_surface, which loads VTK
#include <pcl/surface/impl/texture_mapping.hpp>
#include <pcl/surface/texture_mapping.h>

#include <algorithm>
#include <iostream>
#include <set>

using Point = pcl::PointXYZRGBNormal;
using Cloud = pcl::PointCloud<Point>;
using Cameras = pcl::texture_mapping::CameraVector;

/// Cameras around the torus, that look at its centre.
static Cameras
placeCameras ()
{
  Cameras cameras;
  for (const float height : {12.0F, -12.0F})
    for (int i = 0; i < 4; ++i) {
      const float angle = 0.5F * PI * (static_cast<float> (i) + 0.3F);
      const Eigen::Vector3f place (12.0F * std::cos (angle), 12.0F * std::sin (angle), height);
      pcl::texture_mapping::Camera camera;
      camera.pose = Eigen::Translation3f (place) *
                    Eigen::Quaternionf::FromTwoVectors (Eigen::Vector3f::UnitZ (), -place);
      camera.focal_length = 600.0;
      camera.width = 640.0;
      camera.height = 480.0;
      camera.texture_file = "camera" + std::to_string (cameras.size ()) + ".jpg";
      cameras.push_back (camera);
    }
  return cameras;
}

/// The points of a torus that face a camera, red on top and blue below. No scan has those of
/// another.
static Cloud::Ptr
scanFrom (const pcl::texture_mapping::Camera& camera)
{
  const Eigen::Vector3f place = camera.pose.translation ();
  const Cloud::Ptr all = makeTorus<Point> (), seen (new Cloud);
  const Eigen::AngleAxisf turn (place.x (), Eigen::Vector3f::UnitZ ());
  for (Point point : *all) {
    point.getVector3fMap () = turn * point.getVector3fMap ();
    const Eigen::Vector3f at = point.getVector3fMap ();
    const Eigen::Vector3f middle = 5.0F * Eigen::Vector3f (at.x (), at.y (), 0.0F).normalized ();
    point.r = point.z > 0.0F ? 255 : 0;
    point.b = point.z > 0.0F ? 0 : 255;
    if ((at - middle).dot (place - at) > 0.0F)
      seen->push_back (point);
  }
  return seen;
}

/// Normals that point to the camera.
static void
estimateNormals (Cloud& scan, const Eigen::Vector3f& camera)
{
  pcl::NormalEstimation<Point, Point> estimation;
  estimation.setInputCloud (scan.makeShared ());
  estimation.setKSearch (12);
  estimation.setViewPoint (camera.x (), camera.y (), camera.z ());
  pcl::PointCloud<Point> normals;
  estimation.compute (normals);
  for (std::size_t i = 0; i < scan.size (); ++i)
    scan[i].getNormalVector3fMap () = normals[i].getNormalVector3fMap ();
}

/// All scans as one cloud. Points of a voxel become one, with their mean colour and normal.
static Cloud::Ptr
mergeScans (const Cameras& cameras)
{
  const Cloud::Ptr all (new Cloud), merged (new Cloud);
  for (const pcl::texture_mapping::Camera& camera : cameras) {
    const Cloud::Ptr scan = scanFrom (camera);
    estimateNormals (*scan, camera.pose.translation ());
    *all += *scan;
  }
  pcl::VoxelGrid<Point> grid;
  grid.setInputCloud (all);
  grid.setLeafSize (0.3F, 0.3F, 0.3F);
  grid.filter (*merged);
  return merged;
}

static pcl::PolygonMesh
meshByGreedyProjection (const Cloud::Ptr& cloud)
{
  pcl::GreedyProjectionTriangulation<Point> mesher;
  mesher.setSearchRadius (1.2);
  mesher.setMu (2.5);
  mesher.setMaximumNearestNeighbors (100);
  mesher.setMaximumSurfaceAngle (M_PI / 4);
  mesher.setMinimumAngle (M_PI / 18);
  mesher.setMaximumAngle (2 * M_PI / 3);
  mesher.setNormalConsistency (true);
  mesher.setConsistentVertexOrdering (true);
  mesher.setSearchMethod (pcl::make_shared<pcl::search::KdTree<Point>> ());
  mesher.setInputCloud (cloud);
  pcl::PolygonMesh mesh;
  mesher.reconstruct (mesh);
  return mesh;
}

static pcl::PolygonMesh
meshByFloater (const Cloud::Ptr& cloud)
{
  pcl::FloaterMeshConstruction<Point> mesher;
  mesher.floater ().setFacing (pcl::floater::Facing::NORMALS);
  mesher.setInputCloud (cloud);
  pcl::PolygonMesh mesh;
  mesher.reconstruct (mesh);
  return mesh;
}

/// Sorts the triangles by the camera that shows them; those that none shows come last.
static pcl::TextureMesh
addTexture (const pcl::PolygonMesh& mesh, const Cameras& cameras)
{
  pcl::TextureMesh textured;
  textured.cloud = mesh.cloud;
  textured.tex_polygons = {mesh.polygons};
  pcl::TextureMapping<Point> mapping;
  mapping.textureMeshwithMultipleCameras (textured, cameras);
  return textured;
}

/// Sides of triangles that no other triangle has the other way round: at gaps, and where two face
/// different ways.
static std::size_t
countBoundaryEdges (const pcl::PolygonMesh& mesh)
{
  std::set<std::pair<pcl::index_t, pcl::index_t>> sides;
  for (const pcl::Vertices& triangle : mesh.polygons)
    for (std::size_t i = 0; i < 3; ++i)
      sides.emplace (triangle.vertices[i], triangle.vertices[(i + 1) % 3]);
  return static_cast<std::size_t> (
      std::count_if (sides.begin (), sides.end (), [&] (const auto& side) {
        return sides.count ({side.second, side.first}) == 0;
      }));
}

int
main ()
{
  const Cameras cameras = placeCameras ();
  const Cloud::Ptr cloud = mergeScans (cameras);

  const pcl::PolygonMesh before = meshByGreedyProjection (cloud);
  const pcl::PolygonMesh after = meshByFloater (cloud);
  std::cout << "before: " << before.polygons.size ()
            << " triangles, sides without a neighbour: " << countBoundaryEdges (before) << '\n'
            << "after:  " << after.polygons.size ()
            << " triangles, sides without a neighbour: " << countBoundaryEdges (after) << '\n';
  if (after.polygons.size () != 2 * cloud->size () || countBoundaryEdges (after) != 0)
    return 1; // it is no torus with all points

  Cloud vertices; // which have the colours of the scans
  pcl::fromPCLPointCloud2 (after.cloud, vertices);
  for (std::size_t i = 0; i < vertices.size (); ++i)
    if (vertices[i].rgba != (*cloud)[i].rgba)
      return 1;

  const pcl::TextureMesh textured = addTexture (after, cameras);
  const std::size_t not_shown = textured.tex_polygons.back ().size ();
  std::cout << after.polygons.size () - not_shown << " triangles have a texture\n";
  return 10 * not_shown < after.polygons.size () ? 0 : 1;
}

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A height field, and a check of its mesh.
#pragma once

#include <pcl/conversions.h>
#include <pcl/surface/floater_reconstruction.h>

#include <cmath>
#include <iostream>
#include <random>
#include <set>

/// A grid of 20 by 20 points, each slightly displaced.
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr
makeHeightField ()
{
  std::mt19937 random (42);
  const auto offset = [&random] {
    return 0.3F * static_cast<float> (random ()) / static_cast<float> (std::mt19937::max ());
  };
  typename pcl::PointCloud<PointT>::Ptr cloud (new pcl::PointCloud<PointT>);
  for (int row = 0; row < 20; ++row)
    for (int column = 0; column < 20; ++column) {
      PointT point;
      point.x = static_cast<float> (column) + offset ();
      point.y = static_cast<float> (row) + offset ();
      point.z = std::sin (0.4F * point.x) * std::cos (0.3F * point.y);
      cloud->push_back (point);
    }
  return cloud;
}

/// Whether a mesh is one disc over all points of the height field without folds in plan view.
template <typename PointT>
bool
isHeightField (const pcl::PointCloud<PointT>& cloud, const std::vector<pcl::Vertices>& polygons)
{
  std::set<pcl::index_t> used;
  std::set<std::pair<pcl::index_t, pcl::index_t>> edges;
  std::size_t upward = 0;
  for (const pcl::Vertices& polygon : polygons) {
    const pcl::Indices& v = polygon.vertices;
    if (v.size () != 3)
      return false;
    for (std::size_t i = 0; i < 3; ++i) {
      used.insert (v[i]);
      if (!edges.emplace (v[i], v[(i + 1) % 3]).second)
        return false;
    }
    const PointT &a = cloud[v[0]], &b = cloud[v[1]], &c = cloud[v[2]];
    upward += (b.x - a.x) * (c.y - a.y) > (b.y - a.y) * (c.x - a.x) ? 1 : 0;
  }
  std::size_t border = 0;
  for (const auto& edge : edges)
    border += edges.count ({edge.second, edge.first}) == 0 ? 1 : 0;
  return used.size () == cloud.size () && polygons.size () == 2 * cloud.size () - 2 - border &&
         (upward == 0 || upward == polygons.size ());
}

/// Reconstructs with the default options and checks the mesh.
/// \return exit code of the program
template <typename PointT>
int
reconstructHeightField (const pcl::PointCloud<PointT>& cloud, pcl::PolygonMesh& mesh)
{
  pcl::FloaterReconstruction<PointT> floater;
  floater.setInputCloud (cloud.makeShared ());
  floater.reconstruct (mesh);
  if (floater.getStatus () != pcl::floater::RunStatus::SUCCESS) {
    std::cerr << pcl::floater::statusName (floater.getStatus ()) << ": " << floater.getMessage ()
              << '\n';
    return 1;
  }
  pcl::PointCloud<PointT> vertices;
  pcl::fromPCLPointCloud2 (mesh.cloud, vertices);
  if (vertices.size () != cloud.size () || !isHeightField (vertices, mesh.polygons)) {
    std::cerr << "the mesh of " << mesh.polygons.size ()
              << " triangles is not that of the height field\n";
    return 1;
  }
  std::cout << mesh.polygons.size () << " triangles\n";
  return 0;
}

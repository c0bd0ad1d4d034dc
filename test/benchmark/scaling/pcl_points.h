// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points to PCL, polygons from it.
#pragma once

#include "cloud.h"

#include <pcl/Vertices.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <vector>

namespace pcl
{
namespace floater
{
inline pcl::PointCloud<pcl::PointXYZ>::Ptr
toPcl (const std::vector<Eigen::Vector3d>& points)
{
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud (new pcl::PointCloud<pcl::PointXYZ>);
  cloud->resize (points.size ());
  for (std::size_t i = 0; i < points.size (); ++i)
    (*cloud)[i].getVector3fMap () = points[i].cast<float> ();
  return cloud;
}

/// \param polygons of three vertices each
inline Triangles
fromPcl (const std::vector<pcl::Vertices>& polygons)
{
  Triangles triangles (polygons.size ());
  for (std::size_t t = 0; t < triangles.size (); ++t)
    std::transform (polygons[t].vertices.begin (), polygons[t].vertices.begin () + 3,
                    triangles[t].begin (),
                    [] (pcl::index_t p) { return static_cast<std::uint32_t> (p); });
  return triangles;
}

} // namespace floater
} // namespace pcl

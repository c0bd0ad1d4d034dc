// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_measures.h"

#include "picture_files.h"
#include "points/kd_tree.h"

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <stdexcept>

namespace pcl
{
namespace floater
{
namespace
{
Eigen::Vector3d
normalOf (const Triangle& t, const std::vector<Eigen::Vector3d>& positions)
{
  return (positions[t[1]] - positions[t[0]]).cross (positions[t[2]] - positions[t[0]]);
}

} // namespace

Edges
edgesOf (const std::vector<Triangle>& triangles)
{
  Edges edges;
  edges.reserve (3 * triangles.size ());
  for (const Triangle& t : triangles)
    for (std::size_t side = 0; side < 3; ++side)
      edges.push_back (
          {std::min (t[side], t[(side + 1) % 3]), std::max (t[side], t[(side + 1) % 3])});
  std::sort (edges.begin (), edges.end ());
  edges.erase (std::unique (edges.begin (), edges.end ()), edges.end ());
  return edges;
}

std::size_t
commonEdges (const Edges& a, const Edges& b)
{
  std::size_t common = 0;
  for (auto i = a.begin (), j = b.begin (); i != a.end () && j != b.end ();) {
    if (*i < *j)
      ++i;
    else if (*j < *i)
      ++j;
    else {
      ++common;
      ++i;
      ++j;
    }
  }
  return common;
}

std::vector<Triangle>
readGroundTruth (const std::filesystem::path& cloud, std::size_t points)
{
  std::filesystem::path path = cloud;
  path.replace_extension (".gt.ply");
  if (!std::filesystem::exists (path))
    return {};
  const vtkSmartPointer<vtkPolyData> mesh = readMesh (path.string ());
  if (static_cast<std::size_t> (mesh->GetNumberOfPoints ()) != points)
    throw std::runtime_error ("'" + path.string () +
                              "' has not as many vertices as the cloud has points");
  std::vector<Triangle> triangles;
  vtkNew<vtkIdList> polygon;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells (); ++cell) {
    mesh->GetCellPoints (cell, polygon);
    if (polygon->GetNumberOfIds () != 3)
      throw std::runtime_error ("'" + path.string () + "' has polygons that are no triangles");
    triangles.push_back ({static_cast<Index> (polygon->GetId (0)),
                          static_cast<Index> (polygon->GetId (1)),
                          static_cast<Index> (polygon->GetId (2))});
  }
  return triangles;
}

std::size_t
turnedTriangles (const std::vector<Triangle>& triangles, const std::vector<Triangle>& truth,
                 const std::vector<Eigen::Vector3d>& positions)
{
  std::vector<Eigen::Vector3d> normals (positions.size (), Eigen::Vector3d::Zero ());
  for (const Triangle& t : truth)
    for (const Index corner : t)
      normals[corner] += normalOf (t, positions);
  for (Eigen::Vector3d& normal : normals)
    normal.normalize ();
  std::size_t turned = 0;
  for (const Triangle& t : triangles)
    if (normalOf (t, positions).dot (normals[t[0]] + normals[t[1]] + normals[t[2]]) < 0.0)
      ++turned;
  return std::min (turned, triangles.size () - turned);
}

double
smallestDistance (const std::vector<Eigen::Vector2d>& points)
{
  std::vector<Eigen::Vector3d> flat;
  for (const Eigen::Vector2d& p : points)
    if (p.allFinite ())
      flat.emplace_back (p.x (), p.y (), 0.0);
  const KdTree tree (flat);
  std::vector<Neighbor> pair;
  double smallest = std::numeric_limits<double>::infinity ();
  for (const Eigen::Vector3d& p : flat) {
    tree.nearest (p, 2, pair);
    if (pair.size () == 2)
      smallest = std::min (smallest, pair[1].sqr_distance);
  }
  return std::sqrt (smallest);
}

} // namespace floater
} // namespace pcl

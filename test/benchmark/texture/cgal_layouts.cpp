// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cgal_layouts.h"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/ARAP_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Mean_value_coordinates_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

namespace pcl
{
namespace floater
{
namespace
{
namespace Layout = CGAL::Surface_mesh_parameterization;
using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
} // namespace

std::vector<Eigen::Vector2d>
layOutByCgal (const std::vector<Eigen::Vector3d>& positions, const std::vector<Triangle>& triangles,
              CgalMethod method)
{
  Mesh mesh;
  std::vector<Mesh::Vertex_index> vertices (positions.size (), Mesh::null_vertex ());
  for (const Triangle& t : triangles)
    for (const Index p : t)
      if (vertices[p] == Mesh::null_vertex ())
        vertices[p] = mesh.add_vertex (
            Kernel::Point_3 (positions[p].x (), positions[p].y (), positions[p].z ()));
  for (const Triangle& t : triangles)
    mesh.add_face (vertices[t[0]], vertices[t[1]], vertices[t[2]]);
  const auto border = CGAL::Polygon_mesh_processing::longest_border (mesh).first;
  auto uv = mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_2> ("v:uv").first;
  const Layout::Error_code code =
      method == CgalMethod::MEAN_VALUE
          ? Layout::parameterize (mesh, Layout::Mean_value_coordinates_parameterizer_3<Mesh> (),
                                  border, uv)
          : Layout::parameterize (mesh, Layout::ARAP_parameterizer_3<Mesh> (), border, uv);
  if (code != Layout::OK)
    return {};
  std::vector<Eigen::Vector2d> places (positions.size (), Eigen::Vector2d::Zero ());
  for (std::size_t p = 0; p < positions.size (); ++p)
    if (vertices[p] != Mesh::null_vertex ())
      places[p] = {uv[vertices[p]].x (), uv[vertices[p]].y ()};
  return places;
}

} // namespace floater
} // namespace pcl

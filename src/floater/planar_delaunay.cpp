// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/planar_delaunay.h"

#include "core/exact.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

namespace pcl::floater {
TriangleMesh
triangulatePlane (std::vector<Vector2d> uv, const std::vector<Index>& loop)
{
  // Points that are not strictly inside of the loop are left out, except its own. Rounding may put a
  // point beyond the edge between two loop points.
  const std::size_t h = loop.size ();
  const auto direction = [] (const Vector2d& p) { return std::atan2 (p.y (), p.x ()); };
  std::vector<std::pair<double, std::size_t>> corners; // direction, index in the loop; ascending
  corners.reserve (h);
  for (std::size_t i = 0; i < h; ++i)
    corners.emplace_back (direction (uv[loop[i]]), i);
  std::sort (corners.begin (), corners.end ());
  Flags is_in_loop (uv.size (), 0);
  for (const Index p : loop)
    is_in_loop[p] = 1;
  for (Index p = 0; p < uv.size (); ++p) {
    if (is_in_loop[p] != 0 || !uv[p].allFinite ())
      continue;
    // The edges beside p's direction, and one more on each side because of rounding.
    const auto after = static_cast<std::size_t> (
        std::upper_bound (corners.begin (), corners.end (), std::make_pair (direction (uv[p]), h)) -
        corners.begin ());
    bool is_inside = true;
    for (std::size_t step = 0; step < 4; ++step) {
      const std::size_t i = corners[(after + h + step - 2) % h].second;
      is_inside = is_inside && isAntiClockwise (uv[loop[i]], uv[loop[(i + 1) % h]], uv[p]);
    }
    if (!is_inside)
      uv[p].setConstant (std::numeric_limits<double>::quiet_NaN ());
  }
  return triangulateHull (uv);
}

TriangleMesh
triangulateHull (const std::vector<Vector2d>& uv)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>;
  using FaceBase = CGAL::Triangulation_face_base_with_info_2<Index, Kernel>;
  using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
  std::vector<std::pair<Kernel::Point_2, Index>> sites;
  sites.reserve (uv.size ());
  for (Index p = 0; p < uv.size (); ++p)
    if (uv[p].allFinite ())
      sites.emplace_back (Kernel::Point_2 (uv[p].x (), uv[p].y ()), p);
  CGAL::Delaunay_triangulation_2<Kernel, Structure> delaunay (sites.begin (), sites.end ());
  TriangleMesh mesh;
  mesh.triangle_of.assign (uv.size (), NONE);
  if (delaunay.dimension () < 2)
    return mesh;
  Index count = 0;
  for (auto face = delaunay.all_faces_begin (); face != delaunay.all_faces_end (); ++face)
    face->info () = delaunay.is_infinite (face) ? NONE : count++;
  mesh.triangles.resize (count);
  mesh.neighbors.resize (count);
  for (auto face = delaunay.finite_faces_begin (); face != delaunay.finite_faces_end (); ++face) {
    const Index t = face->info ();
    for (int i = 0; i < 3; ++i) {
      const auto side = static_cast<std::size_t> (i);
      mesh.triangles[t][side] = face->vertex (i)->info ();
      mesh.neighbors[t][side] = face->neighbor (i)->info ();
      mesh.triangle_of[mesh.triangles[t][side]] = t;
    }
  }
  return mesh;
}

} // namespace pcl::floater

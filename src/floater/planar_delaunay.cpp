// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/planar_delaunay.h"

#include "core/exact.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl::floater {
namespace {
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<Index, Kernel>;
using Delaunay =
    CGAL::Delaunay_triangulation_2<Kernel,
                                   CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;

Kernel::Point_2
toPoint (const Eigen::Vector2d& place)
{
  return {place.x (), place.y ()};
}

// Marks the points that are not strictly inside of the loop, except the loop's own. Rounding may
// put a point beyond the edge between two loop points.
std::vector<std::uint8_t>
outsideLoop (const std::vector<Eigen::Vector2d>& uv, const std::vector<Index>& loop)
{
  const std::size_t h = loop.size ();
  // Points within the circle around the origin that touches the nearest edge need no test.
  double sqr_safe = std::numeric_limits<double>::infinity ();
  std::vector<std::pair<double, std::size_t>> corners; // direction, index in the loop; ascending
  for (std::size_t i = 0; i < h; ++i) {
    const Eigen::Vector2d& a = uv[loop[i]];
    const Eigen::Vector2d edge = uv[loop[(i + 1) % h]] - a;
    const double twice_area = a.x () * edge.y () - a.y () * edge.x ();
    sqr_safe =
        std::min (sqr_safe, twice_area > 0.0 ? twice_area * twice_area / edge.squaredNorm () : 0.0);
    corners.emplace_back (std::atan2 (a.y (), a.x ()), i);
  }
  std::sort (corners.begin (), corners.end ());
  std::vector<std::uint8_t> outside (uv.size (), 0);
  for (Index p = 0; p < uv.size (); ++p) {
    if (!(uv[p].squaredNorm () >= sqr_safe * (1.0 - 1e-9)))
      continue;
    // The edges beside p's direction, and one more on each side because of rounding.
    const auto after = static_cast<std::size_t> (
        std::upper_bound (corners.begin (), corners.end (),
                          std::make_pair (std::atan2 (uv[p].y (), uv[p].x ()), h)) -
        corners.begin ());
    for (std::size_t step = 0; step < 4; ++step) {
      const std::size_t i = corners[(after + h + step - 2) % h].second;
      if (!isAntiClockwise (uv[loop[i]], uv[loop[(i + 1) % h]], uv[p]))
        outside[p] = 1;
    }
  }
  for (Index p : loop)
    outside[p] = 0;
  return outside;
}

constexpr Index OUTSIDE = NONE;

// Triangulates the finite points that are not left out. Marks the infinite faces as outside.
// \return number of these points; fewer may be vertices, where some coincide
std::size_t
triangulate (const std::vector<Eigen::Vector2d>& uv, const std::vector<std::uint8_t>& is_left_out,
             Delaunay& delaunay)
{
  std::vector<std::pair<Kernel::Point_2, Index>> sites;
  sites.reserve (uv.size ());
  for (Index p = 0; p < uv.size (); ++p)
    if (uv[p].allFinite () && is_left_out[p] == 0)
      sites.emplace_back (toPoint (uv[p]), p);
  delaunay.insert (sites.begin (), sites.end ());
  for (auto face = delaunay.all_faces_begin (); face != delaunay.all_faces_end (); ++face)
    face->info () = delaunay.is_infinite (face) ? OUTSIDE : 0;
  return sites.size ();
}

// Marks the faces at hull edges that are not loop edges as outside, and so on inwards.
void
markOutside (Delaunay& delaunay, const std::vector<Index>& loop, std::size_t points)
{
  std::vector<Index> successor (points, NONE);
  for (std::size_t i = 0; i < loop.size (); ++i)
    successor[loop[i]] = loop[(i + 1) % loop.size ()];
  std::vector<Delaunay::Face_handle> outside;
  for (auto face = delaunay.all_faces_begin (); face != delaunay.all_faces_end (); ++face)
    if (face->info () == OUTSIDE)
      outside.push_back (face);
  while (!outside.empty ()) {
    const Delaunay::Face_handle face = outside.back ();
    outside.pop_back ();
    for (int i = 0; i < 3; ++i) {
      const Delaunay::Face_handle inner = face->neighbor (i);
      const Index from = face->vertex (Delaunay::cw (i))->info ();
      if (inner->info () == OUTSIDE || successor[from] == face->vertex (Delaunay::ccw (i))->info ())
        continue;
      inner->info () = OUTSIDE;
      outside.push_back (inner);
    }
  }
}

// Makes a mesh of the faces that are not outside.
TriangleMesh
makeMesh (Delaunay& delaunay, std::size_t points)
{
  TriangleMesh mesh;
  mesh.triangle_of.assign (points, NONE);
  if (delaunay.dimension () < 2)
    return mesh;
  Index count = 0;
  for (auto face = delaunay.finite_faces_begin (); face != delaunay.finite_faces_end (); ++face)
    if (face->info () != OUTSIDE)
      face->info () = count++;
  mesh.triangles.resize (count);
  mesh.neighbors.resize (count);
  for (auto face = delaunay.finite_faces_begin (); face != delaunay.finite_faces_end (); ++face) {
    const Index t = face->info ();
    if (t == OUTSIDE)
      continue;
    for (int i = 0; i < 3; ++i) {
      const auto side = static_cast<std::size_t> (i);
      mesh.triangles[t][side] = face->vertex (i)->info ();
      mesh.neighbors[t][side] = face->neighbor (i)->info ();
      mesh.triangle_of[mesh.triangles[t][side]] = t;
    }
  }
  return mesh;
}

} // namespace

TriangleMesh
triangulatePlane (const std::vector<Eigen::Vector2d>& uv, const std::vector<Index>& loop)
{
  Delaunay delaunay;
  const std::size_t sites = triangulate (uv, outsideLoop (uv, loop), delaunay);
  // Of coinciding points, CGAL keeps any index; a loop point must be the vertex.
  if (delaunay.number_of_vertices () < sites)
    for (Index p : loop) {
      Delaunay::Locate_type type{};
      int side = 0;
      const auto face = delaunay.locate (toPoint (uv[p]), type, side);
      if (type == Delaunay::VERTEX)
        face->vertex (side)->info () = p;
    }
  if (delaunay.dimension () == 2)
    markOutside (delaunay, loop, uv.size ());
  return makeMesh (delaunay, uv.size ());
}

TriangleMesh
triangulateHull (const std::vector<Eigen::Vector2d>& uv)
{
  Delaunay delaunay;
  triangulate (uv, std::vector<std::uint8_t> (uv.size (), 0), delaunay);
  return makeMesh (delaunay, uv.size ());
}

} // namespace pcl::floater

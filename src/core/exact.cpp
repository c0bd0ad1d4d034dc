// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exact.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/convex_hull_2.h>
#include <CGAL/intersections.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

namespace pcl::floater {
namespace {
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SpaceVertex = CGAL::Triangulation_vertex_base_with_info_3<Index, Kernel>;
using SpaceCell =
    CGAL::Triangulation_cell_base_with_info_3<Index, Kernel,
                                              CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using SpaceDelaunay =
    CGAL::Delaunay_triangulation_3<Kernel,
                                   CGAL::Triangulation_data_structure_3<SpaceVertex, SpaceCell>>;

Kernel::Point_2
exactly (const Vector2d& p)
{
  return {p.x (), p.y ()};
}

Kernel::Point_3
exactly (const Vector3d& p)
{
  return {p.x (), p.y (), p.z ()};
}

Kernel::Triangle_3
exactly (const std::array<Vector3d, 3>& triangle)
{
  return {exactly (triangle[0]), exactly (triangle[1]), exactly (triangle[2])};
}

template <typename Vector>
auto
exactly (const std::vector<Vector>& points)
{
  std::vector<decltype (exactly (Vector ()))> exact;
  exact.reserve (points.size ());
  for (const Vector& p : points)
    exact.push_back (exactly (p));
  return exact;
}
} // namespace

bool
isAntiClockwise (const Vector2d& a, const Vector2d& b, const Vector2d& c)
{
  return CGAL::orientation (exactly (a), exactly (b), exactly (c)) == CGAL::LEFT_TURN;
}

std::vector<Vector2d>
convexHull (const std::vector<Vector2d>& points)
{
  const std::vector<Kernel::Point_2> exact = exactly (points);
  std::vector<Kernel::Point_2> corners;
  CGAL::convex_hull_2 (exact.begin (), exact.end (), std::back_inserter (corners));
  std::vector<Vector2d> hull;
  hull.reserve (corners.size ());
  for (const Kernel::Point_2& corner : corners)
    hull.emplace_back (corner.x (), corner.y ());
  return hull;
}

bool
isSimplePolygon (const std::vector<Vector2d>& corners)
{
  const std::vector<Kernel::Point_2> polygon = exactly (corners);
  return CGAL::is_simple_2 (polygon.begin (), polygon.end (), Kernel ());
}

bool
areCollinear (const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  return CGAL::collinear (exactly (a), exactly (b), exactly (c));
}

bool
areOnOneSide (const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d)
{
  return CGAL::coplanar (exactly (a), exactly (b), exactly (c), exactly (d)) &&
         CGAL::coplanar_orientation (exactly (a), exactly (b), exactly (c), exactly (d)) ==
             CGAL::POSITIVE;
}

bool
doMeet (const std::array<Vector3d, 3>& one, const std::array<Vector3d, 3>& other)
{
  return CGAL::do_intersect (exactly (one), exactly (other));
}

bool
doMeet (const std::array<Vector3d, 3>& triangle, const Vector3d& a, const Vector3d& b)
{
  return CGAL::do_intersect (exactly (triangle), Kernel::Segment_3 (exactly (a), exactly (b)));
}

Tetrahedra
delaunayInSpace (const Positions& points)
{
  using Point = Kernel::Point_3;
  std::vector<Point> places = exactly (points);
  std::vector<std::size_t> order (points.size ());
  std::iota (order.begin (), order.end (), std::size_t{0});
  using PlaceOf = CGAL::Pointer_property_map<Point>::type;
  CGAL::spatial_sort<CGAL::Sequential_tag> (
      order.begin (), order.end (),
      CGAL::Spatial_sort_traits_adapter_3<Kernel, PlaceOf> (CGAL::make_property_map (places)));
  SpaceDelaunay delaunay;
  Tetrahedra made;
  SpaceDelaunay::Vertex_handle last;
  for (const std::size_t p : order) {
    last = delaunay.insert (places[p], last);
    last->info () = static_cast<Index> (p);
    if (delaunay.tds ().number_of_cells () > FEW_TETRAHEDRA + MOST_TETRAHEDRA * points.size ())
      return made;
  }
  if (delaunay.dimension () < 3)
    return made;
  delaunay.infinite_vertex ()->info () = NONE;
  Index count = 0;
  for (auto cell = delaunay.all_cells_begin (); cell != delaunay.all_cells_end (); ++cell)
    cell->info () = count++;
  made.corners.reserve (count);
  made.neighbors.reserve (count);
  for (auto cell = delaunay.all_cells_begin (); cell != delaunay.all_cells_end (); ++cell) {
    std::array<Index, 4> corners{}, neighbors{};
    for (int k = 0; k < 4; ++k) {
      corners[static_cast<unsigned> (k)] = cell->vertex (k)->info ();
      neighbors[static_cast<unsigned> (k)] = cell->neighbor (k)->info ();
    }
    made.corners.push_back (corners);
    made.neighbors.push_back (neighbors);
  }
  made.around = makeCsrLists (points.size (), [&] (const auto& emit) {
    for (Index t = 0; t < made.size (); ++t)
      for (const Index corner : made.corners[t])
        if (corner != NONE)
          emit (corner, t);
  });
  return made;
}

} // namespace pcl::floater

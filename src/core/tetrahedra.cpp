// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/tetrahedra.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/spatial_sort.h>

#include <numeric>

namespace pcl::floater {
namespace {
using SpaceKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SpaceVertex = CGAL::Triangulation_vertex_base_with_info_3<Index, SpaceKernel>;
using SpaceCell = CGAL::Triangulation_cell_base_with_info_3<
    Index, SpaceKernel, CGAL::Delaunay_triangulation_cell_base_3<SpaceKernel>>;
using SpaceDelaunay =
    CGAL::Delaunay_triangulation_3<SpaceKernel,
                                   CGAL::Triangulation_data_structure_3<SpaceVertex, SpaceCell>>;
} // namespace

Tetrahedra
delaunayInSpace (const std::vector<Eigen::Vector3d>& points)
{
  using Point = SpaceKernel::Point_3;
  std::vector<Point> places;
  places.reserve (points.size ());
  for (const Eigen::Vector3d& p : points)
    places.emplace_back (p.x (), p.y (), p.z ());
  std::vector<std::size_t> order (points.size ());
  std::iota (order.begin (), order.end (), std::size_t{0});
  using PlaceOf = CGAL::Pointer_property_map<Point>::type;
  CGAL::spatial_sort<CGAL::Sequential_tag> (
      order.begin (), order.end (),
      CGAL::Spatial_sort_traits_adapter_3<SpaceKernel, PlaceOf> (CGAL::make_property_map (places)));
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

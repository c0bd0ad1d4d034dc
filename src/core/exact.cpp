// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exact.h"

#include <CGAL/Convex_hull_traits_adapter_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/convex_hull_2.h>
#include <CGAL/intersections.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <iterator>
#include <numeric>

namespace pcl::floater {
namespace {
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_2
exactly (const Eigen::Vector2d& p)
{
  return {p.x (), p.y ()};
}

Kernel::Point_3
exactly (const Eigen::Vector3d& p)
{
  return {p.x (), p.y (), p.z ()};
}

Kernel::Triangle_3
exactly (const std::array<Eigen::Vector3d, 3>& triangle)
{
  return {exactly (triangle[0]), exactly (triangle[1]), exactly (triangle[2])};
}

std::vector<Kernel::Point_2>
exactly (const std::vector<Eigen::Vector2d>& points)
{
  std::vector<Kernel::Point_2> exact;
  exact.reserve (points.size ());
  for (const Eigen::Vector2d& p : points)
    exact.push_back (exactly (p));
  return exact;
}
} // namespace

bool
isAntiClockwise (const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
{
  return CGAL::orientation (exactly (a), exactly (b), exactly (c)) == CGAL::LEFT_TURN;
}

std::vector<std::size_t>
convexHull (const std::vector<Eigen::Vector2d>& points)
{
  const std::vector<Kernel::Point_2> exact = exactly (points);
  std::vector<std::size_t> places (points.size ());
  std::iota (places.begin (), places.end (), std::size_t{0});
  std::stable_sort (places.begin (), places.end (),
                    [&exact] (std::size_t a, std::size_t b) { return exact[a] < exact[b]; });
  places.erase (
      std::unique (places.begin (), places.end (),
                   [&exact] (std::size_t a, std::size_t b) { return exact[a] == exact[b]; }),
      places.end ());
  std::vector<std::size_t> hull;
  auto map = CGAL::make_property_map (exact);
  CGAL::convex_hull_2 (places.begin (), places.end (), std::back_inserter (hull),
                       CGAL::Convex_hull_traits_adapter_2<Kernel, decltype (map)> (map));
  return hull;
}

bool
isSimplePolygon (const std::vector<Eigen::Vector2d>& corners)
{
  const std::vector<Kernel::Point_2> polygon = exactly (corners);
  return CGAL::is_simple_2 (polygon.begin (), polygon.end (), Kernel ());
}

bool
areCollinear (const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  return CGAL::collinear (exactly (a), exactly (b), exactly (c));
}

bool
areOnOneSide (const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
              const Eigen::Vector3d& d)
{
  return CGAL::coplanar (exactly (a), exactly (b), exactly (c), exactly (d)) &&
         CGAL::coplanar_orientation (exactly (a), exactly (b), exactly (c), exactly (d)) ==
             CGAL::POSITIVE;
}

bool
doMeet (const std::array<Eigen::Vector3d, 3>& one, const std::array<Eigen::Vector3d, 3>& other)
{
  return CGAL::do_intersect (exactly (one), exactly (other));
}

bool
doMeet (const std::array<Eigen::Vector3d, 3>& triangle, const Eigen::Vector3d& a,
        const Eigen::Vector3d& b)
{
  return CGAL::do_intersect (exactly (triangle), Kernel::Segment_3 (exactly (a), exactly (b)));
}

} // namespace pcl::floater

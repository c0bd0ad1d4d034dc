// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/planar_star.h"

#include "samples.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::PI;
using Neighbors = std::vector<PlanarNeighbor>;

struct Star
{
  std::vector<Index> points;
  bool open = false;
  double opening_angle = 0.0;
};

Star
make (Neighbors neighbors)
{
  PlanarStar planar_star;
  Star star;
  star.open = planar_star.make (neighbors);
  for (const PlanarNeighbor& neighbor : neighbors)
    star.points.push_back (neighbor.point);
  star.opening_angle = planar_star.openingAngle ();
  return star;
}

Neighbors
at (const std::vector<Eigen::Vector2d>& places)
{
  Neighbors neighbors;
  for (const Eigen::Vector2d& place : places)
    neighbors.push_back ({place, static_cast<Index> (neighbors.size ())});
  return neighbors;
}

// The star by CGAL, anti-clockwise; an open star begins after its gap.
Star
byCgal (const Neighbors& neighbors)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Base = CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>;
  using Delaunay =
      CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Base>>;
  Delaunay delaunay;
  const auto centre = delaunay.insert (Kernel::Point_2 (0, 0));
  for (const PlanarNeighbor& neighbor : neighbors)
    delaunay.insert (Kernel::Point_2 (neighbor.offset.x (), neighbor.offset.y ()))->info () =
        neighbor.point;
  auto around = delaunay.incident_vertices (centre);
  const auto start = around;
  Star star;
  do
    if (delaunay.is_infinite (around)) {
      star.open = true;
      break;
    }
  while (++around != start);
  const auto first = around;
  do
    if (!delaunay.is_infinite (around))
      star.points.push_back (around->info ());
  while (++around != first);
  return star;
}

double
openingAngleByBruteForce (const Neighbors& neighbors)
{
  std::vector<double> angles;
  for (const PlanarNeighbor& neighbor : neighbors)
    angles.push_back (std::atan2 (neighbor.offset.y (), neighbor.offset.x ()));
  std::sort (angles.begin (), angles.end ());
  double widest = angles.front () + 2.0 * PI - angles.back ();
  for (std::size_t i = 1; i < angles.size (); ++i)
    widest = std::max (widest, angles[i] - angles[i - 1]);
  return widest;
}

void
rotateToSmallest (std::vector<Index>& cycle)
{
  std::rotate (cycle.begin (), std::min_element (cycle.begin (), cycle.end ()), cycle.end ());
}

// \return 1 if the star is open
std::size_t
expectDelaunay (const Neighbors& neighbors)
{
  Star star = make (neighbors);
  Star expected = byCgal (neighbors);
  EXPECT_EQ (star.open, expected.open);
  EXPECT_NEAR (star.opening_angle, openingAngleByBruteForce (neighbors), 1e-7);
  if (!star.open) { // a closed star may begin anywhere
    rotateToSmallest (star.points);
    rotateToSmallest (expected.points);
  }
  EXPECT_EQ (star.points, expected.points);
  return star.open ? 1 : 0;
}

TEST (PlanarStar, RandomNeighborhoodsAreDelaunay)
{
  RandomStream random (1);
  std::size_t open = 0;
  for (int sample = 0; sample < 12000 && !HasFailure (); ++sample) {
    Neighbors neighbors (3 + random.below (25));
    for (Index i = 0; i < neighbors.size (); ++i)
      neighbors[i] = {{random.normal (), random.normal ()}, i};
    open += expectDelaunay (neighbors);
  }
  EXPECT_GT (open, 500U);
}

TEST (PlanarStar, NeighborhoodsAtABorderAreDelaunay)
{
  RandomStream random (2);
  std::size_t open = 0;
  for (int sample = 0; sample < 8000 && !HasFailure (); ++sample) {
    const double turn = 2.0 * PI * random.uniform ();
    const double width = 1.2 * PI * random.uniform ();
    Neighbors neighbors (3 + random.below (20));
    for (Index i = 0; i < neighbors.size (); ++i) {
      const double angle = turn + width * random.uniform ();
      const double length = 0.1 + random.uniform ();
      neighbors[i] = {{length * std::cos (angle), length * std::sin (angle)}, i};
    }
    open += expectDelaunay (neighbors);
  }
  EXPECT_GT (open, 5000U);
}

// On a grid the corners of each cell lie on one circle, but for rounding after it was turned,
// stretched and moved.
TEST (PlanarStar, GridPointsAreSurroundedByTheirDirectNeighbors)
{
  RandomStream random (4);
  for (int sample = 0; sample < 2000; ++sample) {
    const double angle = sample % 2 == 0 ? 0.0 : 2.0 * PI * random.uniform ();
    const double stretch = sample < 1000 ? 1.0 : 0.8 + 0.4 * random.uniform ();
    const Eigen::Rotation2Dd turn (angle);
    Neighbors neighbors;
    std::set<Index> direct;
    for (int x = -2; x <= 2; ++x)
      for (int y = -2; y <= 2; ++y) {
        if (x == 0 && y == 0)
          continue;
        if (std::abs (x) + std::abs (y) == 1)
          direct.insert (static_cast<Index> (neighbors.size ()));
        const Eigen::Vector2d far_away (1000.0, -700.0);
        const Eigen::Vector2d place = turn * Eigen::Vector2d (stretch * x, y);
        neighbors.push_back (
            {(place + far_away) - far_away, static_cast<Index> (neighbors.size ())});
      }
    const Star star = make (neighbors);
    ASSERT_FALSE (star.open);
    const std::set<Index> found (star.points.begin (), star.points.end ());
    ASSERT_EQ (found.size (), star.points.size ());
    ASSERT_TRUE (std::includes (found.begin (), found.end (), direct.begin (), direct.end ()))
        << "angle " << angle << ", stretch " << stretch;
    ASSERT_LE (star.points.size (), 8U);
    ASSERT_NEAR (star.opening_angle, openingAngleByBruteForce (neighbors), 1e-6);
  }
}

TEST (PlanarStar, OfNeighborsInOneDirectionTheNearestCounts)
{
  const Star star = make (at ({{3, 0}, {1, 0}, {2, 0}, {0, 2}, {0, 1}, {-1, -1}, {-5, -5}}));
  EXPECT_FALSE (star.open);
  std::vector<Index> points = star.points;
  rotateToSmallest (points);
  EXPECT_EQ (points, (std::vector<Index>{1, 4, 5}));
  // One direction, but for rounding, at the ray where sorting by angle begins.
  const Star across = make (at ({{2, 1e-13}, {1, -1e-14}, {3, -1e-13}, {-1, 1}, {-1, -1}}));
  EXPECT_FALSE (across.open);
  points = across.points;
  rotateToSmallest (points);
  EXPECT_EQ (points, (std::vector<Index>{1, 3, 4}));
}

TEST (PlanarStar, AHalfPlaneIsOpen)
{
  const Star above = make (at ({{1, 0}, {0, 1}, {-1, 0}, {2, 1}, {-1, 2}}));
  EXPECT_TRUE (above.open);
  EXPECT_NEAR (above.opening_angle, PI, 1e-7);
  EXPECT_EQ (above.points.front (), 0U);
  EXPECT_EQ (above.points.back (), 2U);
  // A little more or less than half a turn, by rounding.
  for (const double tilt : {1e-15, -1e-15})
    EXPECT_TRUE (make (at ({{1, tilt}, {0, 1}, {-1, 0}})).open);
  // Clearly less.
  EXPECT_FALSE (make (at ({{1, -1e-3}, {0, 1}, {-1, -1e-3}})).open);
  EXPECT_TRUE (make (at ({{1, 1e-3}, {0, 1}, {-1, 1e-3}})).open);
}

TEST (PlanarStar, AllNeighborsOnOneLine)
{
  const Star both_sides = make (at ({{-1, -2}, {1, 2}, {2, 4}, {-3, -6}}));
  EXPECT_TRUE (both_sides.open);
  EXPECT_EQ (std::set<Index> (both_sides.points.begin (), both_sides.points.end ()),
             (std::set<Index>{0, 1}));
  EXPECT_NEAR (both_sides.opening_angle, PI, 1e-7);
  const Star one_side = make (at ({{3, 3}, {1, 1}, {2, 2}}));
  EXPECT_TRUE (one_side.open);
  EXPECT_EQ (one_side.points, (std::vector<Index>{1}));
  EXPECT_NEAR (one_side.opening_angle, 2.0 * PI, 1e-12);
}

TEST (PlanarStar, FewNeighbors)
{
  const Star none = make ({});
  EXPECT_TRUE (none.open);
  EXPECT_TRUE (none.points.empty ());
  EXPECT_DOUBLE_EQ (none.opening_angle, 2.0 * PI);
  const Star one = make (at ({{-0.5, 2.0}}));
  EXPECT_TRUE (one.open);
  EXPECT_EQ (one.points, (std::vector<Index>{0}));
  EXPECT_NEAR (one.opening_angle, 2.0 * PI, 1e-12);
  for (const auto& order : {std::array<int, 2>{0, 1}, std::array<int, 2>{1, 0}}) {
    Neighbors two = at ({{1, 0}, {0, 1}});
    const Star corner =
        make ({two[static_cast<std::size_t> (order[0])], two[static_cast<std::size_t> (order[1])]});
    EXPECT_TRUE (corner.open);
    EXPECT_EQ (corner.points, (std::vector<Index>{0, 1}));
    EXPECT_NEAR (corner.opening_angle, 1.5 * PI, 1e-7);
  }
}

TEST (PlanarStar, AVeryCloseNeighborStays)
{
  for (const double nearby : {1e-6, 1e-10, 1e-14}) {
    const Neighbors ring = at ({{nearby, 0}, {0.1, 1}, {-1, 0.3}, {-0.2, -1}, {1, -0.1}});
    Star star = make (ring);
    EXPECT_FALSE (star.open);
    EXPECT_NE (std::find (star.points.begin (), star.points.end (), 0U), star.points.end ())
        << nearby;
    EXPECT_GE (star.points.size (), 3U);
    const Star open = make (at ({{0, nearby}, {1, 0.1}, {0.2, 1}, {-1, 0.1}}));
    EXPECT_TRUE (open.open);
    EXPECT_EQ (open.points, (std::vector<Index>{1, 0, 3})) << nearby;
  }
}

} // namespace
} // namespace pcl::floater

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

// A closed star may begin anywhere: then from its smallest point on.
std::vector<Index>
pointsOf (Star star)
{
  if (!star.open)
    std::rotate (star.points.begin (), std::min_element (star.points.begin (), star.points.end ()),
                 star.points.end ());
  return star.points;
}

// In half of the rounds in any direction, in half of them in a sector of up to 216 degrees.
TEST (PlanarStar, IsDelaunay)
{
  RandomStream random (1);
  std::size_t open = 0;
  constexpr int ROUNDS = 20000;
  for (int round = 0; round < ROUNDS && !HasFailure (); ++round) {
    const double turn = 2.0 * PI * random.uniform ();
    const double width = (round % 2 == 0 ? 2.0 : 1.2 * random.uniform ()) * PI;
    Neighbors neighbors (3 + random.below (25));
    for (Index i = 0; i < neighbors.size (); ++i) {
      const double angle = turn + width * random.uniform ();
      const double length = 0.1 + random.uniform ();
      neighbors[i] = {{length * std::cos (angle), length * std::sin (angle)}, i};
    }
    const Star star = make (neighbors), expected = byCgal (neighbors);
    EXPECT_EQ (star.open, expected.open);
    EXPECT_NEAR (star.opening_angle, openingAngleByBruteForce (neighbors), 1e-7);
    EXPECT_EQ (pointsOf (star), pointsOf (expected));
    open += star.open ? 1 : 0;
  }
  EXPECT_GT (open, ROUNDS / 4U);
  EXPECT_LT (open, ROUNDS * 3U / 4U);
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

struct SmallStar
{
  std::vector<Eigen::Vector2d> neighbors;
  std::vector<Index> star;
  bool is_open;
  double opening_angle = 0.0; ///< 0: not checked
};

TEST (PlanarStar, OfFewNeighborsOnLinesAndInHalfPlanes)
{
  const double half = PI, whole = 2.0 * PI;
  std::vector<SmallStar> cases{
      // Of neighbours in one direction the nearest counts; in the second row it is one direction but
      // for rounding, at the ray where sorting by angle begins.
      {{{3, 0}, {1, 0}, {2, 0}, {0, 2}, {0, 1}, {-1, -1}, {-5, -5}}, {1, 4, 5}, false},
      {{{2, 1e-13}, {1, -1e-14}, {3, -1e-13}, {-1, 1}, {-1, -1}}, {1, 3, 4}, false},
      // Half a plane; a little more or less than half by rounding; clearly less and more.
      {{{1, 0}, {0, 1}, {-1, 0}, {2, 1}, {-1, 2}}, {0, 1, 2}, true, half},
      {{{1, 1e-15}, {0, 1}, {-1, 0}}, {0, 1, 2}, true, half},
      {{{1, -1e-15}, {0, 1}, {-1, 0}}, {0, 1, 2}, true, half},
      {{{1, -1e-3}, {0, 1}, {-1, -1e-3}}, {0, 1, 2}, false},
      {{{1, 1e-3}, {0, 1}, {-1, 1e-3}}, {0, 1, 2}, true},
      // One line, on one side only; few.
      {{{3, 3}, {1, 1}, {2, 2}}, {1}, true, whole},
      {{}, {}, true, whole},
      {{{-0.5, 2.0}}, {0}, true, whole},
      {{{1, 0}, {0, 1}}, {0, 1}, true, 1.5 * PI},
      {{{0, 1}, {1, 0}}, {1, 0}, true, 1.5 * PI}};
  for (const double nearby : {1e-6, 1e-10, 1e-14}) // a very close neighbour stays
    cases.push_back ({{{0, nearby}, {1, 0.1}, {0.2, 1}, {-1, 0.1}}, {1, 0, 3}, true});
  for (std::size_t i = 0; i < cases.size (); ++i) {
    SCOPED_TRACE (i);
    const Star star = make (at (cases[i].neighbors));
    EXPECT_EQ (star.open, cases[i].is_open);
    EXPECT_EQ (pointsOf (star), cases[i].star);
    if (cases[i].opening_angle != 0.0) {
      EXPECT_NEAR (star.opening_angle, cases[i].opening_angle, 1e-7);
    }
  }
  const Star both_sides = make (at ({{-1, -2}, {1, 2}, {2, 4}, {-3, -6}}));
  EXPECT_TRUE (both_sides.open);
  EXPECT_EQ (std::set<Index> (both_sides.points.begin (), both_sides.points.end ()),
             (std::set<Index>{0, 1}));
  EXPECT_NEAR (both_sides.opening_angle, half, 1e-7);
  for (const double nearby : {1e-6, 1e-10, 1e-14}) {
    const Star star = make (at ({{nearby, 0}, {0.1, 1}, {-1, 0.3}, {-0.2, -1}, {1, -0.1}}));
    EXPECT_FALSE (star.open);
    EXPECT_EQ (pointsOf (star).front (), 0U) << nearby;
    EXPECT_GE (star.points.size (), 3U);
  }
}

TEST (PlanarStarOfAll, GoesRoundAndBeginsAfterTheGap)
{
  RandomStream random (5);
  for (int round = 0; round < 200; ++round) {
    // Directions of a grid, several in one; in half of the rounds on one side only.
    Neighbors neighbors;
    for (Index i = 0; i < 30; ++i) {
      const double x = static_cast<double> (random.below (7)) - 3.0;
      const double y = static_cast<double> (random.below (7)) - 3.0;
      if ((x != 0.0 || y != 0.0) && (round % 2 == 0 || y > 0.0))
        neighbors.push_back ({{x, y}, i});
    }
    const std::size_t count = neighbors.size ();
    ASSERT_GE (count, 5U);
    PlanarStar star;
    Neighbors delaunay = neighbors;
    const bool open = star.order (neighbors);
    EXPECT_EQ (neighbors.size (), count);
    const double widest = star.openingAngle ();
    EXPECT_EQ (open, star.make (delaunay));
    EXPECT_EQ (widest, star.openingAngle ());
    EXPECT_TRUE (open || round % 2 == 0);
    double turn = 0.0;
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const Eigen::Vector2d &a = neighbors[i].offset, &b = neighbors[i + 1].offset;
      const double angle = std::atan2 (a.x () * b.y () - a.y () * b.x (), a.dot (b));
      EXPECT_GE (angle, 0.0);
      turn += angle;
    }
    EXPECT_LT (turn, 6.3);
    if (open) {
      EXPECT_NEAR (turn + widest, 2.0 * PI, 1e-12);
    }
  }
}

} // namespace
} // namespace pcl::floater

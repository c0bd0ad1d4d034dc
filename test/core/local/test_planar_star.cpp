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

} // namespace
} // namespace pcl::floater

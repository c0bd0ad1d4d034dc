// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Tangent planes, stars in them, and the spacing of the sampling; planar stars against CGAL.
#include "local/stars.h"

#include "local/planar_star.h"
#include "points/neighbors.h"
#include "surface_samples.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;

void
expectSane (const Neighborhoods& made)
{
  const Positions& positions = made.points.positions;
  const Stars& stars = made.geometry.stars;
  ASSERT_EQ (stars.neighbors.rows (), positions.size ());
  ASSERT_EQ (stars.open.size (), positions.size ());
  ASSERT_EQ (stars.normals.size (), positions.size ());
  ASSERT_EQ (stars.offsets_in_plane.size (), stars.neighbors.ids.size ());
  for (Index p = 0; p < positions.size (); ++p) {
    EXPECT_NEAR (stars.normals[p].norm (), 1.0F, 1e-5F);
    const Row star = stars.neighbors.row (p), around = made.geometry.neighbors.row (p);
    const Eigen::Vector2d* offsets = stars.offsets_in_plane.data () + stars.neighbors.offsets[p];
    EXPECT_EQ (std::set<Index> (star.begin (), star.end ()).size (), star.size ());
    double turned = 0.0;
    for (std::size_t i = 0; i < star.size (); ++i) {
      EXPECT_NE (star[i], p);
      EXPECT_NE (std::find (around.begin (), around.end (), star[i]), around.end ());
      EXPECT_NEAR (offsets[i].norm (), (positions[star[i]] - positions[p]).norm (), 1e-12);
      const Eigen::Vector2d& next = offsets[(i + 1) % star.size ()];
      const double turn = std::atan2 (cross (offsets[i], next), offsets[i].dot (next));
      turned += turn < 0.0 ? turn + 2.0 * PI : turn;
    }
    EXPECT_TRUE (stars.open[p] != 0 || star.size () >= 3);
    if (star.size () > 1) {
      EXPECT_NEAR (turned, 2.0 * PI, 1e-6); // once around, anti-clockwise
    }
  }
}

TEST (TangentPlanes, OfANoisyPlane)
{
  Positions plane = disc (0.05, 1).positions;
  RandomStream random (2);
  const Eigen::Vector3d normal = Eigen::Vector3d (1, -2, 4).normalized ();
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond::FromTwoVectors (Eigen::Vector3d::UnitZ (), normal);
  for (Eigen::Vector3d& p : plane) {
    p.z () = 0.05 * 0.05 * random.normal (); // a twentieth of the spacing
    p = turn * p;
  }
  const Neighborhoods made = makeNeighborhoods (plane);
  expectSane (made);
  double sum = 0.0;
  for (const Eigen::Vector3f& n : made.geometry.stars.normals) {
    const double cosine = std::abs (n.cast<double> ().dot (normal));
    EXPECT_GT (cosine, std::cos (0.15));
    sum += std::acos (std::min (1.0, cosine));
  }
  EXPECT_LT (sum / static_cast<double> (plane.size ()), 0.03);
}

// The filter leaves a single sheet alone.
TEST (Stars, OpenAtTheBorderOnly)
{
  const Sheet sheet = disc (0.05, 4);
  const Neighborhoods made = makeNeighborhoods (sheet.positions);
  expectSane (made);
  for (std::size_t p = 0; p < made.points.positions.size (); ++p) {
    const bool border = made.points.cloud_index[p] < sheet.border;
    EXPECT_EQ (made.geometry.stars.open[p] != 0, border);
  }
  const Stars& filtered = made.geometry.stars;
  const Stars plain = makeNeighborhoods (sheet.positions, false).geometry.stars;
  EXPECT_EQ (filtered.neighbors.offsets, plain.neighbors.offsets);
  EXPECT_EQ (filtered.neighbors.ids, plain.neighbors.ids);
  EXPECT_EQ (filtered.open, plain.open);
}

TEST (Stars, TheFilterKeepsSheetsApart)
{
  // Share of star neighbours on the other one of parallel sheets; of points 2.5 spacings inside their sheet, so that
  // they have neighbours on all sides.
  const auto shareOfStrays = [] (double gap, bool with_filter) {
    const auto [points, geometry] =
        makeNeighborhoods (parallelSheets (gap, 10).points, with_filter);
    expectSane ({points, geometry});
    double strays = 0.0, all = 0.0;
    for (Index p = 0; p < points.size (); ++p) {
      const Eigen::Vector3d place = points.inCloud (p);
      if ((place.head<2> ().array () - 18.2).abs ().maxCoeff () > 15.2)
        continue;
      for (const Index q : geometry.stars.neighbors.row (p)) {
        all += 1.0;
        strays += std::abs (place.z () - points.inCloud (q).z ()) > 0.5 * gap ? 1.0 : 0.0;
      }
    }
    return strays / all;
  };
  for (const double gap : {2.0, 1.7})
    EXPECT_EQ (shareOfStrays (gap, true), 0.0);
  // At 2 spacings it is enough that offsets keep their length; nearer sheets need the filter.
  EXPECT_GT (shareOfStrays (1.7, false), 0.002);
}

// On lines ten times as far apart as their points.
TEST (TangentPlanes, RowsOfSinglePointsAreThoseOfAll)
{
  Positions lines;
  for (int i = 0; i < 3000; ++i)
    lines.emplace_back (i % 100, 10.0 * (i / 100),
                        std::sin (0.1 * i)); // NOLINT (bugprone-integer-division)
  const Points points = workingPoints (lines);
  StarSettings settings;
  settings.reach_beyond = true;
  const LocalPlanes begun = beginPlanes (points, findNeighbors (points, {}, 1), {}, settings, 1);
  const LocalPlanes fitted = fitLocalPlanes (points, begun, settings, 1);
  const RowOf row_of = rowsBeside (points, begun);
  EXPECT_GT (fitted.neighbors.ids.size (), begun.neighbors.ids.size () + points.size ());
  for (Index p = static_cast<Index> (points.size ()); p-- > 0;) { // in another order
    const Row own = row_of (p), all = fitted.neighbors.row (p);
    ASSERT_TRUE (std::equal (own.begin (), own.end (), all.begin (), all.end ())) << p;
  }
}

TEST (LocalSpacing, IsTheMeanOfTheSixNearest)
{
  Positions grid;
  for (int i = 0; i < 400; ++i)
    grid.emplace_back (i % 20, i / 20, 0); // NOLINT (bugprone-integer-division)
  const Neighborhoods made = makeNeighborhoods (grid);
  const double inner = (4.0 + 2.0 * std::sqrt (2.0)) / 6.0;
  for (std::size_t p = 0; p < grid.size (); ++p) {
    const Eigen::Vector2d place = grid[made.points.cloud_index[p]].head<2> ();
    const double spacing = made.points.scale * static_cast<double> (made.geometry.spacing[p]);
    if (place.minCoeff () > 0.0 && place.maxCoeff () < 19.0) {
      EXPECT_NEAR (spacing, inner, 1e-5);
    }
    else {
      EXPECT_GT (spacing, 1.1 * inner);
    }
  }
  EXPECT_NEAR (makeNeighborhoods ({{0, 0, 0}, {1, 0, 0}}).geometry.spacing[0], 1.0, 1e-6);
  EXPECT_EQ (makeNeighborhoods ({{0, 0, 0}}).geometry.spacing[0], 0.0F);
}

TEST (LocalGeometry, CopiesRowsOfSomePoints)
{
  RandomStream random (7);
  const LocalGeometry from = makeNeighborhoods (jitteredGrid (12, 12, 1.0, 0.4, random)).geometry;
  const LocalGeometry before = makeNeighborhoods (jitteredGrid (12, 12, 1.0, 0.1, random)).geometry;
  LocalGeometry to = before;
  const std::vector<Index> copied{0, 50, 51, 143};
  copyRows (from, copied, to);
  const auto list = [] (const Row row) { return std::vector<Index> (row.begin (), row.end ()); };
  for (Index p = 0; p < 144; ++p) {
    SCOPED_TRACE (p);
    const bool is_copied = std::binary_search (copied.begin (), copied.end (), p);
    const LocalGeometry& source = is_copied ? from : before;
    EXPECT_EQ (list (to.neighbors.row (p)), list (source.neighbors.row (p)));
    EXPECT_EQ (list (to.stars.neighbors.row (p)), list (source.stars.neighbors.row (p)));
    EXPECT_EQ (to.spacing[p], source.spacing[p]);
    EXPECT_EQ (to.stars.open[p], source.stars.open[p]);
    EXPECT_EQ (to.stars.normals[p], source.stars.normals[p]);
    const Index first = to.stars.neighbors.offsets[p];
    for (std::size_t i = 0; i < to.stars.neighbors.row (p).size (); ++i)
      EXPECT_EQ (to.stars.offsets_in_plane[first + i],
                 source.stars.offsets_in_plane[source.stars.neighbors.offsets[p] + i]);
  }
}

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
    std::vector<double> angles;
    for (Index i = 0; i < neighbors.size (); ++i) {
      const double angle = turn + width * random.uniform ();
      const double length = 0.1 + random.uniform ();
      neighbors[i] = {{length * std::cos (angle), length * std::sin (angle)}, i};
      angles.push_back (std::atan2 (neighbors[i].offset.y (), neighbors[i].offset.x ()));
    }
    const Star star = make (neighbors), expected = byCgal (neighbors);
    EXPECT_EQ (star.open, expected.open);
    EXPECT_NEAR (star.opening_angle, widestGap (angles), 1e-7);
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
  const auto starOf = [] (const std::vector<Eigen::Vector2d>& places) {
    Neighbors neighbors;
    for (const Eigen::Vector2d& place : places)
      neighbors.push_back ({place, static_cast<Index> (neighbors.size ())});
    return make (neighbors);
  };
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
    const Star star = starOf (cases[i].neighbors);
    EXPECT_EQ (star.open, cases[i].is_open);
    EXPECT_EQ (pointsOf (star), cases[i].star);
    if (cases[i].opening_angle != 0.0) {
      EXPECT_NEAR (star.opening_angle, cases[i].opening_angle, 1e-7);
    }
  }
  const Star both_sides = starOf ({{-1, -2}, {1, 2}, {2, 4}, {-3, -6}});
  EXPECT_TRUE (both_sides.open);
  EXPECT_EQ (std::set<Index> (both_sides.points.begin (), both_sides.points.end ()),
             (std::set<Index>{0, 1}));
  EXPECT_NEAR (both_sides.opening_angle, half, 1e-7);
  for (const double nearby : {1e-6, 1e-10, 1e-14}) {
    const Star star = starOf ({{nearby, 0}, {0.1, 1}, {-1, 0.3}, {-0.2, -1}, {1, -0.1}});
    EXPECT_FALSE (star.open);
    EXPECT_EQ (pointsOf (star).front (), 0U) << nearby;
    EXPECT_GE (star.points.size (), 3U);
  }
}

} // namespace
} // namespace pcl::floater

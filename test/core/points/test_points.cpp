// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The working set of points, and coordinates that are coarse.
#include "points/points.h"

#include "points/coordinate_grid.h"
#include "samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;
using IndexPairs = std::vector<std::array<Index, 2>>;

constexpr double INF = std::numeric_limits<double>::infinity ();
constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN ();

// What the stages rely on: every input is exactly one of a point, a duplicate of a point, or not
// finite. Points are finite and distinct, in a box of diagonal 1 around the origin, and lead back to
// the cloud.
void
expectWorkable (const Points& points, const Positions& cloud)
{
  std::vector<Index> all = points.cloud_index;
  all.insert (all.end (), points.non_finite.begin (), points.non_finite.end ());
  for (const auto& duplicate : points.duplicates) {
    all.push_back (duplicate[0]);
    EXPECT_LT (duplicate[1], duplicate[0]);
    EXPECT_NE (std::find (points.cloud_index.begin (), points.cloud_index.end (), duplicate[1]),
               points.cloud_index.end ());
  }
  std::sort (all.begin (), all.end ());
  EXPECT_EQ (all, indices (cloud.size ()));
  EXPECT_TRUE (std::is_sorted (points.duplicates.begin (), points.duplicates.end ()));
  EXPECT_GT (points.scale, 0.0);
  Eigen::AlignedBox3d box;
  std::set<std::array<double, 3>> distinct;
  ASSERT_EQ (points.positions.size (), points.cloud_index.size ());
  for (Index p = 0; p < points.size (); ++p) {
    const Eigen::Vector3d& position = points.positions[p];
    ASSERT_TRUE (position.allFinite ());
    box.extend (position);
    EXPECT_TRUE (distinct.insert ({position.x (), position.y (), position.z ()}).second);
    EXPECT_LE ((points.inCloud (p) - cloud[points.cloud_index[p]]).norm (), 1e-13 * points.scale);
  }
  if (points.size () > 1) {
    EXPECT_NEAR (box.diagonal ().norm (), 1.0, 1e-12);
    EXPECT_LT (box.center ().norm (), 1e-12);
  }
}

TEST (Points, AreTheDistinctFiniteOnes)
{
  const Positions random = randomPoints (100, 4);
  Positions copies = random, not_finite = random;
  for (const std::size_t i : {50U, 7U, 7U, 99U})
    copies.push_back (random[i]);
  for (const double bad : {NOT_A_NUMBER, INF, -INF})
    for (int axis = 0; axis < 3; ++axis) {
      not_finite.emplace_back (0.5, 0.5, 0.5);
      not_finite.back ()[axis] = bad;
    }
  IndexPairs all_of_the_first;
  for (Index i = 1; i < 50; ++i)
    all_of_the_first.push_back ({i, 0});
  struct Case
  {
    Positions cloud;
    IndexPairs duplicates;
    std::vector<Index> non_finite;
  };
  const std::vector<Case> cases{
      {placed (randomPoints (2000, 1), {3.0, 40.0, -7.0}, 25.0), {}, {}},
      {randomPoints (70'000, 5), {}, {}}, // sorted in parts
      {copies, {{100, 50}, {101, 7}, {102, 7}, {103, 99}}, {}},
      {not_finite, {}, {100, 101, 102, 103, 104, 105, 106, 107, 108}},
      {{}, {}, {}},
      {Positions (3, Eigen::Vector3d::Constant (NOT_A_NUMBER)), {}, {0, 1, 2}},
      {Positions (50, Eigen::Vector3d (1e7, -3.25, 1e-9)), all_of_the_first, {}},
      {{{0.0, -0.0, 0.0}, {1, 1, 1}, {-0.0, 0.0, -0.0}}, {{2, 0}}, {}}};
  for (std::size_t c = 0; c < cases.size (); ++c) {
    SCOPED_TRACE (c);
    const Points points = workingPoints (cases[c].cloud);
    expectWorkable (points, cases[c].cloud);
    EXPECT_EQ (points.duplicates, cases[c].duplicates);
    EXPECT_EQ (points.non_finite, cases[c].non_finite);
  }
}

TEST (Points, CloudIndicesNeedNotAscend)
{
  const Positions cloud = {{1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {NOT_A_NUMBER, 0, 0}, {0, INF, 0}};
  const Points points = makePoints (cloud, {9, 4, 6, 8, 2}, 1);
  EXPECT_EQ (points.duplicates, (IndexPairs{{9, 6}}));
  EXPECT_EQ (points.non_finite, (std::vector<Index>{2, 8}));
  std::vector<Index> left = points.cloud_index;
  std::sort (left.begin (), left.end ());
  EXPECT_EQ (left, (std::vector<Index>{4, 6}));
}

TEST (Points, PointsThatScalingCannotTellApartAreOne)
{
  // The origin is a corner of the box, where even single precision has different values for these.
  Positions cloud = {{0, 0, 0}, {1, 1, 1}, {1, 0, 0}};
  for (int i = 1; i <= 40; ++i)
    cloud.emplace_back (1e-30 * (i % 7), 1e-25 * (i % 5), 1e-20 * i);
  const Points points = workingPoints (cloud);
  expectWorkable (points, cloud);
  EXPECT_EQ (points.positions.size (), 3U);
  // At the centre of the box they are different after scaling, but not beyond rounding.
  cloud[1] = {-1, -1, -1};
  cloud[2] = {-1, 0, 0};
  cloud.emplace_back (1, 1, 1);
  const Points around_centre = workingPoints (cloud);
  expectWorkable (around_centre, cloud);
  EXPECT_EQ (around_centre.positions.size (), 4U);
}

TEST (Points, ABoxAsSmallAsOneDigit)
{
  const double two_to_52 = 4503599627370496.0; // from here on doubles are 1 apart
  for (const double base : {two_to_52, two_to_52 + 1, -two_to_52 - 1}) {
    const Points points = workingPoints ({{base, base, base},
                                          {base + 1, base, base},
                                          {base, base + 1, base},
                                          {base + 1, base + 1, base + 1}});
    EXPECT_EQ (points.positions.size (), 4U);
    for (const Eigen::Vector3d& p : points.positions)
      EXPECT_LE (p.cwiseAbs ().maxCoeff (), 1.0);
  }
}

// Of random points in a cube, and two far away, these two and one more.
TEST (RemovePoints, KeepsTheOrderThePlacesAndTheNormals)
{
  Points points =
      workingPoints (joined (randomPoints (200, 9), {{100.0, 0.0, 0.0}, {50.0, -70.0, 0.0}}));
  std::vector<Index> rows, kept;
  for (Index p = 0; p < points.size (); ++p) {
    const Index index = points.cloud_index[p];
    (index >= 200 || index == 17 ? rows : kept).push_back (p);
    points.normals.emplace_back (static_cast<float> (index), 0.0F, 0.0F);
    points.facing_normals.push_back (-points.normals.back ());
  }
  const Points before = points;
  EXPECT_EQ (removePoints (points, rows), (std::vector<Index>{17, 200, 201}));
  for (const std::size_t size : {points.positions.size (), points.cloud_index.size (),
                                 points.normals.size (), points.facing_normals.size ()})
    ASSERT_EQ (size, 199U);
  // Scaled by a power of two, so that all distances compare as before.
  const double factor = before.scale / points.scale;
  int exponent = 0;
  EXPECT_EQ (std::frexp (factor, &exponent), 0.5);
  EXPECT_GT (factor, 16.0);
  Eigen::AlignedBox3d box;
  for (Index p = 0; p < points.size (); ++p) {
    box.extend (points.positions[p]);
    EXPECT_EQ (points.cloud_index[p], before.cloud_index[kept[p]]);
    EXPECT_EQ (points.positions[p], factor * before.positions[kept[p]]);
    EXPECT_EQ (points.inCloud (p), before.inCloud (kept[p]));
    EXPECT_EQ (points.normals[p].x (), static_cast<float> (points.cloud_index[p]));
    EXPECT_EQ (points.facing_normals[p], -points.normals[p]);
  }
  EXPECT_NEAR (points.diagonal, box.diagonal ().norm (), 1e-15);
  EXPECT_GE (points.diagonal, 0.5);
  EXPECT_LE (points.diagonal, 1.0);
}

Positions
asFloats (Positions cloud)
{
  for (Eigen::Vector3d& p : cloud)
    for (double& value : p)
      value = static_cast<double> (static_cast<float> (value)); // GCC 12 leaves out two casts of p
  return cloud;
}

CoordinateGrid
gridOf (const Positions& cloud)
{
  const Neighborhoods made = makeNeighborhoods (cloud);
  return findCoordinateGrid (made.points, made.geometry.spacing);
}

TEST (CoordinateGrid, MapCoordinatesInSinglePrecision)
{
  // With a spacing of about 1, times the scale.
  const Positions terrain = surface (SurfaceKind::HEIGHT_FIELD, 3000);
  for (const double scale : {0.3, 1.0, 3.0}) {
    const CoordinateGrid grid = gridOf (asFloats (placed (terrain, ON_A_MAP, scale)));
    EXPECT_EQ (grid.axis, 1);
    EXPECT_NEAR (grid.step, 0.5, 1e-6);
    EXPECT_GT (grid.spacings, 0.1);
    EXPECT_LT (grid.spacings, 2.0);
    EXPECT_TRUE (grid.is_single_precision);
  }
  // Fine enough for points further apart, and as doubles.
  EXPECT_EQ (gridOf (asFloats (placed (terrain, ON_A_MAP, 10.0))).step, 0.0);
  EXPECT_EQ (gridOf (placed (terrain, ON_A_MAP, 0.3)).step, 0.0);
  // Three axes with the same step, which is that of floats along all of them.
  const Eigen::Vector3d geocentric (4.2e6, 4.3e6, 5e6);
  const CoordinateGrid grid =
      gridOf (asFloats (placed (surface (SurfaceKind::TORUS, 3000), geocentric)));
  EXPECT_NEAR (grid.step, 0.5, 1e-6);
  EXPECT_TRUE (grid.is_single_precision);
}

TEST (CoordinateGrid, CoordinatesWithFewDigits)
{
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const Positions torus = placed (surface (SurfaceKind::TORUS, 3000), {0, 0, 0}, scale);
    const auto gridOfRounded = [&torus] (double step) {
      Positions cloud = torus;
      for (Eigen::Vector3d& p : cloud)
        p = step * (p / step).array ().round ().matrix ();
      return gridOf (cloud);
    };
    const CoordinateGrid grid = gridOfRounded (0.2 * scale);
    EXPECT_NEAR (grid.step / scale, 0.2, 1e-6);
    EXPECT_GT (grid.spacings, 0.1);
    EXPECT_LT (grid.spacings, 0.4);
    EXPECT_FALSE (grid.is_single_precision);
    // So coarse that many points coincide.
    EXPECT_NEAR (gridOfRounded (1.5 * scale).step / scale, 1.5, 1e-5);
    EXPECT_EQ (gridOfRounded (0.05 * scale).step, 0.0);
    EXPECT_EQ (gridOf (torus).step, 0.0);
  }
}

TEST (CoordinateGrid, ARasterIsNoFlaw)
{
  // Heights, of which some nodes are left out.
  const auto raster = [] (double step, std::size_t one_in) {
    Positions cloud;
    RandomStream random (7);
    for (int y = 0; y < 80; ++y)
      for (int x = 0; x < 80; ++x)
        if (random.below (one_in) == 0)
          cloud.emplace_back (step * x, step * y, std::sin (0.1 * x * y));
    return cloud;
  };
  for (const std::size_t one_in : {1U, 2U, 10U})
    for (const double step : {1.0, 0.1, 30.0}) {
      EXPECT_EQ (gridOf (raster (step, one_in)).step, 0.0);
      EXPECT_EQ (gridOf (asFloats (raster (step, one_in))).step, 0.0);
    }
  for (const double step : {1.0, 0.5}) // half is the step of floats there
    EXPECT_EQ (gridOf (asFloats (placed (raster (step, 1), ON_A_MAP))).step, 0.0);
  // Flat ones, and voxels of a solid's surface.
  EXPECT_EQ (gridOf (disc (0.05, 1).positions).step, 0.0);
  EXPECT_EQ (gridOf (latticeCube (11)).step, 0.0);
}

} // namespace
} // namespace pcl::floater

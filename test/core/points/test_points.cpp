// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/points.h"

#include "samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pcl::floater {
namespace {
using samples::indices;
using samples::Positions;

constexpr double INF = std::numeric_limits<double>::infinity ();
constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN ();

Points
make (const Positions& positions, int threads = 1)
{
  return makePoints (positions, indices (positions.size ()), threads);
}

// Every input is exactly one of these: a point, a duplicate of a point, or not finite.
void
expectPartition (const Points& points, std::size_t count)
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
  EXPECT_EQ (all, indices (count));
  EXPECT_TRUE (std::is_sorted (points.non_finite.begin (), points.non_finite.end ()));
  EXPECT_TRUE (std::is_sorted (points.duplicates.begin (), points.duplicates.end ()));
}

// What the stages rely on: points are finite and distinct, in a box of diagonal 1 around the
// origin.
void
expectWorkable (const Points& points)
{
  Eigen::AlignedBox3d box;
  std::set<std::array<double, 3>> distinct;
  for (const Eigen::Vector3d& p : points.positions) {
    ASSERT_TRUE (p.allFinite ());
    box.extend (p);
    EXPECT_TRUE (distinct.insert ({p.x (), p.y (), p.z ()}).second) << p.transpose ();
  }
  EXPECT_EQ (points.positions.size (), points.cloud_index.size ());
  if (points.positions.size () > 1) {
    EXPECT_NEAR (box.diagonal ().norm (), 1.0, 1e-12);
    EXPECT_LT (box.center ().norm (), 1e-12);
  }
}

TEST (Points, LeadsBackToTheCloud)
{
  Positions cloud = samples::randomPoints (2000, 1);
  for (Eigen::Vector3d& p : cloud)
    p = Eigen::Vector3d (3.0, 40.0, -7.0) + 25.0 * p;
  const Points points = make (cloud);
  expectPartition (points, cloud.size ());
  expectWorkable (points);
  for (std::size_t p = 0; p < points.positions.size (); ++p) {
    const Eigen::Vector3d back = points.inCloud (static_cast<Index> (p));
    EXPECT_LT ((back - cloud[points.cloud_index[p]]).norm (), 1e-13 * points.scale);
  }
}

TEST (Points, TheSmallestIndexStandsForDuplicates)
{
  Positions cloud = samples::randomPoints (100, 4);
  for (const std::size_t i : {50U, 7U, 7U, 99U})
    cloud.push_back (cloud[i]);
  const Points points = make (cloud);
  expectPartition (points, cloud.size ());
  expectWorkable (points);
  const std::vector<std::array<Index, 2>> expected = {{100, 50}, {101, 7}, {102, 7}, {103, 99}};
  EXPECT_EQ (points.duplicates, expected);
}

TEST (Points, CloudIndicesNeedNotAscend)
{
  const Positions cloud = {{1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {NOT_A_NUMBER, 0, 0}, {0, INF, 0}};
  const Points points = makePoints (cloud, {9, 4, 6, 8, 2}, 1);
  const std::vector<std::array<Index, 2>> duplicates = {{9, 6}};
  EXPECT_EQ (points.duplicates, duplicates);
  EXPECT_EQ (points.non_finite, (std::vector<Index>{2, 8}));
  std::vector<Index> left = points.cloud_index;
  std::sort (left.begin (), left.end ());
  EXPECT_EQ (left, (std::vector<Index>{4, 6}));
}

TEST (Points, EveryNonFiniteCoordinateCounts)
{
  Positions cloud = samples::randomPoints (20, 5);
  std::vector<Index> expected;
  for (const double bad : {NOT_A_NUMBER, INF, -INF})
    for (int axis = 0; axis < 3; ++axis) {
      expected.push_back (static_cast<Index> (cloud.size ()));
      cloud.emplace_back (0.5, 0.5, 0.5);
      cloud.back ()[axis] = bad;
    }
  const Points points = make (cloud);
  expectPartition (points, cloud.size ());
  expectWorkable (points);
  EXPECT_EQ (points.non_finite, expected);
}

TEST (Points, MayBeEmpty)
{
  EXPECT_TRUE (make ({}).positions.empty ());
  const Points points = make (Positions (3, Eigen::Vector3d::Constant (NOT_A_NUMBER)));
  EXPECT_TRUE (points.positions.empty ());
  EXPECT_EQ (points.non_finite.size (), 3U);
}

TEST (Points, EqualPointsAreOne)
{
  const Points points = make (Positions (50, Eigen::Vector3d (1e7, -3.25, 1e-9)));
  EXPECT_EQ (points.positions.size (), 1U);
  EXPECT_EQ (points.cloud_index.front (), 0U);
  EXPECT_EQ (points.duplicates.size (), 49U);
  EXPECT_TRUE (points.positions.front ().allFinite ());
  EXPECT_GT (points.scale, 0.0);
}

TEST (Points, NegativeZeroIsZero)
{
  const Points points = make ({{0.0, -0.0, 0.0}, {1, 1, 1}, {-0.0, 0.0, -0.0}});
  EXPECT_EQ (points.positions.size (), 2U);
  const std::vector<std::array<Index, 2>> expected = {{2, 0}};
  EXPECT_EQ (points.duplicates, expected);
}

TEST (Points, PointsThatScalingCannotTellApartAreOne)
{
  // The origin is a corner of the box, where even single precision has different values for these.
  Positions cloud = {{0, 0, 0}, {1, 1, 1}, {1, 0, 0}};
  for (int i = 1; i <= 40; ++i)
    cloud.emplace_back (1e-30 * (i % 7), 1e-25 * (i % 5), 1e-20 * i);
  const Points points = make (cloud);
  expectPartition (points, cloud.size ());
  expectWorkable (points);
  EXPECT_EQ (points.positions.size (), 3U);
  // At the centre of the box they are different after scaling, too.
  for (Eigen::Vector3d& p : cloud)
    p -= p.squaredNorm () < 0.5 ? Eigen::Vector3d::Zero () : Eigen::Vector3d (2.0 * p);
  cloud.emplace_back (1, 1, 1);
  cloud.emplace_back (-1, 1, 1);
  const Points around_centre = make (cloud);
  expectPartition (around_centre, cloud.size ());
  expectWorkable (around_centre);
  EXPECT_GT (around_centre.positions.size (), 40U);
}

TEST (Points, ABoxAsSmallAsOneDigit)
{
  const double two_to_52 = 4503599627370496.0; // from here on doubles are 1 apart
  for (const double base : {two_to_52, two_to_52 + 1, -two_to_52 - 1}) {
    const Points points = make ({{base, base, base},
                                 {base + 1, base, base},
                                 {base, base + 1, base},
                                 {base + 1, base + 1, base + 1}});
    EXPECT_EQ (points.positions.size (), 4U);
    for (const Eigen::Vector3d& p : points.positions)
      EXPECT_LE (p.cwiseAbs ().maxCoeff (), 1.0);
  }
}

RunStatus
statusOf (const Positions& positions)
{
  return checkPoints (make (positions)).status;
}

TEST (CheckPoints, FourDistinctFinitePoints)
{
  const Positions square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_EQ (statusOf (square), RunStatus::SUCCESS);
  EXPECT_EQ (statusOf ({}), RunStatus::TOO_FEW_POINTS);
  EXPECT_EQ (statusOf ({square[0], square[1], square[2]}), RunStatus::TOO_FEW_POINTS);
  EXPECT_EQ (statusOf ({square[0], square[1], square[2], square[1], square[0]}),
             RunStatus::TOO_FEW_POINTS);
  EXPECT_EQ (statusOf ({square[0], square[1], square[2], {0, NOT_A_NUMBER, 0}}),
             RunStatus::TOO_FEW_POINTS);
}

TEST (CheckPoints, NotAllOnOneLine)
{
  for (const double scale : {1e-20, 1.0, 1e20}) {
    Positions line;
    for (int i = 0; i < 30; ++i) // rounded to single precision, as clouds are
      line.emplace_back (static_cast<float> (scale * 0.1 * i), static_cast<float> (scale * 0.3 * i),
                         static_cast<float> (scale * -0.7 * i));
    EXPECT_EQ (statusOf (line), RunStatus::DEGENERATE);
    line.emplace_back (scale * 0.01, 0.0, 0.0);
    EXPECT_EQ (statusOf (line), RunStatus::SUCCESS);
  }
}

TEST (CheckPoints, SmallObjectsFarApartAreNoLine)
{
  Positions cloud = samples::randomPoints (200, 11);
  for (const Eigen::Vector3d& p : samples::randomPoints (300, 12))
    cloud.emplace_back (p + Eigen::Vector3d (1e8, 2e8, 0.0));
  EXPECT_EQ (statusOf (cloud), RunStatus::SUCCESS);
  cloud.assign (cloud.begin (), cloud.begin () + 200);
  cloud.emplace_back (1e10, 0.0, 0.0);
  EXPECT_EQ (statusOf (cloud), RunStatus::SUCCESS);
}

// Random points in a cube, and two points far away.
Positions
withFarPoints ()
{
  Positions cloud = samples::randomPoints (200, 9);
  cloud.emplace_back (100.0, 0.0, 0.0);
  cloud.emplace_back (50.0, -70.0, 0.0);
  return cloud;
}

// Rows of the points from this cloud index on, and of one more.
std::vector<Index>
rowsFrom (const Points& points, Index cloud_index, Index one_more)
{
  std::vector<Index> rows;
  for (Index p = 0; p < points.size (); ++p)
    if (points.cloud_index[p] >= cloud_index || points.cloud_index[p] == one_more)
      rows.push_back (p);
  return rows;
}

TEST (RemovePoints, KeepsTheOrderAndThePlaceInTheCloud)
{
  const Points before = make (withFarPoints ());
  Points points = before;
  const std::vector<Index> rows = rowsFrom (points, 200, 17);
  EXPECT_EQ (removePoints (points, rows), (std::vector<Index>{17, 200, 201}));
  ASSERT_EQ (points.positions.size (), 199U);
  ASSERT_EQ (points.cloud_index.size (), 199U);
  for (Index p = 0, q = 0; p < points.size (); ++p, ++q) {
    while (std::binary_search (rows.begin (), rows.end (), q))
      ++q;
    EXPECT_EQ (points.cloud_index[p], before.cloud_index[q]);
    EXPECT_EQ (points.inCloud (p), before.inCloud (q));
  }
  EXPECT_EQ (removePoints (points, indices (199)).size (), 199U);
  EXPECT_TRUE (points.positions.empty ());
}

TEST (RemovePoints, NormalsStayWithTheirPoints)
{
  const Positions positions = withFarPoints ();
  std::vector<Eigen::Vector3f> normals, front;
  for (std::size_t i = 0; i < positions.size (); ++i) {
    const double angle = 0.01 * static_cast<double> (i);
    normals.push_back (
        Eigen::Vector3d (2.0 * std::cos (angle), 2.0 * std::sin (angle), 0.0).cast<float> ());
    front.push_back (-normals.back ());
  }
  Points points = make (positions);
  points.normals = normalsOfPoints (normals, points);
  points.facing_normals = normalsOfPoints (front, points);
  removePoints (points, rowsFrom (points, 200, NONE));
  ASSERT_EQ (points.normals.size (), points.size ());
  ASSERT_EQ (points.facing_normals.size (), points.size ());
  for (Index p = 0; p < points.size (); ++p) {
    EXPECT_LT ((2.0F * points.normals[p] - normals[points.cloud_index[p]]).norm (), 1e-6F);
    EXPECT_EQ (points.facing_normals[p], -points.normals[p]);
  }
}

TEST (RemovePoints, ScalesByAPowerOfTwo)
{
  const Points before = make (withFarPoints ());
  Points points = before;
  removePoints (points, rowsFrom (points, 200, NONE));
  const double factor = before.scale / points.scale;
  int exponent = 0;
  EXPECT_EQ (std::frexp (factor, &exponent), 0.5);
  EXPECT_GT (factor, 16.0);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points.positions)
    box.extend (p);
  EXPECT_NEAR (points.diagonal, box.diagonal ().norm (), 1e-15);
  EXPECT_GE (points.diagonal, 0.5);
  EXPECT_LE (points.diagonal, 1.0);
  // So distances differ in their exponents only, all by the same, and compare as before.
  const std::vector<Index> kept = [&before] {
    std::vector<Index> rows;
    for (Index p = 0; p < before.size (); ++p)
      if (before.cloud_index[p] < 200)
        rows.push_back (p);
    return rows;
  }();
  ASSERT_EQ (kept.size (), points.size ());
  for (std::size_t p = 0; p < kept.size (); ++p)
    for (std::size_t q = 0; q < p; ++q) {
      const Eigen::Vector3d offset = before.positions[kept[p]] - before.positions[kept[q]];
      ASSERT_EQ ((points.positions[p] - points.positions[q]).squaredNorm (),
                 factor * factor * offset.squaredNorm ());
    }
}

TEST (RemovePoints, DownToOnePlace)
{
  Points points = make (withFarPoints ());
  std::vector<Index> all_but_one = indices (points.size ());
  all_but_one.erase (all_but_one.begin () + 40);
  const Index kept = points.cloud_index[40];
  const Eigen::Vector3d place = points.inCloud (40);
  EXPECT_EQ (removePoints (points, all_but_one).size (), 201U);
  EXPECT_EQ (points.cloud_index, (std::vector<Index>{kept}));
  EXPECT_EQ (points.inCloud (0), place);
  EXPECT_TRUE (points.positions.front ().allFinite ());
}

} // namespace
} // namespace pcl::floater

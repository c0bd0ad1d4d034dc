// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/continuations.h"

#include "samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::Positions;

constexpr int SHEET_SIDE = 10;

// Squares of unit spacing, in a frame each: a grid of x and y from 0 to SHEET_SIDE, its front along
// z.
struct Squares
{
  Positions positions;
  TriangleMesh mesh;

  void add (const Eigen::Isometry3d& place, bool is_reversed)
  {
    const auto first = static_cast<Index> (positions.size ());
    for (int y = 0; y <= SHEET_SIDE; ++y)
      for (int x = 0; x <= SHEET_SIDE; ++x)
        positions.emplace_back (place * Eigen::Vector3d (x, y, 0.0));
    const auto at = [first] (int x, int y) {
      return first + static_cast<Index> (y * (SHEET_SIDE + 1) + x);
    };
    for (int y = 0; y < SHEET_SIDE; ++y)
      for (int x = 0; x < SHEET_SIDE; ++x)
        for (Triangle t : {Triangle{at (x, y), at (x + 1, y), at (x + 1, y + 1)},
                           Triangle{at (x, y), at (x + 1, y + 1), at (x, y + 1)}}) {
          if (is_reversed)
            std::swap (t[0], t[1]);
          mesh.triangles.push_back (t);
        }
  }

  std::vector<Continuation> continuations ()
  {
    EXPECT_TRUE (mesh.connect (positions.size (), 1));
    return findContinuations (mesh, findComponents (mesh, 1), positions, {}, 1);
  }
};

// One square, and another one beside it, which turns halfway across the gap.
std::vector<Continuation>
beside (double gap, double height, double degrees, bool is_reversed)
{
  Squares squares;
  squares.add (Eigen::Isometry3d::Identity (), false);
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity ();
  place.translate (Eigen::Vector3d (SHEET_SIDE + 0.5 * gap, 0.0, height));
  place.rotate (Eigen::AngleAxisd (-degrees * DEGREE, Eigen::Vector3d::UnitY ()));
  place.translate (Eigen::Vector3d (0.5 * gap, 0.0, 0.0));
  squares.add (place, is_reversed);
  return squares.continuations ();
}

TEST (Continuations, AreFoundBesideWhateverTheAngle)
{
  for (const double degrees : {0.0, 30.0, 90.0, -90.0})
    for (const bool is_reversed : {false, true}) {
      SCOPED_TRACE (degrees);
      const std::vector<Continuation> found = beside (2.0, 0.0, degrees, is_reversed);
      ASSERT_EQ (found.size (), 1U);
      EXPECT_EQ (found.front ().a, 0U);
      EXPECT_EQ (found.front ().b, 1U);
      EXPECT_EQ (found.front ().is_opposite, is_reversed);
      EXPECT_GT (found.front ().support, 0.5 * SHEET_SIDE);
    }
}

TEST (Continuations, AreNeitherFarNorAbove)
{
  EXPECT_EQ (beside (7.0, 0.0, 0.0, false).size (), 1U);
  EXPECT_TRUE (beside (9.0, 0.0, 0.0, false).empty ());
  EXPECT_TRUE (beside (-SHEET_SIDE, 1.0, 0.0, false).empty ());
  EXPECT_TRUE (beside (-SHEET_SIDE, 0.1, 0.0, true).empty ());
}

TEST (Continuations, NeedTwoComponents)
{
  Squares squares;
  EXPECT_TRUE (squares.continuations ().empty ());
  squares.add (Eigen::Isometry3d::Identity (), false);
  EXPECT_TRUE (squares.continuations ().empty ());
}

} // namespace
} // namespace pcl::floater

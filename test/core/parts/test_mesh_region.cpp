// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/near_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pcl::floater {
namespace {
constexpr Index SIDE = 9; // points of a row of the grid

Index
at (Index x, Index y)
{
  return y * SIDE + x;
}

// Two triangles in each cell.
std::vector<Triangle>
grid ()
{
  std::vector<Triangle> triangles;
  for (Index y = 0; y + 1 < SIDE; ++y)
    for (Index x = 0; x + 1 < SIDE; ++x) {
      triangles.push_back ({at (x, y), at (x + 1, y), at (x + 1, y + 1)});
      triangles.push_back ({at (x, y), at (x + 1, y + 1), at (x, y + 1)});
    }
  return triangles;
}

TEST (MeshRegion, RingsAroundAPoint)
{
  const Index middle = at (4, 4);
  const MeshRegion one = regionAround (grid (), SIDE * SIDE, {middle}, 1);
  EXPECT_EQ (one.triangles.size (), 6U);
  EXPECT_EQ (one.points.size (), 7U);
  for (std::size_t i = 0; i < one.points.size (); ++i)
    EXPECT_EQ (one.is_partial[i] != 0, one.points[i] != middle);
  const MeshRegion two = regionAround (grid (), SIDE * SIDE, {middle}, 2);
  EXPECT_EQ (two.triangles.size (), 24U);
  EXPECT_EQ (two.points.size (), 19U);
  EXPECT_EQ (std::count (two.is_partial.begin (), two.is_partial.end (), 0), 7);
}

TEST (MeshRegion, AllOfIt)
{
  const MeshRegion all = regionAround (grid (), SIDE * SIDE, {at (0, 0)}, 100);
  EXPECT_EQ (all.triangles.size (), grid ().size ());
  EXPECT_EQ (std::count (all.is_partial.begin (), all.is_partial.end (), 1), 0);
}

TEST (MeshRegion, SeedsWithoutTrianglesAndTrianglesBesides)
{
  const std::vector<Triangle> triangles = grid ();
  std::vector<std::uint8_t> besides (triangles.size (), 0);
  besides.back () = 1;
  const Index alone = SIDE * SIDE; // a point more than the grid has
  const MeshRegion region = regionAround (triangles, SIDE * SIDE + 1, {alone}, 3, besides);
  EXPECT_EQ (region.triangles, std::vector<Index> (1, static_cast<Index> (triangles.size () - 1)));
  EXPECT_EQ (region.points, (std::vector<Index>{at (7, 7), at (7, 8), at (8, 8), alone}));
  EXPECT_EQ (region.is_partial, (std::vector<std::uint8_t>{1, 1, 1, 0}));
}

// A point with two fans is no end of a walk around it.
TEST (MeshRegion, PointOfTwoFans)
{
  const MeshRegion region = regionAround ({{0, 1, 2}, {0, 3, 4}}, 5, {0}, 1);
  EXPECT_EQ (region.triangles.size (), 2U);
  EXPECT_EQ (std::count (region.is_partial.begin (), region.is_partial.end (), 1), 0);
}

} // namespace
} // namespace pcl::floater

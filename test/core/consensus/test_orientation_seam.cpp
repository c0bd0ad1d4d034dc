// SPDX-License-Identifier: GPL-3.0-or-later
#include "consensus/orientation_seam.h"

#include <gtest/gtest.h>

namespace pcl
{
namespace floater
{
namespace
{
// A strip of triangles over points from `first` on.
std::vector<Triangle>
row (Index first, std::size_t length)
{
  std::vector<Triangle> triangles;
  for (Index p = first; triangles.size () < length; ++p)
    triangles.push_back ({p, p + 1, p + 2});
  return triangles;
}

std::vector<Triangle>
joined (std::vector<Triangle> a, const std::vector<Triangle>& b)
{
  a.insert (a.end (), b.begin (), b.end ());
  return a;
}

TEST (OneSidedRow, IsTheLongest)
{
  const std::vector<Triangle> longer = row (100, SHORTEST_ROW + 1), shorter = row (0, SHORTEST_ROW);
  EXPECT_EQ (longestRow (joined (shorter, longer)), longer);
  EXPECT_EQ (longestRow (joined (longer, shorter)), longer);
  EXPECT_EQ (longestRow (shorter), shorter);
}

TEST (OneSidedRow, HangsTogetherByEdgesWhateverTheWayRound)
{
  std::vector<Triangle> triangles = row (0, SHORTEST_ROW);
  for (std::size_t t = 0; t < triangles.size (); t += 2)
    std::swap (triangles[t][0], triangles[t][2]);
  EXPECT_EQ (longestRow (triangles), triangles);
  // Two halves that share a point only.
  const auto half = static_cast<Index> (SHORTEST_ROW / 2);
  EXPECT_TRUE (longestRow (joined (row (0, half), row (half + 1, half))).empty ());
}

TEST (OneSidedRow, IsNoneOfStrayTriangles)
{
  EXPECT_TRUE (longestRow ({}).empty ());
  EXPECT_TRUE (longestRow (row (0, SHORTEST_ROW - 1)).empty ());
  std::vector<Triangle> stray;
  for (Index t = 0; t < 100; ++t)
    stray.push_back ({3 * t, 3 * t + 1, 3 * t + 2});
  EXPECT_TRUE (longestRow (stray).empty ());
}

} // namespace
} // namespace floater
} // namespace pcl

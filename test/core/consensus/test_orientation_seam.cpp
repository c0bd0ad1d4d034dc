// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "consensus/orientation.h"

#include "consensus/consensus_mesh.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
constexpr std::size_t SHORTEST_SEAM = 8;

std::vector<Triangle>
findSeam (const std::vector<Triangle>& contradicting)
{
  EXPECT_EQ (ConsensusLimits{}.shortest_seam, SHORTEST_SEAM);
  return findOrientationSeam (contradicting, SHORTEST_SEAM);
}

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

TEST (OrientationSeam, IsTheLongestRow)
{
  const std::vector<Triangle> longer = row (100, SHORTEST_SEAM + 1),
                              shorter = row (0, SHORTEST_SEAM);
  EXPECT_EQ (findSeam (joined (shorter, longer)), longer);
  EXPECT_EQ (findSeam (joined (longer, shorter)), longer);
  EXPECT_EQ (findSeam (shorter), shorter);
}

TEST (OrientationSeam, IsConnectedByEdgesWhateverTheWayRound)
{
  std::vector<Triangle> triangles = row (0, SHORTEST_SEAM);
  for (std::size_t t = 0; t < triangles.size (); t += 2)
    std::swap (triangles[t][0], triangles[t][2]);
  EXPECT_EQ (findSeam (triangles), triangles);
  // Two halves that share a point only.
  const auto half = static_cast<Index> (SHORTEST_SEAM / 2);
  EXPECT_TRUE (findSeam (joined (row (0, half), row (half + 1, half))).empty ());
}

TEST (OrientationSeam, StrayTrianglesAreNone)
{
  EXPECT_TRUE (findSeam ({}).empty ());
  EXPECT_TRUE (findSeam (row (0, SHORTEST_SEAM - 1)).empty ());
  std::vector<Triangle> stray;
  for (Index t = 0; t < 100; ++t)
    stray.push_back ({3 * t, 3 * t + 1, 3 * t + 2});
  EXPECT_TRUE (findSeam (stray).empty ());
}

} // namespace
} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Loops over the triangles around points, on several threads.
#include "mesh/vertex_stars.h"

#include "samples.h"

#include <gtest/gtest.h>


namespace pcl
{
namespace floater
{
namespace
{
TEST (VertexStars, HaveTheTrianglesOfEachPointInTheirOrder)
{
  constexpr std::size_t POINTS = 3 * TriangleRanges::LENGTH + 5;
  RandomStream random (2);
  std::vector<Triangle> triangles (150000); // in three chunks
  std::vector<std::vector<Index>> around (POINTS);
  std::size_t improper = 0;
  for (Index t = 0; t < triangles.size (); ++t) {
    for (Index& p : triangles[t])
      p = static_cast<Index> (random.below (POINTS + 3));
    if (isProper (triangles[t], POINTS))
      for (const Index p : triangles[t])
        around[p].push_back (t);
    else
      ++improper;
  }
  EXPECT_GT (improper, 0U);
  for (const int threads : {1, 2, 5}) {
    const TriangleRanges ranges (triangles, POINTS, threads);
    ASSERT_EQ (ranges.count (), 4U);
    EXPECT_EQ (ranges.leftOut (), improper);
    for (std::size_t r = 0; r < ranges.count (); ++r) {
      const VertexStars stars (triangles, ranges, r);
      for (std::size_t p = ranges.firstPoint (r); p < ranges.lastPoint (r); ++p) {
        const VertexStar star = stars.of (p);
        ASSERT_EQ (star.size (), around[p].size ());
        for (std::size_t i = 0; i < star.size (); ++i) {
          const Triangle& t = triangles[star[i].triangle];
          EXPECT_EQ (star[i].triangle, around[p][i]);
          const std::size_t corner = t[0] == p ? 0 : t[1] == p ? 1 : 2;
          EXPECT_EQ (star[i].next, t[(corner + 1) % 3]);
          EXPECT_EQ (star[i].previous, t[(corner + 2) % 3]);
        }
      }
    }
  }
  EXPECT_EQ (TriangleRanges ({}, 0, 2).count (), 0U);
}

} // namespace
} // namespace floater
} // namespace pcl

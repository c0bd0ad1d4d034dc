// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/boundary/boundary.h"

#include "samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::PI;

// One star: point 0 with neighbours 1, 2, and so on. The neighbours have no stars.
Stars
starOf (const std::vector<Eigen::Vector2d>& offsets, bool open)
{
  Stars stars;
  const auto count = static_cast<Index> (offsets.size ());
  stars.neighbors.offsets.assign (count + 2, count);
  stars.neighbors.offsets[0] = 0;
  for (Index i = 1; i <= count; ++i)
    stars.neighbors.ids.push_back (i);
  stars.offsets_in_plane = offsets;
  stars.open.assign (count + 1, 0);
  stars.open[0] = open ? 1 : 0;
  return stars;
}

std::vector<std::array<Index, 3>>
gapsOf (const Stars& stars, double circumradius_ratio)
{
  std::vector<std::array<Index, 3>> gaps;
  const std::vector<float> spacing (stars.open.size (), 1.0F);
  for (const Gap& gap : findGaps (stars, spacing, circumradius_ratio, 1))
    gaps.push_back ({gap.point, gap.first, gap.last});
  return gaps;
}

using Gaps = std::vector<std::array<Index, 3>>;

TEST (Gaps, AreNoneInAClosedStarOfSmallTriangles)
{
  EXPECT_EQ (gapsOf (starOf ({{1, 0}, {0, 1}, {-1, 0}, {0, -1}}, false), 1.5), Gaps{});
}

TEST (Gaps, OfAnOpenStarGoFromItsLastNeighborToItsFirst)
{
  EXPECT_EQ (gapsOf (starOf ({{1, 0}, {0, 1}, {-1, 0}}, true), 1.5), (Gaps{{0, 3, 1}}));
  EXPECT_EQ (gapsOf (starOf ({{1, 0}, {0, 1}}, true), 1.5), (Gaps{{0, 2, 1}}));
}

TEST (Gaps, AreTrianglesWithAWideCircumcircle)
{
  // Right angles at the centre: the circumradius is half of the opposite side, sqrt (1 + 9) / 2 =
  // 1.58, on both sides of the long neighbour.
  const Stars stars = starOf ({{1, 0}, {0, 1}, {-3, 0}, {0, -1}}, false);
  EXPECT_EQ (gapsOf (stars, 1.55), (Gaps{{0, 2, 4}}));
  EXPECT_EQ (gapsOf (stars, 1.6), Gaps{});
  // Only one triangle is too wide.
  EXPECT_EQ (gapsOf (starOf ({{1, 0}, {0, 1}, {-3, 0}, {-1.5, -0.5}, {0, -1}}, false), 2.0),
             (Gaps{{0, 3, 4}}));
}

TEST (Gaps, AreRunsOfMissingTriangles)
{
  // The run may go on at the beginning of the row.
  const Stars stars = starOf ({{5, 0}, {0, 1}, {-1, 0}, {0, -1}, {4, -4}}, false);
  EXPECT_EQ (gapsOf (stars, 2.0), (Gaps{{0, 4, 2}}));
  // The open sector of a star is part of the run.
  const Stars open = starOf ({{5, 0}, {0.5, 1}, {-1, 0.5}, {-5, 0}}, true);
  EXPECT_EQ (gapsOf (open, 2.0), (Gaps{{0, 3, 2}}));
}

TEST (Gaps, AreTwoWhereSheetsTouch)
{
  const Stars stars = starOf ({{1, -0.5}, {1, 0.5}, {-1, 0.5}, {-1, -0.5}}, false);
  // The triangles above and below have a circumradius of 1.25, the other two one of 0.625.
  EXPECT_EQ (gapsOf (stars, 1.0), (Gaps{{0, 2, 3}, {0, 4, 1}}));
}

TEST (Gaps, OfAStarWithoutTrianglesGoFromItsNearestNeighborToTheSame)
{
  EXPECT_EQ (gapsOf (starOf ({{2, 0}}, true), 1.5), (Gaps{{0, 1, 1}}));
  EXPECT_EQ (gapsOf (starOf ({{9, 0}, {0, 8}, {-9, -1}}, false), 1.5), (Gaps{{0, 2, 2}}));
  EXPECT_EQ (gapsOf (starOf ({}, true), 1.5), Gaps{});
}

TEST (Gaps, BetweenNeighborsOppositeToEachOther)
{
  // They make no triangle: in floating point the circumradius is huge.
  EXPECT_EQ (gapsOf (starOf ({{1, 0}, {-1, 0}}, true), 1.5), (Gaps{{0, 1, 1}}));
}

TEST (Gaps, DependOnTheSpacingOfAllThreeCorners)
{
  const Stars stars = starOf ({{1, 0}, {0, 1}, {-3, 0}, {0, -1}}, false);
  const std::vector<Gap> gaps = findGaps (stars, {1.0F, 1.0F, 1.0F, 2.0F, 1.0F}, 1.55, 1);
  EXPECT_TRUE (gaps.empty ());
}

TEST (Gaps, OfASheetAreAtItsBorder)
{
  const samples::Sheet sheet = samples::disc (0.05, 1);
  const samples::Neighborhoods made = samples::makeNeighborhoods (sheet.positions);
  const std::vector<Gap> gaps = findGaps (made.geometry.stars, made.geometry.spacing, 2.0, 1);
  const auto count = static_cast<Index> (sheet.border);
  ASSERT_EQ (gaps.size (), sheet.border);
  for (std::size_t i = 0; i < gaps.size (); ++i) {
    EXPECT_TRUE (i == 0 || gaps[i - 1].point < gaps[i].point);
    // The ends of the gap are the next points of the border on either side.
    const Index p = made.points.cloud_index[gaps[i].point];
    std::set<Index> ends = {made.points.cloud_index[gaps[i].first],
                            made.points.cloud_index[gaps[i].last]};
    ASSERT_LT (p, count);
    EXPECT_EQ (ends, (std::set<Index>{(p + 1) % count, (p + count - 1) % count}));
  }
}

} // namespace
} // namespace pcl::floater

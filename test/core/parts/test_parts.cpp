// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces of the method in parts: the division into parts, what a part keeps for itself, and what is
// done beside the seam.
#include "parts/near_triangles.h"
#include "parts/seam_finish.h"
#include "parts/stitching.h"

#include "mesh/known_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pcl::floater {
namespace {
TEST (Parts, CoverAllPointsInOrder)
{
  PartLimits limits;
  EXPECT_EQ (Parts (limits.points, limits).count (), 1U);
  EXPECT_EQ (Parts (limits.points + 1, limits).count (), 2U);
  limits.points = 1000;
  for (const std::size_t points : {0U, 1U, 1000U, 1001U, 99999U, 100000U, 100001U}) {
    const Parts parts (points, limits);
    EXPECT_EQ (parts.first (0), 0U);
    EXPECT_EQ (parts.last (parts.count () - 1), points);
    for (std::size_t part = 0; part < parts.count (); ++part) {
      EXPECT_LE (parts.first (part), parts.last (part));
      for (Index p = parts.first (part); p < parts.last (part); p += 97)
        EXPECT_EQ (parts.partOf (p), part);
    }
  }
}

TEST (PartMesh, DoubtfulCandidatesBesideOtherPartsAreLeft)
{
  CandidateLists all;
  all.sure = {{{10, 11, 12}, 0, 1, false}, {{10, 11, 20}, 0, 0, false}};
  all.doubtful = {{{10, 12, 13}, 2, 0, 1.0F, 0.5F}, {{11, 12, 13}, 2, 0, 1.0F, 0.5F}};
  std::vector<std::uint8_t> reaches_out (10, 0);
  reaches_out[0] = 1;
  const PartCandidates divided = divideCandidates (all, 10, 20, reaches_out);
  ASSERT_EQ (divided.inside.sure.size (), 1U);
  EXPECT_EQ (divided.inside.sure[0].corners, (Triangle{0, 1, 2}));
  ASSERT_EQ (divided.inside.doubtful.size (), 1U);
  EXPECT_EQ (divided.inside.doubtful[0].corners, (Triangle{1, 2, 3}));
  ASSERT_EQ (divided.left.size (), 2U);
  EXPECT_EQ (divided.left[0].corners, (Triangle{10, 11, 20}));
  EXPECT_EQ (divided.left[0].votes, 3);
  EXPECT_EQ (divided.left[1].corners, (Triangle{10, 12, 13}));
}

TEST (PartMesh, ReachesOut)
{
  PartLimits limits;
  limits.points = 64;
  const Parts parts (128, limits); // two of 64
  CsrLists stars;
  stars.offsets = {0, 2, 4, 6};
  stars.ids = {60, 62, 61, 64, 63, 65}; // of the points 62 to 64
  EXPECT_EQ (reachesOut (stars, 62, parts), (std::vector<std::uint8_t>{0, 1, 1}));
}

TEST (MeshRegion, RingsAroundAPoint)
{
  constexpr Index SIDE = 9; // points of a row
  const std::vector<Triangle> grid = samples::sheet (SIDE - 1).triangles;
  const auto at = [] (Index x, Index y) { return y * SIDE + x; };
  const auto complete = [] (const MeshRegion& region) {
    return std::count (region.is_partial.begin (), region.is_partial.end (), 0);
  };
  const MeshRegion one = regionAround (grid, SIDE * SIDE, {at (4, 4)}, 1);
  EXPECT_EQ (one.triangles.size (), 6U);
  EXPECT_EQ (one.points.size (), 7U);
  for (std::size_t i = 0; i < one.points.size (); ++i)
    EXPECT_EQ (one.is_partial[i] != 0, one.points[i] != at (4, 4));
  const MeshRegion two = regionAround (grid, SIDE * SIDE, {at (4, 4)}, 2);
  EXPECT_EQ (two.triangles.size (), 24U);
  EXPECT_EQ (two.points.size (), 19U);
  EXPECT_EQ (complete (two), 7);
  const MeshRegion all = regionAround (grid, SIDE * SIDE, {at (0, 0)}, 100);
  EXPECT_EQ (all.triangles.size (), grid.size ());
  EXPECT_EQ (complete (all), SIDE * SIDE);
  // A seed without triangles, a point more than the grid has, and a triangle besides.
  std::vector<std::uint8_t> besides (grid.size (), 0);
  besides.back () = 1;
  const Index alone = SIDE * SIDE;
  const MeshRegion region = regionAround (grid, SIDE * SIDE + 1, {alone}, 3, besides);
  EXPECT_EQ (region.triangles, std::vector<Index> (1, static_cast<Index> (grid.size () - 1)));
  EXPECT_EQ (region.points, (std::vector<Index>{at (7, 7), at (7, 8), at (8, 8), alone}));
  EXPECT_EQ (region.is_partial, (std::vector<std::uint8_t>{1, 1, 1, 0}));
  // A point with two fans is no end of a walk around it.
  const MeshRegion fans = regionAround ({{0, 1, 2}, {0, 3, 4}}, 5, {0}, 1);
  EXPECT_EQ (fans.triangles.size (), 2U);
  EXPECT_EQ (complete (fans), 5);
}

// A point above the middle of a flat sheet without a triangle, whose neighbours are the four points
// below, may have all of these in another part. No triangle of the sheet has corners in several
// parts.
constexpr Index ROW = 20, MIDDLE = ROW / 2 * ROW + ROW / 2;
const std::vector<Index> BELOW{MIDDLE, MIDDLE + 1, MIDDLE + ROW, MIDDLE + ROW + 1};

samples::Mesh
sheetOfRows ()
{
  return samples::grid (
      ROW - 1, ROW - 1, ROW * ROW, [] (Index x, Index y) { return y * ROW + x; },
      [] (Index x, Index y) { return Eigen::Vector3d (x, y, 0.0); });
}

TEST (SeamFinish, PointFarFromTheSeamIsInserted)
{
  const samples::Mesh sheet = sheetOfRows ();
  SeamZone zone;
  zone.positions = sheet.positions;
  zone.positions.emplace_back (ROW / 2 + 0.4, ROW / 2 + 0.5, 0.1);
  zone.points = samples::indices (zone.positions.size ());
  zone.normals.assign (zone.points.size (), Eigen::Vector3f::UnitZ ());
  zone.spacing.assign (zone.points.size (), 1.0F);
  zone.is_partial.assign (zone.points.size (), 0);
  zone.neighbors.offsets.assign (zone.points.size (), 0);
  zone.neighbors.offsets.push_back (static_cast<Index> (BELOW.size ()));
  zone.neighbors.ids = BELOW;
  zone.triangles = sheet.triangles;
  JoinedZones zones;
  zones.add (zone);
  const FinishedSeam finished = finishSeam (std::move (zones), {}, {}, {}, 2, 1);
  EXPECT_EQ (finished.triangles.size (), sheet.triangles.size () + 2);
}

// The part has the sheet, another part the point.
TEST (PartFinish, TrianglesBesideAPointOfAnotherPartAreInTheZone)
{
  const samples::Mesh sheet = sheetOfRows ();
  PartPoints points;
  points.first = 7;
  points.positions = sheet.positions;
  points.normals.assign (points.positions.size (), Eigen::Vector3f::UnitZ ());
  points.spacing.assign (points.positions.size (), 1.0F);
  const NeighborRows none = [] (const std::vector<Index>& some) {
    CsrLists lists;
    lists.offsets.assign (some.size () + 1, 0);
    return lists;
  };
  PartFinishSettings settings;
  settings.parts.rings = 2;
  settings.part_count = 2;
  PartChange change;
  const auto isInZone = [&] (Index p) {
    const FinishedPart finished = finishPart (points, sheet.triangles, change, none, settings, 1);
    const std::vector<Index>& zone = finished.zone.points;
    return std::binary_search (zone.begin (), zone.end (), p + points.first);
  };
  EXPECT_FALSE (isInZone (BELOW[0]));
  change.beside = {BELOW[0] + points.first};
  EXPECT_TRUE (isInZone (BELOW[0]));
  EXPECT_TRUE (isInZone (BELOW[3]));
}

} // namespace
} // namespace pcl::floater

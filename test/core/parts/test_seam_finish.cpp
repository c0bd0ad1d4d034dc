// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points without a triangle, which may have all of their neighbours in other parts.
#include "parts/seam_finish.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pcl::floater {
namespace {
constexpr Index ROW = 20; // points of a row of the sheet

// A flat sheet of points, and one above its middle that has no triangle, whose neighbours are the
// points below. No triangle of the sheet has corners in several parts.
struct SheetAndPoint
{
  std::vector<Eigen::Vector3d> positions;
  std::vector<Triangle> triangles;
  std::vector<Index> below;
};

SheetAndPoint
sheetAndPoint ()
{
  SheetAndPoint made;
  for (Index y = 0; y < ROW; ++y)
    for (Index x = 0; x < ROW; ++x)
      made.positions.emplace_back (x, y, 0.0);
  for (Index y = 0; y + 1 < ROW; ++y)
    for (Index x = 0; x + 1 < ROW; ++x) {
      const Index a = y * ROW + x, b = a + 1, c = a + ROW, d = c + 1;
      made.triangles.push_back ({a, b, d});
      made.triangles.push_back ({a, d, c});
    }
  const Index middle = ROW / 2 * ROW + ROW / 2;
  made.below = {middle, middle + 1, middle + ROW, middle + ROW + 1};
  return made;
}

CsrLists
listsOf (const SheetAndPoint& made)
{
  CsrLists lists;
  lists.offsets.assign (made.positions.size () + 1, 0);
  lists.ids = made.below;
  lists.offsets.push_back (static_cast<Index> (lists.ids.size ()));
  return lists;
}

TEST (SeamFinish, PointFarFromTheSeamIsInserted)
{
  const SheetAndPoint made = sheetAndPoint ();
  SeamZone zone;
  zone.positions = made.positions;
  zone.positions.emplace_back (ROW / 2 + 0.4, ROW / 2 + 0.5, 0.1);
  for (Index p = 0; p < zone.positions.size (); ++p)
    zone.points.push_back (p);
  zone.normals.assign (zone.points.size (), Eigen::Vector3f::UnitZ ());
  zone.spacing.assign (zone.points.size (), 1.0F);
  zone.is_partial.assign (zone.points.size (), 0);
  zone.is_scatter.assign (zone.points.size (), 0);
  zone.neighbors = listsOf (made);
  zone.triangles = made.triangles;
  JoinedZones zones;
  zones.add (zone);
  const FinishedSeam finished = finishSeam (std::move (zones), {}, {}, {}, 2, 1);
  EXPECT_EQ (finished.triangles.size (), made.triangles.size () + 2);
}

// The part has the sheet, another part the point.
TEST (PartFinish, TrianglesBesideAPointOfAnotherPartAreInTheZone)
{
  const SheetAndPoint made = sheetAndPoint ();
  PartPoints points;
  points.first = 7;
  points.positions = made.positions;
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
    const FinishedPart finished =
        finishPart (points, made.triangles, change, none, {}, settings, 1);
    const std::vector<Index>& zone = finished.zone.points;
    const auto at = std::lower_bound (zone.begin (), zone.end (), p + points.first);
    return at != zone.end () && *at == p + points.first;
  };
  EXPECT_FALSE (isInZone (made.below[0]));
  change.beside = {made.below[0] + points.first};
  EXPECT_TRUE (isInZone (made.below[0]));
  EXPECT_TRUE (isInZone (made.below[3]));
}

} // namespace
} // namespace pcl::floater

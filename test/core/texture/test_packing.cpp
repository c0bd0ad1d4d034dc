// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Packing of cells, and the repair of what rounding to single precision flips.
#include "random_stream.h"
#include "texture/atlas.h"
#include "texture/stretch.h"
#include "texture_check.h"

#include <gtest/gtest.h>

#include <set>

namespace pcl::floater {
namespace {
using Plane = std::vector<Eigen::Vector2d>;

std::set<std::pair<Index, Index>>
cellsOf (const CellMask& mask)
{
  std::set<std::pair<Index, Index>> cells;
  for (Index y = 0; y < mask.rows.size (); ++y)
    for (const CellRun& run : mask.rows[y])
      for (Index x = run.first; x <= run.last; ++x)
        cells.insert ({x, y});
  return cells;
}

TEST (CellMask, HasTouchedCellsAndThoseBesideThem)
{
  const CellMask dot = makeCellMask ({{0, 1, 2}}, {{0.2, 0.2}, {0.8, 0.2}, {0.2, 0.8}});
  EXPECT_EQ (dot.width, 3U);
  EXPECT_EQ (dot.cells, 9U);
  EXPECT_EQ (cellsOf (dot).size (), 9U);

  // A triangle of 5 x 4, by brute force: cells with a point of it, then those beside.
  const Plane uv{{0.5, 0.3}, {5.5, 0.4}, {2.5, 4.2}};
  std::set<std::pair<Index, Index>> expected;
  for (int i = 0; i <= 1000; ++i)
    for (int j = 0; i + j <= 1000; ++j) {
      const Eigen::Vector2d p = uv[0] + 1e-3 * i * (uv[1] - uv[0]) + 1e-3 * j * (uv[2] - uv[0]);
      for (Index x = 0; x < 3; ++x)
        for (Index y = 0; y < 3; ++y)
          expected.insert ({static_cast<Index> (p.x ()) + x, static_cast<Index> (p.y ()) + y});
    }
  const CellMask mask = makeCellMask ({{0, 1, 2}}, uv);
  EXPECT_EQ (cellsOf (mask), expected);
  EXPECT_EQ (mask.cells, expected.size ());
}

TEST (CellPacking, NoCellTwiceAndLittleWaste)
{
  RandomStream random (1);
  std::vector<std::array<CellMask, 4>> shapes;
  std::size_t cells = 0;
  for (int i = 0; i < 200; ++i) {
    const double width = 1.0 + 30.0 * random.uniform () * random.uniform (),
                 height = width + 40.0 * random.uniform () * random.uniform ();
    const double lean = 0.5 * width * random.uniform ();
    // A quadrilateral, in four directions.
    Plane uv{{0.0, 0.0}, {width - lean, 0.0}, {width, height}, {lean, height}};
    std::array<CellMask, 4> shape;
    for (CellMask& mask : shape) {
      mask = makeCellMask ({{0, 1, 2}, {0, 2, 3}}, uv);
      const double top = std::max ({uv[0].y (), uv[1].y (), uv[2].y (), uv[3].y ()});
      for (Eigen::Vector2d& p : uv)
        p = Eigen::Vector2d (top - p.y (), p.x ());
    }
    cells += shape[0].cells;
    shapes.push_back (shape);
  }
  const CellPacking packing = packCells (shapes, 4, 1);
  std::set<std::pair<Index, Index>> taken;
  for (std::size_t i = 0; i < shapes.size (); ++i) {
    const CellPlace& place = packing.places[i];
    for (const auto& [x, y] : cellsOf (shapes[i][place.quarters])) {
      EXPECT_TRUE (taken.insert ({place.x + x, place.y + y}).second);
      EXPECT_LT (place.x + x, packing.side);
      EXPECT_LT (place.y + y, packing.side);
    }
  }
  EXPECT_GT (static_cast<double> (cells), 0.8 * packing.side * packing.side);
}

TEST (Rounding, NothingToDo)
{
  std::vector<Eigen::Vector2f> uv{{0, 0}, {1, 0}, {0, 1}};
  EXPECT_EQ (repairRounding ({{0, 1, 2}}, uv), 0U);
  EXPECT_EQ (uv, (std::vector<Eigen::Vector2f>{{0, 0}, {1, 0}, {0, 1}}));
}

// The inner points of a grid that is only some steps of single precision wide.
TEST (Rounding, FlippedTrianglesAreRighted)
{
  constexpr Index SIDE = 6;
  constexpr float STEP = 0x1p-24F;
  RandomStream random (2);
  std::vector<Eigen::Vector2f> uv;
  std::vector<Triangle> triangles;
  for (Index y = 0; y <= SIDE; ++y)
    for (Index x = 0; x <= SIDE; ++x) {
      const bool is_inner = x > 0 && y > 0 && x < SIDE && y < SIDE;
      const auto at = [&] (Index i) {
        return 0.5F +
               STEP *
                   (8.0F * static_cast<float> (i) +
                    (is_inner ? std::round (12.0F * (static_cast<float> (random.uniform ()) - 0.5F))
                              : 0.0F));
      };
      uv.emplace_back (at (x), at (y));
    }
  for (Index y = 0; y < SIDE; ++y)
    for (Index x = 0; x < SIDE; ++x) {
      const Index a = y * (SIDE + 1) + x, c = a + SIDE + 1;
      triangles.push_back ({a, a + 1, c + 1});
      triangles.push_back ({a, c + 1, c});
    }
  const auto overlaps = [&] {
    std::vector<std::array<Eigen::Vector2f, 3>> corners;
    for (const Triangle& t : triangles)
      corners.push_back ({uv[t[0]], uv[t[1]], uv[t[2]]});
    return samples::countOverlaps (corners);
  };
  EXPECT_GT (overlaps (), 0U);
  EXPECT_EQ (repairRounding (triangles, uv), 0U);
  EXPECT_EQ (overlaps (), 0U);
}

// Where there is no room, the number is told.
TEST (Rounding, WhatCannotBeRightedIsCounted)
{
  std::vector<Eigen::Vector2f> uv{{0, 0}, {1, 0}, {1, 1}, {0.5, -0.5}};
  // The last triangle is upside down by far, whichever corner moves a little.
  EXPECT_EQ (repairRounding ({{0, 1, 2}, {0, 1, 3}}, uv), 1U);
}

} // namespace
} // namespace pcl::floater

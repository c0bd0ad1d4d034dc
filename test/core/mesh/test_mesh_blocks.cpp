// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/mesh_blocks.h"

#include "mesh/fold_repair.h"
#include "mesh/known_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace pcl::floater {
namespace {
constexpr Index BLOCKS_SIDE = 150; // 22,500 points: six blocks

// A bumpy sheet, row by row.
struct BumpySheet
{
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3f> normals;
  TriangleMesh mesh;

  BumpySheet ()
  {
    RandomStream random (7);
    const samples::Mesh sheet =
        samples::cells (BLOCKS_SIDE - 1, BLOCKS_SIDE - 1, [&random] (Index x, Index y) {
          return Eigen::Vector3d (x + 0.5 * random.uniform (), y + 0.5 * random.uniform (),
                                  0.2 * random.uniform ());
        });
    positions = sheet.positions;
    normals.assign (positions.size (), Eigen::Vector3f::UnitZ ());
    mesh = samples::connected (sheet);
  }
};

// Up to 24 points around each one.
CsrLists
neighborsInGrid ()
{
  return makeCsrLists (BLOCKS_SIDE * BLOCKS_SIDE, [] (const auto& emit) {
    for (Index p = 0; p < BLOCKS_SIDE * BLOCKS_SIDE; ++p) {
      const Index x = p % BLOCKS_SIDE, y = p / BLOCKS_SIDE;
      for (Index v = std::max (y, 2U) - 2; v <= std::min (y + 2, BLOCKS_SIDE - 1); ++v)
        for (Index u = std::max (x, 2U) - 2; u <= std::min (x + 2, BLOCKS_SIDE - 1); ++u)
          if (u != x || v != y)
            emit (p, v * BLOCKS_SIDE + u);
    }
  });
}

TEST (MeshBlocks, FlipsEndWhereNoFlipIsBetter)
{
  const BumpySheet sheet;
  const TriangleCost cost (sheet.positions, sheet.normals);
  TriangleMesh mesh = sheet.mesh;
  EXPECT_GT (flipEdges (mesh, cost, 2), 1000U);
  EXPECT_EQ (flipEdges (mesh, cost, 1), 0U);
  samples::expectDisc (mesh, sheet.positions.size ());
}

TEST (MeshBlocks, MovesRepairInBlocksAndBetweenThem)
{
  BumpySheet sheet;
  const TriangleCost cost (sheet.positions, sheet.normals);
  flipEdges (sheet.mesh, cost, 1);
  // In the middle of a block, two rows apart; across the end of the first block, at point 4096; and
  // beside that end.
  for (const auto& [p, q] :
       {std::pair<Index, Index>{2050, 2350}, {4095, 4096}, {4000, 4150}, {12010, 12312}})
    samples::exchange (sheet.mesh, p, q);
  TriangleMesh& mesh = sheet.mesh;
  EXPECT_GT (findFolds (mesh, sheet.positions, 1).size (), 8U);
  EXPECT_GT (moveVertices (mesh, neighborsInGrid (), cost, sheet.positions, {}, 2), 4U);
  EXPECT_TRUE (findFolds (mesh, sheet.positions, 1).empty ());
  samples::expectDisc (mesh, sheet.positions.size ());
}

} // namespace
} // namespace pcl::floater

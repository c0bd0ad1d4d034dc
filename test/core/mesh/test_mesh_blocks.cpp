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

bool
isAtBorder (Index p)
{
  const Index x = p % BLOCKS_SIDE, y = p / BLOCKS_SIDE;
  return x == 0 || y == 0 || x == BLOCKS_SIDE - 1 || y == BLOCKS_SIDE - 1;
}

TEST (MeshBlocks, AreTheSameMeshWhereTheyAreFreeAndArePutBackAsTheyWere)
{
  const BumpySheet sheet;
  TriangleMesh mesh = sheet.mesh;
  const MeshBlocks blocks (mesh, 2);
  ASSERT_EQ (blocks.count (), 6U);
  std::size_t free_triangles = 0;
  for (std::size_t b = 0; b < blocks.count (); ++b) {
    const MeshBlock block = blocks.cutOut (mesh, b);
    ASSERT_EQ (block.first, blocks.first (b));
    ASSERT_EQ (block.mesh.triangle_of.size (), blocks.last (b) - blocks.first (b));
    for (Index t = 0; t < block.mesh.triangles.size (); ++t) {
      if (!block.mesh.isFree (t))
        continue;
      ++free_triangles;
      for (std::uint8_t side = 0; side < 3; ++side) {
        // Across every edge is a triangle, or the boundary of the whole mesh.
        const MeshEdge e{t, side};
        if (block.mesh.mate (e).triangle == NONE) {
          EXPECT_TRUE (isAtBorder (block.first + block.mesh.from (e)) &&
                       isAtBorder (block.first + block.mesh.to (e)));
        }
      }
    }
    // Edges are known but between two points of which triangles are missing.
    for (Index p = 0; p + 1 < block.mesh.triangle_of.size (); ++p)
      for (const Index step :
           {Index{1}, BLOCKS_SIDE - 1, BLOCKS_SIDE, BLOCKS_SIDE + 1, 2 * BLOCKS_SIDE}) {
        const Index q = p + step;
        if (q >= block.mesh.triangle_of.size () || block.mesh.triangle_of[p] == NONE ||
            block.mesh.triangle_of[q] == NONE)
          continue;
        const bool are_partial = block.mesh.isPartial (p) && block.mesh.isPartial (q);
        EXPECT_EQ (block.mesh.hasEdge (p, q),
                   are_partial || mesh.hasEdge (block.first + p, block.first + q));
      }
    blocks.putBack (block, b, mesh);
  }
  EXPECT_TRUE (mesh.triangles == sheet.mesh.triangles);
  samples::expectConsistent (mesh);
  EXPECT_GT (free_triangles, mesh.triangles.size () * 8 / 10);
  EXPECT_LT (free_triangles, mesh.triangles.size ());
}

TEST (MeshBlocks, SmallMeshesAreOneBlock)
{
  TriangleMesh mesh;
  EXPECT_EQ (MeshBlocks (mesh, 1).count (), 0U);
  mesh = samples::connected ({{0, 1, 2}}, 4096);
  EXPECT_EQ (MeshBlocks (mesh, 1).count (), 1U);
  ASSERT_TRUE (mesh.connect (4097, 1));
  EXPECT_EQ (MeshBlocks (mesh, 1).count (), 2U);
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

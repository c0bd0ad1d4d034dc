// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/fold_repair.h"
#include "mesh/mesh_blocks.h"
#include "mesh_oracle.h"
#include "random_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

using namespace pcl::floater;

namespace {
constexpr Index BLOCKS_SIDE = 150; // 22,500 points: six blocks

// A bumpy sheet, row by row; its cells are cut along a diagonal at random.
struct RandomSheet
{
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3f> normals;
  TriangleMesh mesh;
  CsrLists neighbors; // of each point: up to 24 around it

  static Index at (Index x, Index y) { return y * BLOCKS_SIDE + x; }

  RandomSheet ()
  {
    RandomStream random (7);
    for (Index y = 0; y < BLOCKS_SIDE; ++y)
      for (Index x = 0; x < BLOCKS_SIDE; ++x)
        positions.emplace_back (x + 0.5 * random.uniform (), y + 0.5 * random.uniform (),
                                0.2 * random.uniform ());
    normals.assign (positions.size (), Eigen::Vector3f::UnitZ ());
    for (Index y = 0; y + 1 < BLOCKS_SIDE; ++y)
      for (Index x = 0; x + 1 < BLOCKS_SIDE; ++x) {
        const Index a = at (x, y), b = at (x + 1, y), c = at (x + 1, y + 1), d = at (x, y + 1);
        if (random.uniform () < 0.5) {
          mesh.triangles.push_back ({a, b, c});
          mesh.triangles.push_back ({a, c, d});
        }
        else {
          mesh.triangles.push_back ({a, b, d});
          mesh.triangles.push_back ({b, c, d});
        }
      }
    EXPECT_TRUE (mesh.connect (positions.size (), 1));
    neighbors = makeCsrLists (positions.size (), [] (const auto& emit) {
      for (Index y = 0; y < BLOCKS_SIDE; ++y)
        for (Index x = 0; x < BLOCKS_SIDE; ++x)
          for (Index v = std::max (y, 2U) - 2; v <= std::min (y + 2, BLOCKS_SIDE - 1); ++v)
            for (Index u = std::max (x, 2U) - 2; u <= std::min (x + 2, BLOCKS_SIDE - 1); ++u)
              if (u != x || v != y)
                emit (at (x, y), at (u, v));
    });
  }

  // Exchanges the places of two points in the mesh, but not in space.
  void exchange (Index p, Index q)
  {
    for (Triangle& t : mesh.triangles)
      for (Index& corner : t)
        corner = corner == p ? q : corner == q ? p : corner;
    EXPECT_TRUE (mesh.connect (positions.size (), 1));
  }
};

bool
isSame (const TriangleMesh& mesh, const TriangleMesh& other)
{
  return mesh.triangles == other.triangles && mesh.neighbors == other.neighbors;
}

TEST (MeshBlocks, CutOutAndPutBackChangeNothing)
{
  const RandomSheet sheet;
  TriangleMesh mesh = sheet.mesh;
  const MeshBlocks blocks (mesh, 2);
  ASSERT_EQ (blocks.count (), 6U);
  for (std::size_t b = 0; b < blocks.count (); ++b)
    blocks.putBack (blocks.cutOut (mesh, b), b, mesh);
  EXPECT_TRUE (isSame (mesh, sheet.mesh));
  for (Index p = 0; p < mesh.triangle_of.size (); ++p) {
    const Triangle& t = mesh.triangles[mesh.triangle_of[p]];
    EXPECT_NE (std::find (t.begin (), t.end (), p), t.end ());
  }
}

TEST (MeshBlocks, AreTheSameMeshWhereTheyAreFree)
{
  const RandomSheet sheet;
  const TriangleMesh& mesh = sheet.mesh;
  const MeshBlocks blocks (mesh, 1);
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
        // Across every edge is the same point as in the whole mesh, or a boundary.
        const Index from = block.first + block.mesh.from ({t, side});
        const Index to = block.first + block.mesh.to ({t, side});
        const MeshEdge across = block.mesh.mate ({t, side});
        const bool is_border = from / BLOCKS_SIDE == 0 || from % BLOCKS_SIDE == 0 ||
                               to / BLOCKS_SIDE == BLOCKS_SIDE - 1 ||
                               to % BLOCKS_SIDE == BLOCKS_SIDE - 1 || to / BLOCKS_SIDE == 0 ||
                               to % BLOCKS_SIDE == 0 || from / BLOCKS_SIDE == BLOCKS_SIDE - 1 ||
                               from % BLOCKS_SIDE == BLOCKS_SIDE - 1;
        EXPECT_TRUE (across.triangle != NONE || is_border);
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
        if (block.mesh.isPartial (p) && block.mesh.isPartial (q))
          EXPECT_TRUE (block.mesh.hasEdge (p, q));
        else
          EXPECT_EQ (block.mesh.hasEdge (p, q), mesh.hasEdge (block.first + p, block.first + q));
      }
  }
  EXPECT_GT (free_triangles, mesh.triangles.size () * 8 / 10);
  EXPECT_LT (free_triangles, mesh.triangles.size ());
}

TEST (MeshBlocks, SmallMeshesAreOneBlock)
{
  TriangleMesh mesh;
  EXPECT_EQ (MeshBlocks (mesh, 1).count (), 0U);
  mesh.triangles = {{0, 1, 2}};
  ASSERT_TRUE (mesh.connect (4096, 1));
  EXPECT_EQ (MeshBlocks (mesh, 1).count (), 1U);
  ASSERT_TRUE (mesh.connect (4097, 1));
  EXPECT_EQ (MeshBlocks (mesh, 1).count (), 2U);
}

TEST (MeshBlocks, FlipsEndWhereNoFlipIsBetter)
{
  const RandomSheet sheet;
  const TriangleCost cost (sheet.positions, sheet.normals);
  TriangleMesh mesh = sheet.mesh, by_four = sheet.mesh;
  EXPECT_GT (flipEdges (mesh, cost, 1), 1000U);
  EXPECT_EQ (flipEdges (mesh, cost, 1), 0U);
  const samples::Topology topology = samples::topologyOf (mesh.triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (topology.euler, 1);
  flipEdges (by_four, cost, 4);
  EXPECT_TRUE (isSame (mesh, by_four));
}

TEST (MeshBlocks, MovesRepairInBlocksAndBetweenThem)
{
  RandomSheet sheet;
  const TriangleCost cost (sheet.positions, sheet.normals);
  flipEdges (sheet.mesh, cost, 1);
  // In the middle of a block, two rows apart; across the end of the first block, at point 4096; and
  // beside that end.
  for (const auto& [p, q] :
       {std::pair<Index, Index>{2050, 2350}, {4095, 4096}, {4000, 4150}, {12010, 12312}})
    sheet.exchange (p, q);
  TriangleMesh mesh = sheet.mesh, by_four = sheet.mesh;
  EXPECT_GT (findFolds (mesh, sheet.positions, 1).size (), 8U);
  EXPECT_GT (moveVertices (mesh, sheet.neighbors, {}, cost, sheet.positions, {}, 1), 4U);
  EXPECT_TRUE (findFolds (mesh, sheet.positions, 1).empty ());
  const samples::Topology topology = samples::topologyOf (mesh.triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (topology.vertices, sheet.positions.size ());
  EXPECT_EQ (topology.euler, 1);
  moveVertices (by_four, sheet.neighbors, {}, cost, sheet.positions, {}, 4);
  EXPECT_TRUE (isSame (mesh, by_four));
}

} // namespace

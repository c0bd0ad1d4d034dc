// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Vertices taken out and put back elsewhere: undone changes, moves, kicks.
#include "mesh/fold_repair.h"

#include "mesh/vertex_mover.h"
#include "samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::Positions;

constexpr Index GRID_SIDE = 9; // points along a grid
constexpr std::size_t LARGEST_FAN = RepairLimits{}.largest_fan;

// Points of a jittered square grid with spacing 1.
Positions
gridPoints (double z, std::uint64_t seed)
{
  RandomStream random (seed);
  Positions positions;
  for (Index y = 0; y < GRID_SIDE; ++y)
    for (Index x = 0; x < GRID_SIDE; ++x)
      positions.emplace_back (x + 0.2 * random.uniform (), y + 0.2 * random.uniform (), z);
  return positions;
}

std::vector<Triangle>
sheetTriangles (Index first)
{
  std::vector<Triangle> triangles;
  for (Index y = 0; y + 1 < GRID_SIDE; ++y)
    for (Index x = 0; x + 1 < GRID_SIDE; ++x) {
      const Index a = first + y * GRID_SIDE + x, b = a + 1, c = a + GRID_SIDE, d = c + 1;
      triangles.push_back ({a, b, d});
      triangles.push_back ({a, d, c});
    }
  return triangles;
}

// Lower and upper sheet, one above the other; both face upward.
struct Sheets
{
  Positions positions;
  std::vector<Eigen::Vector3f> normals;
  CsrLists neighbors; // 12 nearest of each point, by comparing all
  TriangleMesh mesh;

  Sheets (double gap, std::uint64_t seed)
  {
    positions = gridPoints (0.0, seed);
    const Positions upper = gridPoints (gap, seed + 1);
    mesh.triangles = sheetTriangles (0);
    const std::vector<Triangle> more = sheetTriangles (static_cast<Index> (positions.size ()));
    mesh.triangles.insert (mesh.triangles.end (), more.begin (), more.end ());
    positions.insert (positions.end (), upper.begin (), upper.end ());
    normals.assign (positions.size (), Eigen::Vector3f::UnitZ ());
    EXPECT_TRUE (mesh.connect (positions.size (), 1));
    neighbors.offsets.push_back (0);
    for (const Eigen::Vector3d& p : positions) {
      std::vector<Index> order = samples::indices (positions.size ());
      std::sort (order.begin (), order.end (), [&] (Index a, Index b) {
        return (positions[a] - p).squaredNorm () < (positions[b] - p).squaredNorm ();
      });
      neighbors.ids.insert (neighbors.ids.end (), order.begin () + 1, order.begin () + 13);
      neighbors.offsets.push_back (static_cast<Index> (neighbors.ids.size ()));
    }
  }

  // Makes two vertices change places.
  void swap (Index p, Index q)
  {
    for (Triangle& t : mesh.triangles)
      for (Index& corner : t)
        corner = corner == p ? q : corner == q ? p : corner;
    EXPECT_TRUE (mesh.connect (positions.size (), 1));
  }

  // Makes random vertices change places, across sheets or not.
  void mixUp (std::size_t times, std::uint64_t seed)
  {
    RandomStream random (seed);
    const auto inner = [&random] { return static_cast<Index> (2 + random.below (GRID_SIDE - 4)); };
    for (std::size_t i = 0; i < times; ++i) {
      const Index row_a = inner (), a = row_a * GRID_SIDE + inner ();
      const Index row_b = inner (), column_b = inner ();
      const Index b = row_b * GRID_SIDE + column_b +
                      static_cast<Index> (GRID_SIDE * GRID_SIDE * random.below (2));
      if (a != b && (positions[a] - positions[b]).norm () < 2.5)
        swap (a, b);
    }
  }

  // True if no edge joins the sheets.
  bool areApart () const
  {
    const std::size_t half = positions.size () / 2;
    return std::all_of (mesh.triangles.begin (), mesh.triangles.end (), [half] (const Triangle& t) {
      return (t[0] < half) == (t[1] < half) && (t[0] < half) == (t[2] < half);
    });
  }
};

void
moveWhileItHelps (Sheets& sheets, const TriangleCost& cost)
{
  VertexMover mover (sheets.mesh, sheets.neighbors, cost, LARGEST_FAN, 1);
  for (bool moved = true; moved;) {
    moved = false;
    for (Index v = 0; v < sheets.positions.size (); ++v) {
      mover.start ();
      moved |= mover.move (v, 16) < 0.0;
    }
  }
}

// Of all triangles and edges.
double
costOfMesh (const TriangleMesh& mesh, const TriangleCost& cost)
{
  double sum = 0.0;
  for (Index t = 0; t < mesh.triangles.size (); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    sum += cost (a, b, c);
    for (Index u : mesh.neighbors[t])
      if (u != NONE && t < u)
        sum += cost.ofEdge (
            cost.value (a, b, c).unit_normal,
            cost.value (mesh.triangles[u][0], mesh.triangles[u][1], mesh.triangles[u][2])
                .unit_normal);
  }
  return sum;
}

void
expectConsistent (const TriangleMesh& mesh, std::size_t vertices)
{
  TriangleMesh fresh;
  fresh.triangles = mesh.triangles;
  ASSERT_TRUE (fresh.connect (mesh.triangle_of.size (), 1));
  EXPECT_EQ (fresh.neighbors, mesh.neighbors);
  const samples::Topology topology = samples::topologyOf (mesh.triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (topology.vertices, vertices);
}

TEST (FoldRepair, ReplacedFansKeepAManifold)
{
  Sheets sheets (5.0, 1);
  const Index p = 4 * GRID_SIDE + 4;
  std::vector<Index> fan, ring;
  sheets.mesh.fan (p, fan);
  for (Index t : fan)
    ring.push_back (sheets.mesh.from ({t, sheets.mesh.sideOf (t, p)}));
  ASSERT_EQ (ring.size (), 6U);
  std::vector<Triangle> filling;
  for (std::size_t i = 1; i + 1 < ring.size (); ++i)
    filling.push_back ({ring[0], ring[i], ring[i + 1]});
  sheets.mesh.replaceFan (p, fan, filling);
  EXPECT_EQ (sheets.mesh.triangle_of[p], NONE);
  for (std::size_t i = 2; i + 1 < ring.size (); ++i)
    EXPECT_TRUE (sheets.mesh.hasEdge (ring[0], ring[i]));
  // Back in, on the other sheet.
  sheets.mesh.split (sheets.mesh.triangle_of[GRID_SIDE * GRID_SIDE + p], p, fan[4], fan[5]);
  expectConsistent (sheets.mesh, sheets.positions.size ());
}

TEST (FoldRepair, UndoneChangesLeaveNoTrace)
{
  Sheets sheets (1.0, 3);
  RandomStream random (4);
  for (Eigen::Vector3d& p : sheets.positions)
    p.z () += 0.3 * random.normal ();
  const TriangleCost cost (sheets.positions, sheets.normals);
  TriangleMesh& mesh = sheets.mesh;
  const TriangleMesh before = mesh;
  VertexMover mover (mesh, sheets.neighbors, cost, LARGEST_FAN, 1);
  std::size_t changed = 0;
  for (Index v = 0; v < sheets.positions.size (); v += 7)
    for (const VertexMover::Place& place : mover.placesFor (v, 6)) {
      ASSERT_EQ (mesh.triangles, before.triangles) << "the search for places left a trace";
      mover.start ();
      double change = mover.moveTo (v, place);
      for (Index q : sheets.neighbors.row (v))
        change += mover.move (q, 2);
      EXPECT_NEAR (costOfMesh (mesh, cost) - costOfMesh (before, cost), change, 1e-6);
      expectConsistent (mesh, sheets.positions.size ());
      changed += mesh.triangles != before.triangles ? 1 : 0;
      mover.undo ();
      ASSERT_EQ (mesh.triangles, before.triangles);
      ASSERT_EQ (mesh.neighbors, before.neighbors);
      ASSERT_EQ (mesh.triangle_of, before.triangle_of);
    }
  EXPECT_GT (changed, 50U);
}

TEST (FoldRepair, PatchesAreTakenOutAndPutBack)
{
  Sheets sheets (1.0, 8);
  const TriangleCost cost (sheets.positions, sheets.normals);
  TriangleMesh& mesh = sheets.mesh;
  const TriangleMesh before = mesh;
  VertexMover mover (mesh, sheets.neighbors, cost, LARGEST_FAN, 1);
  std::size_t rebuilt = 0;
  for (Index first = 0; first + 3 * GRID_SIDE < GRID_SIDE * GRID_SIDE; first += 5) {
    mover.start ();
    const std::vector<Index> patch{first,
                                   first + 1,
                                   first + GRID_SIDE,
                                   first + GRID_SIDE + 1,
                                   first + GRID_SIDE + 2,
                                   first + 2 * GRID_SIDE,
                                   first + GRID_SIDE * GRID_SIDE};
    double change = 0.0;
    if (mover.rebuild (patch, change)) {
      ++rebuilt;
      EXPECT_NEAR (costOfMesh (mesh, cost) - costOfMesh (before, cost), change, 1e-6);
      expectConsistent (mesh, sheets.positions.size ());
    }
    mover.undo ();
    ASSERT_EQ (mesh.triangles, before.triangles);
    ASSERT_EQ (mesh.neighbors, before.neighbors);
    ASSERT_EQ (mesh.triangle_of, before.triangle_of);
  }
  EXPECT_GT (rebuilt, 5U);
}

TEST (FoldRepair, TheBoundaryStays)
{
  Sheets sheets (5.0, 5);
  const TriangleCost cost (sheets.positions, sheets.normals);
  VertexMover mover (sheets.mesh, sheets.neighbors, cost, LARGEST_FAN, 1);
  for (Index x = 0; x < GRID_SIDE; ++x) {
    EXPECT_TRUE (mover.placesFor (x, 16).empty ());
    EXPECT_EQ (mover.move (x * GRID_SIDE, 16), 0.0);
  }
  EXPECT_EQ (sheets.mesh.mark (), 0U);
}

TEST (FoldRepair, AVertexOfTheWrongSheetGoesBack)
{
  Sheets sheets (2.0, 6);
  const Index p = GRID_SIDE * GRID_SIDE + 4 * GRID_SIDE + 4;
  std::vector<Index> fan, ring;
  sheets.mesh.fan (p, fan);
  for (Index t : fan)
    ring.push_back (sheets.mesh.from ({t, sheets.mesh.sideOf (t, p)}));
  std::vector<Triangle> filling;
  for (std::size_t i = 1; i + 1 < ring.size (); ++i)
    filling.push_back ({ring[0], ring[i], ring[i + 1]});
  sheets.mesh.replaceFan (p, fan, filling);
  sheets.mesh.split (sheets.mesh.triangle_of[4 * GRID_SIDE + 4], p, fan[4], fan[5]);
  ASSERT_FALSE (sheets.areApart ());
  const TriangleCost cost (sheets.positions, sheets.normals);
  EXPECT_GT (moveVertices (sheets.mesh, sheets.neighbors, {}, cost, sheets.positions, {}, 1), 0U);
  EXPECT_TRUE (sheets.areApart ());
  EXPECT_TRUE (findFolds (sheets.mesh, sheets.positions, 1).empty ());
  expectConsistent (sheets.mesh, sheets.positions.size ());
  // Changes are no longer recorded.
  sheets.mesh.flip ({fan[0], sheets.mesh.sideOf (fan[0], ring[0])});
  EXPECT_EQ (sheets.mesh.mark (), 0U);
}

TEST (FoldRepair, KicksRemoveFoldsThatNoSingleMoveRemoves)
{
  // Vertices are exchanged at random between close sheets. Moves leave a fold for a few seeds only,
  // and kicks remove it for six of the first seven of these.
  for (const std::uint64_t seed : {11U, 37U, 42U, 110U, 114U}) {
    SCOPED_TRACE (seed);
    Sheets sheets (0.6 + 0.2 * static_cast<double> (seed % 6), 10 + seed);
    sheets.mixUp (1 + seed % 4, seed);
    const TriangleCost cost (sheets.positions, sheets.normals);
    flipEdges (sheets.mesh, cost, 1);
    moveWhileItHelps (sheets, cost);
    EXPECT_EQ (findFolds (sheets.mesh, sheets.positions, 1).size (), 1U);
    const double before = costOfMesh (sheets.mesh, cost);
    EXPECT_GT (moveVertices (sheets.mesh, sheets.neighbors, {}, cost, sheets.positions, {}, 1), 0U);
    EXPECT_TRUE (findFolds (sheets.mesh, sheets.positions, 1).empty ());
    EXPECT_LT (costOfMesh (sheets.mesh, cost), before);
    expectConsistent (sheets.mesh, sheets.positions.size ());
  }
}

// Where every point is in the wrong triangles, the work is limited, and each part of it by itself.
TEST (FoldRepair, EndsWhenItHasAskedForAllItsCosts)
{
  const auto repair = [] (std::size_t of_moves, std::size_t of_kicks) {
    Sheets sheets (0.8, 47);
    sheets.mixUp (40, 37);
    const TriangleCost cost (sheets.positions, sheets.normals);
    flipEdges (sheets.mesh, cost, 1);
    RepairLimits limits;
    limits.fewest_costs = 0;
    limits.costs_of_moves = of_moves;
    limits.costs_of_kicks = of_kicks;
    const std::size_t changes =
        moveVertices (sheets.mesh, sheets.neighbors, {}, cost, sheets.positions, limits, 1);
    expectConsistent (sheets.mesh, sheets.positions.size ());
    return changes;
  };
  constexpr std::size_t MANY = 1'000'000;
  EXPECT_EQ (repair (0, 0), 0U);
  const std::size_t few = repair (100, 0), moves = repair (MANY, 0);
  EXPECT_GT (few, 0U);
  EXPECT_LT (few, moves);
  EXPECT_GT (repair (0, MANY), 0U);
}

TEST (FoldRepair, NothingIsMovedInScatter)
{
  Sheets sheets (0.8, 47);
  sheets.mixUp (2, 37);
  const TriangleCost cost (sheets.positions, sheets.normals);
  flipEdges (sheets.mesh, cost, 1);
  const std::vector<Triangle> before = sheets.mesh.triangles;
  ASSERT_GT (findFolds (sheets.mesh, sheets.positions, 1).size (), 0U);
  std::vector<Index> scatter;
  for (Index p = 0; p < sheets.positions.size (); ++p)
    if (p % 3 > 0)
      scatter.push_back (p);
  const auto repair = [&] {
    return moveVertices (sheets.mesh, sheets.neighbors, scatter, cost, sheets.positions, {}, 1);
  };
  EXPECT_EQ (repair (), 0U);
  EXPECT_EQ (sheets.mesh.triangles, before);
  scatter.resize (scatter.size () / 2); // not most points any more
  EXPECT_GT (repair (), 0U);
}

TEST (FoldRepair, CachedCostsAreTheCosts)
{
  // More triangles than the table holds, asked for again and again, from any corner on.
  const Positions positions = samples::randomPoints (40, 7);
  const std::vector<Eigen::Vector3f> normals (positions.size (), Eigen::Vector3f::UnitZ ());
  const TriangleCost cost (positions, normals);
  CachedCost cached (cost);
  RandomStream random (8);
  for (int i = 0; i < 100000; ++i) {
    const auto a = static_cast<Index> (random.below (38));
    const auto b = static_cast<Index> (a + 1 + random.below (38 - a));
    const auto c = static_cast<Index> (b + 1 + random.below (39 - b));
    const Triangle corners = i % 3 == 0   ? Triangle{a, b, c}
                             : i % 3 == 1 ? Triangle{c, a, b}
                                          : Triangle{b, a, c};
    const TriangleCost::Value value = cached (corners);
    ASSERT_EQ (value.cost, cost (corners));
    ASSERT_EQ (value.unit_normal, cost.value (corners[0], corners[1], corners[2]).unit_normal);
  }
}

} // namespace
} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Vertices taken out and put back elsewhere, undone changes; repair of folds and of triangles that cross; the ridges
// that it keeps. What is done with missing points, and what the end of a mesh repairs.
#include "mesh/flaw_repair.h"

#include "floater/planar_delaunay.h"
#include "mesh/finish.h"
#include "mesh/flips.h"
#include "mesh/folds.h"
#include "mesh/known_meshes.h"
#include "mesh/vertex_mover.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;

constexpr Index GRID_SIDE = 9; // points along a grid
constexpr Index SHEET_POINTS = GRID_SIDE * GRID_SIDE;

// A jittered square grid with spacing 1.
Mesh
jittered (double z, std::uint64_t seed)
{
  RandomStream random (seed);
  return cells (GRID_SIDE - 1, GRID_SIDE - 1, [&] (Index x, Index y) {
    const double dy = 0.2 * random.uniform ();
    return Eigen::Vector3d (x + 0.2 * random.uniform (), y + dy, z);
  });
}

struct Sheets : TwoSheets
{
  TriangleCost cost;

  Sheets (double gap, std::uint64_t seed)
      : TwoSheets (jittered (0.0, seed), jittered (gap, seed + 1), 12), cost (positions, normals)
  {
  }

  // Makes random vertices change places, across sheets or not.
  void mixUp (std::size_t times, std::uint64_t seed)
  {
    RandomStream random (seed);
    const auto inner = [&random] { return static_cast<Index> (2 + random.below (GRID_SIDE - 4)); };
    for (std::size_t i = 0; i < times; ++i) {
      const Index row_a = inner (), a = row_a * GRID_SIDE + inner ();
      const Index row_b = inner (), column_b = inner ();
      const Index b =
          row_b * GRID_SIDE + column_b + static_cast<Index> (SHEET_POINTS * random.below (2));
      if (a != b && (positions[a] - positions[b]).norm () < 2.5)
        exchange (mesh, a, b);
    }
  }

  std::size_t folds () const { return findFolds (mesh, positions, 1).size (); }

  CrossingPairs crossing () const { return findSelfIntersections (mesh.triangles, positions, 1); }

  // Of all triangles and edges.
  double costOfMesh () const
  {
    const auto normalOf = [this] (const Triangle& t) {
      return cost (t[0], t[1], t[2]).unit_normal;
    };
    double sum = 0.0;
    for (Index t = 0; t < mesh.triangles.size (); ++t) {
      const Triangle& corners = mesh.triangles[t];
      sum += cost (corners[0], corners[1], corners[2]).cost;
      for (Index u : mesh.neighbors[t])
        if (u != NONE && t < u)
          sum += cost.ofEdge (normalOf (corners), normalOf (mesh.triangles[u]));
    }
    return sum;
  }

  // Expects two discs of all points, and what is told of the pairs that are left.
  Repairs repair (const RepairLimits& limits = {}, Repair when = Repair::BEFORE_REMAKING,
                  const Flags& is_settled = {})
  {
    CrossingPairs pairs = crossing ();
    const Repairs done =
        repairFlaws (mesh, pairs, neighbors, cost, positions, when, {}, is_settled, limits, 1);
    EXPECT_EQ (pairs, crossing ());
    expectConsistent (mesh);
    expectTopology (mesh.triangles, positions.size (), 2, 2, 2);
    return done;
  }
};

TEST (FlawRepair, ChangesAreConsistentAndAreUndoneWithoutATrace)
{
  Sheets sheets (1.0, 3);
  RandomStream random (4);
  for (Eigen::Vector3d& p : sheets.positions)
    p.z () += 0.3 * random.normal ();
  TriangleMesh& mesh = sheets.mesh;
  const TriangleMesh before = mesh;
  VertexMover mover (mesh, sheets.positions, sheets.neighbors, sheets.cost, 1);
  const auto isChangedAndUndone = [&] {
    expectConsistent (mesh);
    const bool is_changed = mesh.triangles != before.triangles;
    mesh.undo (0);
    expectSame (mesh, before);
    return is_changed;
  };
  for (Index x = 0; x < GRID_SIDE; ++x) { // the boundary stays
    EXPECT_TRUE (mover.cutsFor (x).empty ());
    EXPECT_TRUE (mover.cutsFor (x * GRID_SIDE).empty ());
  }
  EXPECT_EQ (mesh.mark (), 0U);
  std::size_t moved = 0, rebuilt = 0;
  for (Index v = 0; v < sheets.positions.size (); v += 7)
    for (const Cut& cut : mover.cutsFor (v)) {
      ASSERT_EQ (mesh.triangles, before.triangles) << "the search for cuts left a trace";
      mesh.recordChanges ();
      mover.moveTo (v, cut);
      moved += isChangedAndUndone () ? 1 : 0;
    }
  EXPECT_GT (moved, 50U);
  for (Index first = 0; first + 3 * GRID_SIDE < SHEET_POINTS; first += 5) {
    mesh.recordChanges ();
    const Index next = first + GRID_SIDE; // in the row above
    if (mover.rebuild (
            {first, first + 1, next, next + 1, next + 2, next + GRID_SIDE, first + SHEET_POINTS})) {
      rebuilt += isChangedAndUndone () ? 1 : 0;
      continue;
    }
    mesh.undo (0);
    expectSame (mesh, before);
  }
  EXPECT_GT (rebuilt, 5U);
}

TEST (FlawRepair, RemovesFoldsBetweenSheetsWhoseVerticesAreMixedUp)
{
  // Vertices are exchanged at random between close sheets.
  std::size_t left = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE (seed);
    Sheets sheets (0.6 + 0.2 * static_cast<double> (seed % 6), 10 + seed);
    sheets.mixUp (1 + seed % 4, seed);
    flipEdges (sheets.mesh, sheets.cost, 1);
    const std::size_t folds = sheets.folds (), pairs = sheets.crossing ().size ();
    const double before = sheets.costOfMesh ();
    sheets.repair ();
    EXPECT_LE (sheets.folds (), folds);
    EXPECT_LE (sheets.crossing ().size (), pairs);
    EXPECT_LE (sheets.costOfMesh (), before);
    left += sheets.folds ();
  }
  EXPECT_EQ (left, 0U);
}

TEST (FlawRepair, RemovesTrianglesThatCrossByMovesAndChangesNothingElse)
{
  Sheets sheets (0.6, 8);
  for (const Index p : {30U, 50U})
    exchange (sheets.mesh, p, p + SHEET_POINTS);
  EXPECT_GE (sheets.crossing ().size (), 4U);
  const MeshTopology before = topologyOf (sheets.mesh.triangles);
  const Flags are_settled (sheets.positions.size (), 1);
  EXPECT_FALSE (sheets.repair ({}, Repair::AT_THE_END, are_settled).hasChanged ());
  const Repairs done = sheets.repair ({}, Repair::AT_THE_END);
  EXPECT_TRUE (sheets.crossing ().empty ());
  EXPECT_GE (done.moves + done.flips, 2U);
  EXPECT_EQ (sheets.folds (), 0U);
  EXPECT_EQ (topologyOf (sheets.mesh.triangles).loops, before.loops);
}

// Where flips and moves of single points no longer help, patches are taken out and put back.
TEST (FlawRepair, RemovesTrianglesThatCrossByPatchesWhereMovesDoNotHelp)
{
  RepairLimits moves_only;
  moves_only.rebuilt_orders = 0;
  std::size_t left_by_moves = 0, left = 0, rebuilds = 0;
  RandomStream random (12);
  for (int round = 0; round < 6; ++round) {
    Sheets by_moves (0.6, 8), sheets (0.6, 8);
    for (Index p = 0; p < SHEET_POINTS; ++p)
      if (random.uniform () < 0.2)
        for (Sheets* both : {&by_moves, &sheets})
          exchange (both->mesh, p, p + SHEET_POINTS);
    by_moves.repair (moves_only, Repair::AT_THE_END);
    left_by_moves += by_moves.crossing ().size ();
    rebuilds += sheets.repair ({}, Repair::AT_THE_END).rebuilds;
    left += sheets.crossing ().size ();
  }
  EXPECT_GT (rebuilds, 0U);
  EXPECT_LT (left, left_by_moves);
}

TEST (FlawRepair, AFoldIsFlippedUnlessThatMakesTrianglesCross)
{
  // A steep roof; flipped, it is a bent ribbon below. A third triangle stands under the roof.
  Positions positions{{-9, 0, 0}, {9, 0, 0},       {0, -1, -3},     {0, 1, -3},
                      {0, 0, 9},  {0.1, 0.1, 9.5}, {-0.1, 0.1, 9.5}};
  const std::vector<Triangle> roof{{0, 2, 1}, {0, 1, 3}, {4, 5, 6}};
  const CsrLists neighbors{std::vector<Index> (8, 0), {}};
  for (const bool is_in_the_way : {false, true}) {
    if (is_in_the_way)
      for (Index p = 4; p < 7; ++p)
        positions[p].z () = 7.0 - positions[p].z () * 1.1;
    TriangleMesh mesh = connected (roof, positions.size ());
    CrossingPairs crossing = findSelfIntersections (roof, positions, 1);
    ASSERT_TRUE (crossing.empty ());
    ASSERT_EQ (findFolds (mesh, positions, 1).size (), 1U);
    const std::vector<Eigen::Vector3f> normals (7, Eigen::Vector3f::Zero ());
    const Repairs done = repairFlaws (mesh, crossing, neighbors, TriangleCost (positions, normals),
                                      positions, Repair::AT_THE_END, {}, {}, {}, 1);
    EXPECT_EQ (done.flips, is_in_the_way ? 0U : 1U);
    EXPECT_TRUE (crossing.empty ());
    EXPECT_EQ (findFolds (mesh, positions, 1).size (), is_in_the_way ? 1U : 0U);
    EXPECT_EQ (mesh.triangles == roof, is_in_the_way);
    expectConsistent (mesh);
  }
}

TEST (FlawRepair, EndsWhenItHasMadeAllItsTests)
{
  const auto repair = [] (std::size_t fewest_tests) {
    Sheets sheets (0.8, 47);
    sheets.mixUp (40, 37);
    flipEdges (sheets.mesh, sheets.cost, 1);
    RepairLimits limits;
    limits.tests_per_triangle = 0;
    limits.fewest_tests = fewest_tests;
    return sheets.repair (limits);
  };
  EXPECT_FALSE (repair (0).hasChanged ());
  const Repairs few = repair (2000), all = repair (1'000'000);
  EXPECT_GT (few.flips, 0U);
  EXPECT_LT (few.flips + few.moves, all.flips + all.moves);
}

constexpr Index LENGTH = 6;

// A polygon (y, z), anti-clockwise, drawn along x; open at both ends. It faces outwards.
Mesh
tube (const std::vector<Eigen::Vector2d>& section)
{
  const auto place = [&section] (Index i, Index x) {
    const Eigen::Vector2d& p = section[i % section.size ()];
    return Eigen::Vector3d (x, p.x (), p.y ());
  };
  return cells (static_cast<Index> (section.size ()), LENGTH, place, true);
}

// An arrow head: three sharp ridges, and the notch at point 2.
Mesh
arrow ()
{
  return tube ({{4.0, 0.0}, {-1.0, 1.0}, {3.0, 0.0}, {-1.0, -1.0}});
}

// Ridges at points 0 and 4.
Mesh
blade ()
{
  const std::vector<Eigen::Vector2d> section{{2.0, 0.0},  {1.0, 0.15},   {0.0, 0.3},  {-1.0, 0.15},
                                             {-2.0, 0.0}, {-1.0, -0.15}, {0.0, -0.3}, {1.0, -0.15}};
  return tube (section);
}

Ridges
ridgesOf (const Mesh& mesh, const CrossingPairs& crossing = {}, std::uint8_t is_remade = 1)
{
  return findRidges (connected (mesh), mesh.positions, crossing,
                     std::vector<std::uint8_t> (mesh.positions.size (), is_remade), 1);
}

TEST (Ridges, AreSharpEdgesThatStickOut)
{
  Mesh mesh = arrow ();
  std::vector<std::array<Index, 2>> expected;
  for (Index x = 0; x < LENGTH; ++x)
    for (const Index corner : {0U, 1U, 3U})
      expected.push_back ({4 * x + corner, 4 * x + 4 + corner});
  EXPECT_EQ (ridgesOf (mesh).ends, expected);
  turnRound (mesh);
  EXPECT_EQ (ridgesOf (mesh).ends, expected) << "inside out";
  EXPECT_TRUE (ridgesOf (mesh).has (4, 0) && ridgesOf (mesh).has (0, 4));
  EXPECT_FALSE (ridgesOf (mesh).has (2, 6)) << "the notch";
}

TEST (Ridges, AreOnlyWhereTheMeshWasMadeInSpaceAndNothingCrosses)
{
  const Mesh mesh = arrow ();
  EXPECT_TRUE (ridgesOf (mesh, {}, 0).ends.empty ());
  EXPECT_TRUE (findRidges (connected (mesh), mesh.positions, {}, {}, 1).ends.empty ());
  CrossingPairs crossing;
  crossing.push_back ({1, 9}); // at points 0 and 4, and at 4 and 8
  const Ridges without = ridgesOf (mesh, crossing);
  EXPECT_FALSE (without.has (0, 4) || without.has (4, 8));
  EXPECT_TRUE (without.has (8, 12));
}

// The normals are those of a tangent plane of both sides of a blade: they tell nothing.
TEST (Ridges, AreKeptByTheRepair)
{
  const Mesh sharp = blade ();
  const Ridges ridges = ridgesOf (sharp);
  EXPECT_EQ (ridges.ends.size (), 2 * LENGTH);
  const CsrLists neighbors = nearestOf (sharp.positions, 20);
  const std::vector<Eigen::Vector3f> normals (sharp.positions.size (), Eigen::Vector3f::UnitZ ());
  const TriangleCost cost (sharp.positions, normals);
  for (const bool are_known : {true, false}) {
    TriangleMesh mesh = connected (sharp);
    CrossingPairs crossing;
    const Repairs done =
        repairFlaws (mesh, crossing, neighbors, cost, sharp.positions, Repair::BEFORE_REMAKING,
                     are_known ? ridges : Ridges{}, {}, {}, 1);
    EXPECT_TRUE (done.hasChanged ());
    EXPECT_EQ (std::all_of (ridges.ends.begin (), ridges.ends.end (),
                            [&] (const auto& ends) { return mesh.hasEdge (ends[0], ends[1]); }),
               are_known);
  }
}

TEST (Ridges, PointsThereGetTheNormalsOfTheMesh)
{
  const Mesh sharp = blade ();
  const std::size_t points = sharp.positions.size ();
  std::vector<std::uint8_t> is_remade (points, 1);
  is_remade[3] = 0;
  std::vector<Eigen::Vector3f> normals (points, -Eigen::Vector3f::UnitZ ());
  orientNormals (connected (sharp), sharp.positions, normals, 1, is_remade);
  for (Index p = 0; p < points; ++p)
    EXPECT_GT (normals[p].dot (Eigen::Vector3f (0.0F, static_cast<float> (sharp.positions[p].y ()),
                                                static_cast<float> (sharp.positions[p].z ()))
                                   .normalized ()),
               0.0F)
        << p;
  EXPECT_EQ (normals[3], Eigen::Vector3f::UnitZ ()) << "not made in space: only turned";
}

// A round sheet laid out as it is, some of whose inner points have no place in the plane.
TEST (MissingPoints, AllJoin)
{
  const double nowhere = std::numeric_limits<double>::quiet_NaN ();
  const Sheet sheet = disc (0.07, 7);
  const auto [points, geometry] = makeNeighborhoods (sheet.positions);
  std::vector<Index> loop (sheet.border);
  std::vector<Eigen::Vector2d> uv;
  RandomStream random (8);
  std::size_t missing = 0;
  for (Index p = 0; p < points.size (); ++p) {
    uv.emplace_back (points.positions[p].head<2> ());
    if (const Index at = points.cloud_index[p]; at < sheet.border)
      loop[at] = p;
    else if (random.uniform () < 0.2) {
      uv[p].setConstant (nowhere);
      ++missing;
    }
  }
  TriangleMesh mesh = triangulatePlane (uv, loop);
  const auto add = [&] { return addMissingPoints (mesh, points.positions, geometry.neighbors, 1); };
  EXPECT_EQ (add (), missing);
  expectDisc (mesh, points.size ());
  EXPECT_EQ (add (), 0U);
}

TEST (Finish, FindsAsManyCrossingPairsWithAndWithoutRepair)
{
  const Input input =
      asInput (generateSurface ({SurfaceKind::FOLDED_SHEET, 3000, 1, 1.0, 0.25, 0.0, 1.5}));
  Options options;
  const Report repaired = reconstruct (input, options).report;
  options.remove_self_intersections = false;
  const Report left = reconstruct (input, options).report;
  EXPECT_GT (left.check.self_intersections, 0U);
  EXPECT_EQ (left.statistics.self_intersections_found, left.check.self_intersections);
  EXPECT_EQ (repaired.statistics.self_intersections_found, left.check.self_intersections);
  EXPECT_LT (repaired.check.self_intersections, left.check.self_intersections);
  EXPECT_EQ (left.statistics.self_intersection_flips + left.statistics.remade_points, 0U);
}

// Noise is repaired once, after the points that lie on others are back.
TEST (Finish, NoiseOfStackedPointsIsRepaired)
{
  Positions positions = surface (SurfaceKind::TORUS, 3000, 1.0);
  RandomStream random (7);
  const std::size_t alone = positions.size ();
  for (std::size_t p = 0; p < alone; ++p)
    positions.emplace_back (positions[p] + 0.002 * normalVector (random));
  const Input input = asInput (positions);
  Options options;
  const Report repaired = reconstruct (input, options).report;
  options.remove_self_intersections = false;
  const Report left = reconstruct (input, options).report;
  EXPECT_GT (left.statistics.stacked_points, 2000U);
  EXPECT_GT (left.check.self_intersections, 100U);
  EXPECT_LT (2 * repaired.check.self_intersections, left.check.self_intersections);
}

} // namespace
} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The examination of known meshes, sound and broken.
#include "mesh/check.h"

#include "mesh/known_meshes.h"
#include "mesh/triangle_mesh.h"
#include "report/report_mesh.h"
#include "samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <sstream>
#include <string>

namespace pcl::floater {
namespace {
using samples::annulus;
using samples::beside;
using samples::check;
using samples::grid;
using samples::Mesh;
using samples::pointsAt;
using samples::Positions;
using samples::sheet;
using samples::tetrahedron;
using samples::torus;
using samples::Triangles;

// Expects a sound mesh of this topology.
void
expectSound (const Mesh& mesh, std::size_t components, std::int64_t euler, std::int64_t genus,
             const std::vector<std::size_t>& loop_points)
{
  const MeshExamination found = check (mesh);
  const MeshCheck& c = found.check;
  EXPECT_TRUE (c.done);
  EXPECT_TRUE (found.isManifold ());
  EXPECT_EQ (found.broken_at, NONE);
  EXPECT_EQ (c.components, components);
  EXPECT_EQ (c.euler_characteristic, euler);
  EXPECT_EQ (c.genus, genus);
  ASSERT_EQ (c.loops.size (), loop_points.size ());
  ASSERT_EQ (found.loops.size (), loop_points.size ());
  for (std::size_t i = 0; i < loop_points.size (); ++i) {
    EXPECT_EQ (c.loops[i].points, loop_points[i]);
    EXPECT_EQ (found.loops[i].points.size (), loop_points[i]);
  }
  EXPECT_EQ (c.degenerate_triangles, 0U);
  // The same as by an independent count, and by TriangleMesh.
  const samples::Topology topology = samples::topologyOf (mesh.triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (c.components, topology.components);
  EXPECT_EQ (c.euler_characteristic, topology.euler);
  EXPECT_EQ (found.unused.size (), mesh.positions.size () - topology.vertices);
  TriangleMesh connected;
  connected.triangles = mesh.triangles;
  ASSERT_TRUE (connected.connect (mesh.positions.size (), 1));
  std::vector<std::vector<Index>> expected_loops = boundaryLoops (connected, 1), loops;
  for (const BoundaryLoop& loop : found.loops)
    loops.push_back (loop.points);
  std::sort (loops.begin (), loops.end ());
  std::sort (expected_loops.begin (), expected_loops.end ());
  EXPECT_EQ (loops, expected_loops);
}

TEST (MeshCheck, KnownSurfaces)
{
  expectSound (tetrahedron (), 1, 2, 0, {});
  expectSound (torus (20, 9), 1, 0, 1, {});
  expectSound (sheet (6), 1, 1, 0, {24});
  expectSound (annulus (30), 1, 0, 0, {30, 30});
  expectSound (beside (torus (12, 8), annulus (40)), 2, 0, 1, {40, 40});
  expectSound (beside (sheet (3), tetrahedron ()), 2, 3, 0, {12});
  Mesh holed = torus (20, 9); // without one triangle, and with a point that no triangle uses
  holed.triangles.erase (holed.triangles.begin () + 100);
  holed.positions.emplace_back (0, 0, 0);
  expectSound (holed, 1, -1, 1, {3});
  EXPECT_EQ (check (holed).unused, (std::vector<Index>{180}));
  const Mesh nothing{{{0, 0, 0}, {1, 0, 0}}, {}};
  expectSound (nothing, 0, 0, 0, {});
  expectSound ({}, 0, 0, 0, {});
}

// Everything that was found, so that two examinations can be compared.
std::string
textOf (const MeshExamination& found)
{
  std::ostringstream text;
  text << std::hexfloat;
  const MeshCheck& c = found.check;
  text << c.nonmanifold_edges << ' ' << c.nonmanifold_vertices << ' ' << c.orientation_conflicts
       << ' ' << c.degenerate_triangles << ' ' << c.folds << ' ' << c.components << ' '
       << c.euler_characteristic << ' ' << c.genus << ' ' << c.longest_edge << ' '
       << c.longest_edge_at[0] << ' ' << c.longest_edge_at[1] << ' ' << found.broken_at << ' '
       << found.fold_at << ' ' << found.degenerate_at << ' ' << found.long_edges << ' '
       << found.longest_inside << ' ' << found.longest_inside_at.first << ' '
       << found.longest_inside_at.second << ' ' << found.smallest_component << ' '
       << found.smallest_component_at << ' ' << found.largest_component;
  for (const std::size_t points : found.component_points)
    text << " c" << points;
  for (const Index p : found.unused)
    text << " u" << p;
  for (const BoundaryLoop& loop : found.loops) {
    text << " loop " << loop.component << ' ' << loop.length << ' ' << loop.width;
    for (const Index p : loop.points)
      text << ' ' << p;
  }
  return text.str ();
}

void
expectSameOnAllThreads (const Mesh& mesh)
{
  const std::string expected = textOf (check (mesh));
  for (const int threads : {2, 5})
    EXPECT_EQ (textOf (check (mesh, 0.1F, threads)), expected) << threads;
}

// Loops, components and faults that go through several of the ranges in which points are looked at.
TEST (MeshCheck, ThreadsDoNotMatter)
{
  Mesh mixed = beside (sheet (150), torus (100, 100));
  std::shuffle (mixed.triangles.begin (), mixed.triangles.end (), std::mt19937 (2));
  expectSameOnAllThreads (mixed);
  RandomStream random (5);
  for (int i = 0; i < 300; ++i) {
    Triangle t;
    for (Index& p : t)
      p = static_cast<Index> (random.below (mixed.positions.size () + 100));
    mixed.triangles.push_back (t);
    mixed.triangles.push_back (Triangle (mixed.triangles[random.below (10000)]));
  }
  EXPECT_FALSE (check (mixed).isManifold ());
  expectSameOnAllThreads (mixed);
}

// Around one point are so many triangles that nothing may compare all of them with all.
TEST (MeshCheck, AHub)
{
  constexpr Index AROUND = 200000;
  Mesh cone;
  cone.positions.emplace_back (0, 0, 1);
  for (Index i = 0; i < AROUND; ++i) {
    const double angle = 2.0 * samples::PI * i / AROUND;
    cone.positions.emplace_back (std::cos (angle), std::sin (angle), 0.0);
    cone.triangles.push_back ({0, 1 + i, 1 + (i + 1) % AROUND});
  }
  expectSound (cone, 1, 1, 0, {AROUND});
  cone.triangles.erase (cone.triangles.begin () + 5);
  cone.triangles.erase (cone.triangles.begin () + 70);
  const MeshExamination found = check (cone); // two fans
  EXPECT_EQ (found.check.nonmanifold_vertices, 1U);
  EXPECT_EQ (found.check.components, 2U);
  TriangleMesh connected;
  connected.triangles = cone.triangles;
  EXPECT_FALSE (connected.connect (cone.positions.size (), 2));
}

TEST (MeshCheck, LoopsNameTheirComponents)
{
  const MeshExamination found = check (beside (sheet (3), annulus (40)));
  ASSERT_EQ (found.loops.size (), 3U);
  EXPECT_EQ (found.component_points, (std::vector<std::size_t>{16, 200}));
  EXPECT_EQ (found.loops[0].component, 1U);
  EXPECT_EQ (found.loops[1].component, 1U);
  EXPECT_EQ (found.loops[2].component, 0U);
  EXPECT_EQ (found.smallest_component, 16U);
  EXPECT_EQ (found.smallest_component_at, 0U);
  EXPECT_EQ (found.largest_component, 200U);
}

TEST (MeshCheck, LoopsHaveTheirSizeInTheCloud)
{
  // The width of the short loops is exact. That of the long ones is exact as well: their points lie
  // opposite to each other at equal steps.
  for (const Index around : {100U, 500U}) {
    const MeshExamination found = check (annulus (around));
    ASSERT_EQ (found.check.loops.size (), 2U);
    for (const std::size_t i : {0U, 1U}) {
      const LoopSummary& loop = found.check.loops[i];
      const double radius = i == 0 ? 1.0 : 0.5, chord = 2.0 * std::sin (samples::PI / around);
      EXPECT_NEAR (loop.length, 10.0 * radius * around * chord, 1e-9);
      EXPECT_NEAR (loop.width, 10.0 * radius * 2.0, 1e-9);
      EXPECT_NEAR (loop.width_spacings, radius * 2.0 / 0.1, 1e-4);
      EXPECT_EQ (loop.at, i == 0 ? 1U : 3 * 4 * around + 1);
    }
  }
}

// Two rings of a wheel: vertex 0, ring 1 to 6, ring 7 to 12.
Mesh
wheel (bool with_middle)
{
  Mesh mesh;
  mesh.positions = samples::randomPoints (30, 1);
  for (Index i = 0; i < 6; ++i) {
    const Index j = (i + 1) % 6;
    if (with_middle)
      mesh.triangles.push_back ({0, 1 + i, 1 + j});
    mesh.triangles.push_back ({1 + i, 7 + i, 7 + j});
    mesh.triangles.push_back ({1 + i, 7 + j, 1 + j});
  }
  return mesh;
}

TEST (MeshCheck, ADiscHasOneLoop)
{
  const MeshExamination found = check (wheel (true));
  EXPECT_TRUE (found.isManifold ());
  EXPECT_TRUE (found.isDisc ());
  EXPECT_EQ (found.loops.front ().points, (std::vector<Index>{7, 8, 9, 10, 11, 12}));
  EXPECT_EQ (found.unused.size (), 17U); // points without triangles do not matter
  EXPECT_TRUE (check (sheet (6)).isDisc ());
}

TEST (MeshCheck, WhatIsNoDisc)
{
  const auto isManifoldDisc = [] (const Mesh& mesh) {
    const MeshExamination found = check (mesh);
    return found.isManifold () && found.isDisc ();
  };
  EXPECT_FALSE (isManifoldDisc ({wheel (true).positions, {}})) << "nothing";
  EXPECT_FALSE (isManifoldDisc (wheel (false))) << "a hole";
  EXPECT_FALSE (isManifoldDisc (tetrahedron ())) << "closed";
  Mesh holed_torus = torus (20, 9);
  holed_torus.triangles.pop_back ();
  EXPECT_FALSE (isManifoldDisc (holed_torus)) << "a handle";
  // Euler characteristic and loops are those of a disc.
  EXPECT_FALSE (isManifoldDisc (beside (wheel (true), torus (3, 3)))) << "a torus beside it";
  const auto expectBroken = [&] (const char* why, const std::function<void (Triangles&)>& change) {
    Mesh mesh = wheel (true);
    change (mesh.triangles);
    EXPECT_FALSE (isManifoldDisc (mesh)) << why;
  };
  expectBroken ("two components", [] (Triangles& all) { all.push_back ({20, 21, 22}); });
  expectBroken ("a closed component", [] (Triangles& all) {
    for (const Triangle& t :
         {Triangle{20, 22, 21}, Triangle{20, 21, 23}, Triangle{21, 22, 23}, Triangle{22, 20, 23}})
      all.push_back (t);
  });
  expectBroken ("a triangle wound against the others",
                [] (Triangles& all) { std::swap (all[3][0], all[3][1]); });
  expectBroken ("a triangle twice", [] (Triangles& all) { all.push_back (Triangle (all[4])); });
  expectBroken ("a vertex with two fans", [] (Triangles& all) { all.push_back ({0, 20, 21}); });
  // Without one triangle at the boundary it is a disc within another loop.
  Mesh smaller = wheel (true);
  smaller.triangles.erase (smaller.triangles.end () - 2);
  const MeshExamination found = check (smaller);
  EXPECT_TRUE (found.isDisc ());
  EXPECT_EQ (found.loops.front ().points, (std::vector<Index>{6, 7, 8, 9, 10, 11, 12}));
}

TEST (MeshCheck, WhatIsBrokenIsCounted)
{
  struct Case
  {
    const char* what;
    Triangles triangles;
    std::size_t edges, vertices, conflicts, components;
  };
  const std::vector<Case> cases = {
      {"three triangles at an edge", {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, 1, 0, 0, 1},
      {"wound against each other", {{0, 1, 2}, {0, 1, 3}}, 0, 0, 1, 1},
      {"a bow tie", {{0, 1, 2}, {0, 3, 4}}, 0, 1, 0, 2},
      {"two closed fans at a vertex",
       {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 5, 4}, {0, 4, 6}, {4, 5, 6}, {5, 0, 6}},
       0,
       1,
       0,
       2},
      {"the same triangle twice", {{0, 1, 2}, {1, 2, 0}}, 0, 3, 3, 1},
      {"a triangle and its back", {{0, 1, 2}, {0, 2, 1}}, 0, 3, 0, 1},
      {"the same triangle twice in a mesh", {{0, 1, 2}, {1, 0, 3}, {0, 1, 2}}, 1, 1, 2, 1},
      {"a corner twice", {{0, 1, 1}}, 1, 0, 0, 0},
      {"a corner thrice", {{0, 1, 2}, {2, 2, 2}}, 1, 0, 0, 1},
      {"points that are none", {{0, 1, 7}, {0, NONE, 2}}, 2, 0, 0, 0}};
  RandomStream random (3);
  Positions positions (7);
  for (Eigen::Vector3d& p : positions)
    p = {random.uniform (), random.uniform (), random.uniform ()};
  for (const Case& broken : cases) {
    SCOPED_TRACE (broken.what);
    const MeshExamination found = check ({positions, broken.triangles});
    EXPECT_FALSE (found.isManifold ());
    EXPECT_EQ (found.check.nonmanifold_edges, broken.edges);
    EXPECT_EQ (found.check.nonmanifold_vertices, broken.vertices);
    EXPECT_EQ (found.check.orientation_conflicts, broken.conflicts);
    EXPECT_EQ (found.check.components, broken.components);
    EXPECT_EQ (found.broken_at, 0U + (std::string (broken.what) == "a corner thrice" ? 2U : 0U));
    Report report;
    const Problem problem = reportCheck (pointsAt (positions), found, {}, report);
    EXPECT_EQ (problem.status, RunStatus::INTERNAL_ERROR);
    EXPECT_NE (problem.message.find ("not an oriented manifold"), std::string::npos);
    EXPECT_TRUE (report.check.done);
  }
}

TEST (MeshCheck, AMoebiusStripIsWoundAgainstItself)
{
  constexpr Index AROUND = 40, ACROSS = 4;
  const auto index = [] (Index x, Index y) { // the end is glued upside down
    return x < AROUND ? y * AROUND + x : (ACROSS - y) * AROUND;
  };
  const Mesh strip = grid (AROUND, ACROSS, AROUND * (ACROSS + 1), index, [] (Index x, Index y) {
    const double u = 2.0 * samples::PI * x / AROUND, v = 0.1 * (y - 0.5 * ACROSS);
    return Eigen::Vector3d ((1.0 + v * std::cos (0.5 * u)) * std::cos (u),
                            (1.0 + v * std::cos (0.5 * u)) * std::sin (u), v * std::sin (0.5 * u));
  });
  const MeshExamination found = check (strip);
  EXPECT_EQ (found.check.orientation_conflicts, ACROSS);
  EXPECT_EQ (found.check.nonmanifold_edges, 0U);
  EXPECT_EQ (found.check.nonmanifold_vertices, 0U);
  EXPECT_EQ (found.check.components, 1U);
  EXPECT_EQ (found.check.euler_characteristic, 0);
  EXPECT_FALSE (found.isManifold ());
}

// The check takes any triangles, and agrees with TriangleMesh::connect on what is a manifold.
TEST (MeshCheck, AnyTriangles)
{
  RandomStream random (11);
  std::size_t sound = 0;
  for (int run = 0; run < 3000; ++run) {
    constexpr std::size_t POINTS = 7;
    Mesh mesh;
    mesh.positions = samples::randomPoints (POINTS, static_cast<std::uint64_t> (run));
    mesh.triangles.resize (1 + random.below (6));
    for (Triangle& t : mesh.triangles)
      for (Index& p : t)
        p = static_cast<Index> (random.below (POINTS));
    TriangleMesh connected;
    connected.triangles = mesh.triangles;
    const bool is_sound = connected.connect (POINTS, 1);
    const MeshExamination found = check (mesh);
    // But for two triangles back to back, which are a sphere for TriangleMesh.
    bool is_flat = false;
    for (const Triangle& t : mesh.triangles)
      is_flat |= std::count_if (mesh.triangles.begin (), mesh.triangles.end (),
                                [&t] (const Triangle& other) {
                                  return samples::unordered ({t}) == samples::unordered ({other});
                                }) > 1;
    EXPECT_EQ (found.isManifold (), is_sound && !is_flat);
    sound += is_sound ? 1 : 0;
  }
  EXPECT_GT (sound, 100U);
}

TEST (MeshCheck, FoldsLongEdgesAndTrianglesWithoutArea)
{
  Mesh mesh = sheet (4);
  MeshExamination found = check (mesh);
  EXPECT_EQ (found.check.folds, 0U);
  EXPECT_EQ (found.fold_at, NONE);
  EXPECT_EQ (found.long_edges, 0U);
  EXPECT_NEAR (found.check.longest_edge, std::sqrt (2.0), 1e-6);

  // The last column is folded back by 130 degrees, then by 110.
  for (const bool folded : {true, false}) {
    const double angle = (folded ? 130.0 : 110.0) * samples::PI / 180.0;
    for (Index y = 0; y < 5; ++y)
      mesh.positions[5 * y + 4] = {0.3 + 0.1 * std::cos (angle), 0.1 * y, 0.1 * std::sin (angle)};
    found = check (mesh);
    EXPECT_EQ (found.check.folds, folded ? 4U : 0U);
    EXPECT_EQ (found.fold_at, folded ? 3U : NONE);
  }

  // A corner far away, where two boundary edges and a diagonal end.
  mesh = sheet (4);
  mesh.positions[24] = {1.4, 1.4, 0.0};
  found = check (mesh);
  EXPECT_EQ (found.long_edges, 1U);
  EXPECT_EQ (found.longest_inside_at, (std::pair<Index, Index>{18, 24}));
  EXPECT_NEAR (found.longest_inside, 11.0 * std::sqrt (2.0), 1e-5);
  EXPECT_EQ (found.check.longest_edge_at, (std::array<Index, 2>{3 * 18 + 1, 3 * 24 + 1}));

  // Three points on a line, up to a tenth of the precision of coordinates, or up to ten times of
  // it.
  for (const bool flat : {true, false}) {
    const Mesh line{{{0, 0, 0}, {0.5, 0, flat ? 1e-8 : 1e-6}, {1, 0, 0}, {0.5, 1, 0}},
                    {{0, 1, 3}, {1, 2, 3}, {0, 2, 1}}};
    found = check (line);
    EXPECT_EQ (found.check.degenerate_triangles, flat ? 1U : 0U);
    EXPECT_EQ (found.degenerate_at, flat ? 0U : NONE);
    EXPECT_EQ (found.check.folds, 0U); // at right angles to the others, or none
  }
  // Small triangles are not degenerate.
  EXPECT_EQ (check (tetrahedron (1e-9), 1e-10F).check.degenerate_triangles, 0U);
}
} // namespace
} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Edge flips, the insertion of missing points, and both with the repair of folds.
#include "mesh/finish.h"

#include "floater/planar_delaunay.h"
#include "mesh/folds.h"
#include "mesh/insertion.h"
#include "mesh/known_meshes.h"

#include <gtest/gtest.h>

#include <limits>

namespace pcl::floater {
namespace {
using namespace samples;
using Places = std::vector<Eigen::Vector2d>;

Places
planView (const Positions& positions)
{
  Places uv;
  for (const Eigen::Vector3d& p : positions)
    uv.emplace_back (p.x (), p.y ());
  return uv;
}

// A round sheet as the library orders its points.
struct SortedDisc
{
  Neighborhoods made;
  std::vector<Index> loop;
  std::vector<std::uint8_t> is_border; // of each point

  SortedDisc (double step, std::uint64_t seed)
  {
    const Sheet sheet = disc (step, seed);
    made = makeNeighborhoods (sheet.positions);
    loop.resize (sheet.border);
    for (Index p = 0; p < made.points.size (); ++p) {
      const Index at = made.points.cloud_index[p];
      is_border.push_back (at < sheet.border ? 1 : 0);
      if (at < sheet.border)
        loop[at] = p;
    }
  }
};

TEST (Insertion, PutsEveryPointIn)
{
  const SortedDisc disc (0.07, 7);
  const Positions& positions = disc.made.points.positions;
  const std::vector<Eigen::Vector3f> normals (positions.size (), Eigen::Vector3f::UnitZ ());
  Places some = planView (positions);
  RandomStream random (8);
  std::size_t missing = 0;
  for (std::size_t p = 0; p < some.size (); ++p)
    if (disc.is_border[p] == 0 && random.uniform () < 0.2) {
      some[p].setConstant (std::numeric_limits<double>::quiet_NaN ());
      ++missing;
    }
  TriangleMesh mesh = triangulatePlane (some, disc.loop);
  const TriangleCost cost (positions, normals);
  const CsrLists& neighbors = disc.made.geometry.neighbors;
  EXPECT_EQ (insertMissingPoints (mesh, neighbors, cost, false, 1), missing);
  expectDisc (mesh, positions.size ());
  EXPECT_EQ (insertMissingPoints (mesh, neighbors, cost, false, 1), 0U);
}

// A flat sheet whose triangulation has some points in the wrong places.
struct MixedUpSheet : SortedDisc
{
  TriangleMesh mesh;

  MixedUpSheet () : SortedDisc (0.07, 9)
  {
    Places mixed = planView (made.points.positions);
    RandomStream random (10);
    for (int i = 0; i < 6; ++i) {
      const std::size_t p = random.below (mixed.size ());
      const Index q = made.geometry.neighbors.row (p)[5];
      if (is_border[p] == 0 && is_border[q] == 0)
        std::swap (mixed[p], mixed[q]);
    }
    mesh = triangulatePlane (mixed, loop);
  }

  MeshFinish finish (const FinishSettings& settings)
  {
    return finishMesh (mesh, made.points.positions, made.geometry, settings, 1);
  }
};

TEST (Finish, PutsPointsInOrderThatThePlaneHasMixedUp)
{
  for (const bool flip : {false, true}) {
    MixedUpSheet sheet;
    const std::vector<Triangle> before = sheet.mesh.triangles;
    FinishSettings settings;
    settings.flip_edges = settings.repair = flip;
    settings.largest_fold_share = 0.03; // as for a disc
    const MeshFinish finish = sheet.finish (settings);
    EXPECT_TRUE (finish.is_repairable);
    expectDisc (sheet.mesh, sheet.made.points.size ());
    EXPECT_EQ (findFolds (sheet.mesh, sheet.made.points.positions, 1).empty (), flip);
    EXPECT_EQ (finish.flips > 0, flip);
    EXPECT_EQ (unordered (sheet.mesh.triangles) == unordered (before), !flip);
  }
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

TEST (Finish, ATorusLaidOutAsADiscIsRefused)
{
  constexpr Index AROUND = 60;
  const Positions positions = torus (AROUND, 24).positions;
  Options options;
  options.disc.boundary.loop = {0,          1,     2, AROUND + 2, 2 * AROUND + 2, 2 * AROUND + 1,
                                2 * AROUND, AROUND}; // around a square of 2 x 2 cells
  options.topology = Topology::DISC;
  const Result result = reconstruct (asInput (positions), options);
  EXPECT_EQ (result.report.status, RunStatus::NOT_A_DISC);
  EXPECT_NE (result.report.message.find ("folded"), std::string::npos) << result.report.message;
  EXPECT_TRUE (result.triangles.empty ());
}

} // namespace
} // namespace pcl::floater

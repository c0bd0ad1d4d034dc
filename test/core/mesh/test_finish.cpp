// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Edge flips, the insertion of missing points, and both with the repair of folds.
#include "mesh/finish.h"

#include "floater/planar_delaunay.h"
#include "mesh/fold_repair.h"
#include "mesh/insertion.h"
#include "mesh/known_meshes.h"

#include <gtest/gtest.h>

#include <limits>

namespace pcl::floater {
namespace {
using samples::connected;
using samples::expectDisc;
using samples::Positions;
using samples::Sheet;
using samples::unordered;
using Places = std::vector<Eigen::Vector2d>;

Places
planView (const Positions& positions, double stretch = 1.0)
{
  Places uv;
  for (const Eigen::Vector3d& p : positions)
    uv.emplace_back (p.x (), stretch * p.y ());
  return uv;
}

std::vector<Eigen::Vector3f>
upward (std::size_t count)
{
  std::vector<Eigen::Vector3f> normals (count, Eigen::Vector3f::UnitZ ());
  return normals;
}

// A round sheet as the library orders its points.
struct SortedDisc
{
  samples::Neighborhoods made;
  std::vector<Index> loop;
  std::vector<std::uint8_t> is_border; // of each point

  SortedDisc (double step, std::uint64_t seed)
  {
    const Sheet sheet = samples::disc (step, seed);
    made = samples::makeNeighborhoods (sheet.positions);
    loop.resize (sheet.border);
    for (Index p = 0; p < made.points.size (); ++p) {
      const Index at = made.points.cloud_index[p];
      is_border.push_back (at < sheet.border ? 1 : 0);
      if (at < sheet.border)
        loop[at] = p;
    }
  }
};

// How far a point is inside the circle through the corners of a flat triangle, as a share of the
// squared radius. Negative outside.
double
depthInCircle (const Positions& at, const Triangle& t, Index p)
{
  const Eigen::Vector3d a = at[t[1]] - at[t[0]], b = at[t[2]] - at[t[0]];
  const Eigen::Vector3d centre = (a.squaredNorm () * b - b.squaredNorm () * a).cross (a.cross (b)) /
                                 (2.0 * a.cross (b).squaredNorm ());
  return 1.0 - (at[p] - at[t[0]] - centre).squaredNorm () / centre.squaredNorm ();
}

TEST (Flips, AreDelaunayInThePlane)
{
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Sheet sheet = samples::disc (0.07, seed);
    const std::vector<Index> loop = samples::indices (sheet.border);
    const std::vector<Eigen::Vector3f> normals = upward (sheet.positions.size ());
    TriangleMesh mesh = triangulatePlane (planView (sheet.positions, 0.25), loop);
    const std::set<Triangle> before = unordered (mesh.triangles);
    const std::size_t flips = flipEdges (mesh, TriangleCost (sheet.positions, normals), 1);
    EXPECT_GT (flips, 100U);
    EXPECT_NE (unordered (mesh.triangles), before);
    EXPECT_EQ (expectDisc (mesh, sheet.positions.size ()), loop);
    for (Index t = 0; t < mesh.triangles.size (); ++t)
      for (std::uint8_t side = 0; side < 3; ++side) {
        const MeshEdge across = mesh.mate ({t, side});
        if (across.triangle != NONE) {
          EXPECT_LT (depthInCircle (sheet.positions, mesh.triangles[t], mesh.corner (across)),
                     1e-6);
        }
      }
    EXPECT_EQ (flipEdges (mesh, TriangleCost (sheet.positions, normals), 1), 0U);
  }
}

TEST (Flips, EndOnStraightLines)
{
  // A square grid in space: along straight lines any two diagonals cost the same, up to rounding.
  constexpr double SIDE = 15.0;
  Sheet sheet = samples::fillOutlines (
      {samples::resample ({{0, 0}, {SIDE, 0}, {SIDE, SIDE}, {0, SIDE}}, 1.0)}, 1.0, 0.0, 1);
  // The border is laid on a circle, so that some triangles have all corners on one line.
  Places uv;
  for (std::size_t i = 0; i < sheet.positions.size (); ++i) {
    const double angle = 2.0 * PI * static_cast<double> (i) / static_cast<double> (sheet.border);
    if (i < sheet.border)
      uv.emplace_back (std::cos (angle), std::sin (angle));
    else
      uv.emplace_back (0.05 * (sheet.positions[i].head<2> () - Eigen::Vector2d (7.5, 7.5)));
  }
  TriangleMesh mesh = triangulatePlane (uv, samples::indices (sheet.border));
  const Eigen::Vector3d x (0.9, 0.3, 0.1), y (-0.3, 0.9, -0.7);
  for (Eigen::Vector3d& p : sheet.positions)
    p = p.x () * x + p.y () * y;
  const std::vector<Eigen::Vector3f> normals (sheet.positions.size (),
                                              x.cross (y).normalized ().cast<float> ());
  flipEdges (mesh, TriangleCost (sheet.positions, normals), 1);
  EXPECT_EQ (expectDisc (mesh, sheet.positions.size ()), samples::indices (sheet.border));
}

TEST (Flips, NormalsAreTurnedToTheSideOfTheAreasAroundThem)
{
  samples::Mesh torus = samples::torus (200, 170); // three ranges of points
  const TriangleMesh mesh = connected (torus);
  torus.positions.emplace_back (0, 0, 0); // no vertex
  const Positions random = samples::randomPoints (torus.positions.size (), 4);
  std::vector<Eigen::Vector3f> normals, area (random.size (), Eigen::Vector3f::Zero ());
  for (const Eigen::Vector3d& p : random)
    normals.emplace_back ((p - Eigen::Vector3d::Constant (0.5)).cast<float> ());
  for (const Triangle& t : mesh.triangles)
    for (const Index p : t)
      area[p] += areaVector (torus.positions[t[0]], torus.positions[t[1]], torus.positions[t[2]])
                     .cast<float> ();
  std::vector<Eigen::Vector3f> turned = normals;
  orientNormals (mesh, torus.positions, turned, 2);
  EXPECT_EQ (turned.back (), normals.back ());
  for (std::size_t p = 0; p < normals.size (); ++p)
    EXPECT_EQ (turned[p], (normals[p].dot (area[p]) < 0.0F ? -1.0F : 1.0F) * normals[p]);
}

TEST (Insertion, PutsEveryPointIn)
{
  const SortedDisc disc (0.07, 7);
  const Positions& positions = disc.made.points.positions;
  const std::vector<Eigen::Vector3f> normals = upward (positions.size ());
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

// Inserts points after the first three into the triangle of these; point i has the i-th neighbour
// only. Returns how many are in.
std::size_t
inserted (const Positions& positions, const std::vector<Index>& neighbor_of)
{
  const std::vector<Eigen::Vector3f> normals = upward (positions.size ());
  const CsrLists neighbors = makeCsrLists (positions.size (), [&] (const auto& emit) {
    for (std::size_t i = 0; i < neighbor_of.size (); ++i)
      emit (3 + i, neighbor_of[i]);
  });
  TriangleMesh mesh = connected ({{0, 1, 2}}, positions.size ());
  const std::size_t count =
      insertMissingPoints (mesh, neighbors, TriangleCost (positions, normals), false, 1);
  EXPECT_EQ (mesh.triangles.size (), 1 + 2 * count);
  samples::expectConsistent (mesh);
  return count;
}

TEST (Insertion, ARowOfPointsFindsItsWayInAndPointsWithoutVerticesNearbyStayOut)
{
  const Positions positions = {{0, 0, 0},   {10, 0, 0},  {0, 10, 0},
                               {3, 3.1, 0}, {2, 2.3, 0}, {2.5, 1.5, 0}};
  EXPECT_EQ (inserted (positions, {4, 5, 0}), 3U);
  EXPECT_EQ (inserted (positions, {4, 3, 4}), 0U);
}

// Points that differ by less than squares can tell, and whose spacing is 0 as a float.
TEST (TriangleCost, IsFiniteHoweverNearThePointsAre)
{
  const Positions positions{{0.0, 0.0, 0.0},     {1e-200, 0.0, 0.0}, {0.0, 1e-200, 0.0},
                            {2e-200, 3e-200, 0}, {1.0, 0.0, 0.0},    {0.0, 1.0, 0.0}};
  const std::vector<Eigen::Vector3f> normals = upward (positions.size ());
  const std::vector<float> spacing (positions.size (), 0.0F);
  const TriangleCost cost (positions, normals, &spacing);
  for (Index a = 0; a < positions.size (); ++a)
    for (Index b = 0; b < positions.size (); ++b)
      for (Index c = 0; c < positions.size (); ++c)
        if (a != b && b != c && c != a) {
          EXPECT_TRUE (std::isfinite (cost (a, b, c))) << a << b << c;
          EXPECT_GT (cost (a, b, c), 0.0) << a << b << c;
        }
  // Flips end there, too.
  TriangleMesh mesh =
      connected ({{0, 1, 2}, {2, 1, 3}, {3, 1, 4}, {2, 3, 5}, {3, 4, 5}}, positions.size ());
  EXPECT_LT (flipEdges (mesh, cost, 1), 10U);
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
    settings.flip_edges = flip;
    settings.largest_fold_share = 0.03; // as for a disc
    const MeshFinish finish = sheet.finish (settings);
    EXPECT_TRUE (finish.is_repairable);
    EXPECT_EQ (finish.folds, findFolds (sheet.mesh, sheet.made.points.positions, 1).size ());
    EXPECT_GT (finish.folds_after_flips, 0U);
    expectDisc (sheet.mesh, sheet.made.points.size ());
    EXPECT_EQ (finish.folds, flip ? 0U : finish.folds_after_flips);
    EXPECT_EQ (finish.flips > 0, flip);
    EXPECT_EQ (unordered (sheet.mesh.triangles) == unordered (before), !flip);
  }
}

TEST (Finish, RepairIsSkippedAboveTheLargestShareOfFolds)
{
  MixedUpSheet sheet;
  const MeshFinish repaired = sheet.finish ({});
  ASSERT_GT (repaired.folds_after_flips, 0U);
  EXPECT_TRUE (repaired.is_repairable);
  EXPECT_EQ (repaired.folds, 0U);
  // The share is that of 1.5 edges per triangle.
  const double share = static_cast<double> (repaired.folds_after_flips) /
                       (1.5 * static_cast<double> (sheet.mesh.triangles.size ()));
  for (const bool is_above : {true, false}) {
    FinishSettings settings;
    settings.largest_fold_share = share * (is_above ? 0.999 : 1.001);
    const MeshFinish finish = MixedUpSheet ().finish (settings);
    EXPECT_EQ (finish.is_repairable, !is_above);
    EXPECT_EQ (finish.folds_after_flips, repaired.folds_after_flips);
    EXPECT_EQ (finish.folds, is_above ? repaired.folds_after_flips : 0U);
    EXPECT_EQ (finish.flips, repaired.flips);
  }
}

TEST (Finish, ATorusLaidOutAsADiscIsRefused)
{
  constexpr Index AROUND = 60;
  const samples::Positions positions = samples::torus (AROUND, 24).positions;
  Options options;
  options.disc.boundary.loop = {0,          1,     2, AROUND + 2, 2 * AROUND + 2, 2 * AROUND + 1,
                                2 * AROUND, AROUND}; // around a square of 2 x 2 cells
  options.topology = Topology::DISC;
  const Result result = reconstruct (samples::asInput (positions), options);
  EXPECT_EQ (result.report.status, RunStatus::NOT_A_DISC);
  EXPECT_NE (result.report.message.find ("folded"), std::string::npos) << result.report.message;
  EXPECT_TRUE (result.triangles.empty ());
}

} // namespace
} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Insertion, flips, repair and orientation, one after the other.
#include "mesh/finish.h"

#include "floater/planar_delaunay.h"
#include "mesh/fold_repair.h"
#include "mesh/known_meshes.h"
#include "samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::unordered;
using Places = std::vector<Eigen::Vector2d>;

// A flat sheet whose triangulation has some points in the wrong places.
struct MixedUpSheet
{
  samples::Neighborhoods made;
  TriangleMesh mesh;

  MixedUpSheet ()
  {
    const samples::Sheet sheet = samples::disc (0.07, 9);
    made = samples::makeNeighborhoods (sheet.positions);
    const Points& points = made.points;
    std::vector<Index> loop (sheet.border);
    Places mixed;
    for (Index p = 0; p < points.size (); ++p) {
      mixed.emplace_back (points.positions[p].head<2> ());
      if (points.cloud_index[p] < sheet.border)
        loop[points.cloud_index[p]] = p;
    }
    RandomStream random (10);
    for (int i = 0; i < 6; ++i) {
      const std::size_t p = random.below (mixed.size ());
      const Index q = made.geometry.neighbors.row (p)[5];
      if (points.cloud_index[p] >= sheet.border && points.cloud_index[q] >= sheet.border)
        std::swap (mixed[p], mixed[q]);
    }
    mesh = triangulatePlane (mixed, loop);
  }
};

void
expectDisc (const TriangleMesh& mesh, std::size_t vertices)
{
  const samples::Topology topology = samples::topologyOf (mesh.triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (topology.euler, 1);
  EXPECT_EQ (topology.vertices, vertices);
}

TEST (Finish, PutsPointsInOrderThatThePlaneHasMixedUp)
{
  for (const bool flip : {false, true}) {
    MixedUpSheet sheet;
    const std::vector<Eigen::Vector3d>& positions = sheet.made.points.positions;
    const std::set<Triangle> before = unordered (sheet.mesh.triangles);
    FinishSettings settings;
    settings.flip_edges = flip;
    settings.largest_fold_share = 0.03; // as for a disc
    const MeshFinish finish = finishMesh (sheet.mesh, positions, sheet.made.geometry, settings, 1);
    EXPECT_TRUE (finish.is_repairable);
    EXPECT_EQ (finish.folds, findFolds (sheet.mesh, positions, 1).size ());
    EXPECT_GT (finish.folds_after_flips, 0U);
    expectDisc (sheet.mesh, positions.size ());
    if (flip) {
      EXPECT_EQ (finish.folds, 0U);
      EXPECT_GT (finish.flips, 0U);
    }
    else {
      EXPECT_EQ (finish.folds, finish.folds_after_flips);
      EXPECT_EQ (finish.flips, 0U);
      EXPECT_EQ (unordered (sheet.mesh.triangles), before);
    }
  }
}

TEST (Finish, RepairIsSkippedAboveTheLargestShareOfFolds)
{
  MixedUpSheet sheet;
  const std::vector<Eigen::Vector3d>& positions = sheet.made.points.positions;
  MixedUpSheet other = sheet;
  const MeshFinish repaired = finishMesh (sheet.mesh, positions, sheet.made.geometry, {}, 1);
  ASSERT_GT (repaired.folds_after_flips, 0U);
  EXPECT_TRUE (repaired.is_repairable);
  EXPECT_EQ (repaired.folds, 0U);
  // The share is that of 1.5 edges per triangle.
  const double share = static_cast<double> (repaired.folds_after_flips) /
                       (1.5 * static_cast<double> (other.mesh.triangles.size ()));
  for (const bool is_above : {true, false}) {
    MixedUpSheet again = other;
    FinishSettings settings;
    settings.largest_fold_share = share * (is_above ? 0.999 : 1.001);
    const MeshFinish finish = finishMesh (again.mesh, positions, again.made.geometry, settings, 1);
    EXPECT_EQ (finish.is_repairable, !is_above);
    EXPECT_EQ (finish.folds_after_flips, repaired.folds_after_flips);
    EXPECT_EQ (finish.folds, is_above ? repaired.folds_after_flips : 0U);
    EXPECT_EQ (finish.flips, repaired.flips);
  }
}

TEST (Finish, ASurfaceFoldedAllOverIsNotRepairable)
{
  // Points of a flat sheet, joined at random: no flips can put that in order.
  samples::Neighborhoods made = samples::makeNeighborhoods (samples::disc (0.07, 9).positions);
  RandomStream random (11);
  Places scattered;
  for (Index p = 0; p < made.points.size (); ++p) {
    const double angle =
        p < 3 ? 2.0 * samples::PI * p / 3.0 : 2.0 * samples::PI * random.uniform ();
    const double radius = p < 3 ? 1.0 : 0.4 * random.uniform ();
    scattered.emplace_back (radius * std::cos (angle), radius * std::sin (angle));
  }
  TriangleMesh mesh = triangulatePlane (scattered, {0, 1, 2});
  FinishSettings settings;
  settings.largest_fold_share = 0.03;
  const MeshFinish finish = finishMesh (mesh, made.points.positions, made.geometry, settings, 1);
  EXPECT_FALSE (finish.is_repairable);
  EXPECT_GT (finish.folds, 0U);
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

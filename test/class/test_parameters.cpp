// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Setters and getters of FloaterReconstruction.
#include "parameter_choice.h"

namespace pcl::floater {
namespace {
TEST_F (FloaterClass, DefaultsAreThoseOfTheOptions)
{
  const Options defaults;
  const pcl::FloaterReconstruction<pcl::PointXYZ> floater;
  EXPECT_EQ (floater.getTopology (), defaults.topology);
  EXPECT_EQ (floater.getHolePolicy (), defaults.holes.policy);
  EXPECT_EQ (floater.getKeptLoops (), defaults.holes.kept_loops);
  EXPECT_EQ (floater.getLargestHole (), defaults.holes.largest_hole);
  EXPECT_EQ (floater.getLargestHoleUnit (), defaults.holes.unit);
  EXPECT_EQ (floater.getMaximumEdgeLength (), defaults.trimming.maximum_edge_length);
  EXPECT_EQ (floater.getMaximumEdgeRatio (), defaults.trimming.maximum_edge_ratio);
  EXPECT_EQ (floater.getMinimumComponentSize (), defaults.trimming.minimum_component_size);
  EXPECT_EQ (floater.getRemoveOutliers (), defaults.remove_outliers);
  EXPECT_EQ (floater.getScatterPolicy (), defaults.scatter);
  EXPECT_EQ (floater.getOpenSelfIntersections (), defaults.trimming.open_self_intersections);
  EXPECT_EQ (floater.getDenoise (), defaults.denoise);
  EXPECT_EQ (floater.getKSearch (), defaults.neighbors.k);
  EXPECT_EQ (floater.getDiscOptions ().boundary.opening_angle,
             defaults.disc.boundary.opening_angle);
  EXPECT_EQ (floater.getDiscOptions ().boundary.cluster_tolerance,
             defaults.disc.boundary.cluster_tolerance);
  EXPECT_EQ (floater.getDiscOptions ().boundary.cluster_k, defaults.disc.boundary.cluster_k);
  EXPECT_EQ (floater.getDiscOptions ().boundary.method, defaults.disc.boundary.method);
  EXPECT_EQ (floater.getDiscOptions ().domain.curve, defaults.disc.domain.curve);
  EXPECT_EQ (floater.getDiscOptions ().domain.polygon_sides, defaults.disc.domain.polygon_sides);
  EXPECT_EQ (floater.getDiscOptions ().weighting, defaults.disc.weighting);
  EXPECT_EQ (floater.getNeighborhood (), defaults.neighbors.kind);
  EXPECT_EQ (floater.getBallRadius (), defaults.neighbors.ball_radius);
  EXPECT_EQ (floater.getDiscOptions ().domain.loop_spacing, defaults.disc.domain.loop_spacing);
  EXPECT_EQ (floater.getDiscOptions ().solver.method, defaults.disc.solver.method);
  EXPECT_EQ (floater.getDiscOptions ().solver.ordering, defaults.disc.solver.ordering);
  EXPECT_EQ (floater.getDiscOptions ().solver.tolerance, defaults.disc.solver.tolerance);
  EXPECT_EQ (floater.getDiscOptions ().solver.max_iterations, defaults.disc.solver.max_iterations);
  EXPECT_EQ (floater.getDiscOptions ().solver.ilut_fill, defaults.disc.solver.ilut_fill);
  EXPECT_EQ (floater.getDiscOptions ().solver.ilut_drop, defaults.disc.solver.ilut_drop);
  EXPECT_EQ (floater.getFilterSheets (), defaults.filter_sheets);
  EXPECT_EQ (floater.getFlipEdges (), defaults.flip_edges);
  EXPECT_EQ (floater.getFacing (), defaults.facing);
  EXPECT_EQ (floater.getRemoveSelfIntersections (), defaults.remove_self_intersections);
  EXPECT_FALSE (floater.getComputeTextureCoordinates ());
  EXPECT_EQ (floater.getLargestStretch (), TextureOptions ().largest_stretch);
  EXPECT_EQ (floater.getNumberOfThreads (), 0U);
  EXPECT_EQ (floater.getNumberOfBlocks (), defaults.blocks);
  EXPECT_TRUE (floater.getPrescribedLoop ().empty ());
  EXPECT_FALSE (floater.getStageCallback ());
  EXPECT_FALSE (floater.getProgressCallback ());
  EXPECT_FALSE (floater.getCancelledCallback ());

  EXPECT_EQ (floater.getStatus (), RunStatus::NOT_RUN);
  EXPECT_EQ (floater.getReport ().status, RunStatus::NOT_RUN);
  EXPECT_TRUE (floater.getBoundaryLoop ().empty ());
  EXPECT_TRUE (floater.getParameters ().empty ());
  EXPECT_TRUE (floater.getOutlierIndices ().empty ());
  EXPECT_TRUE (floater.getScatterIndices ().empty ());
  EXPECT_FALSE (floater.getMeshCheck ().done);
  EXPECT_EQ (floater.getStatistics ().cloud_points, 0U);
}

TEST_F (FloaterClass, EveryChoiceMakesADiscAndIsKept)
{
  const std::vector<Choice> choices{
      CHOICE (HolePolicy, HolePolicy::KEEP_LARGEST),
      CHOICE (KeptLoops, 3),
      CHOICE (LargestHole, 5.0),
      {"LargestHole 0.5, CLOUD",
       [] (Floater& floater) { floater.setLargestHole (0.5, LengthUnit::CLOUD); },
       [] (const Floater& floater) {
         return floater.getLargestHole () == 0.5 &&
                floater.getLargestHoleUnit () == LengthUnit::CLOUD;
       }},
      CHOICE (MaximumEdgeLength, 100.0),
      CHOICE (MaximumEdgeRatio, 100.0),
      CHOICE (MinimumComponentSize, 10),
      CHOICE (RemoveOutliers, false),
      CHOICE (ScatterPolicy, ScatterPolicy::DROP),
      CHOICE (OpenSelfIntersections, true),
      CHOICE (ComputeTextureCoordinates, true),
      CHOICE (LargestStretch, 1.5),
      CHOICE (Denoise, false),
      DISC_CHOICE (boundary.method, BoundaryMethod::CONSENSUS),
      CHOICE (KSearch, 12),
      DISC_CHOICE (boundary.opening_angle, 150.0),
      DISC_CHOICE (boundary.cluster_tolerance, 0.07),
      DISC_CHOICE (boundary.cluster_k, 12),
      DISC_CHOICE (domain.curve, Domain::SQUARE),
      DISC_CHOICE (domain.curve, Domain::POLYGON),
      DISC_CHOICE (domain.polygon_sides, 5),
      DISC_CHOICE (weighting, Weighting::UNIFORM),
      DISC_CHOICE (weighting, Weighting::INVERSE_DISTANCE),
      DISC_CHOICE (weighting, Weighting::SHAPE_PRESERVING),
      DISC_CHOICE (solver.ordering, Ordering::AMD),
      DISC_CHOICE (solver.ordering, Ordering::METIS),
      DISC_CHOICE (solver.ordering, Ordering::REVERSE_CUTHILL_MCKEE),
      DISC_CHOICE (solver.ordering, Ordering::NATURAL),
      CHOICE (Neighborhood, Neighborhood::NEAREST),
      CHOICE (Neighborhood, Neighborhood::BALL_DELAUNAY),
      CHOICE (Neighborhood, Neighborhood::BALL),
      CHOICE (BallRadius, 3.0),
      DISC_CHOICE (domain.curve, Domain::OWN_SHAPE),
      DISC_CHOICE (domain.loop_spacing, LoopSpacing::CENTRIPETAL),
      DISC_CHOICE (domain.loop_spacing, LoopSpacing::UNIFORM),
      DISC_CHOICE (solver.method, Solver::BICGSTAB_ILUT),
      DISC_CHOICE (solver.tolerance, 1e-12),
      DISC_CHOICE (solver.max_iterations, 500),
      DISC_CHOICE (solver.ilut_fill, 10),
      DISC_CHOICE (solver.ilut_drop, 1e-3),
      CHOICE (FilterSheets, false),
      CHOICE (FlipEdges, false),
      CHOICE (Facing, Facing::OUTWARDS),
      CHOICE (Facing, Facing::UP),
      CHOICE (RemoveSelfIntersections, false),
      CHOICE (ComputeNormals, true),
      CHOICE (NumberOfThreads, 1U),
  };
  const Cloud::Ptr cloud = heightField ();
  for (const Choice& choice : choices) {
    SCOPED_TRACE (choice.name);
    Floater floater;
    EXPECT_FALSE (choice.is_set (floater));
    choice.set (floater);
    EXPECT_TRUE (choice.is_set (floater));
    floater.setInputCloud (cloud);
    runDisc (floater, allOf (cloud->size ()));
    EXPECT_TRUE (choice.is_set (floater));
    const Floater copy (floater);
    EXPECT_TRUE (choice.is_set (copy));
  }
}

// Every policy for holes keeps the one loop of a height field, given the right parameters.
TEST_F (FloaterClass, TakesEveryTopologyAndPolicy)
{
  const Cloud::Ptr cloud = heightField ();
  const std::vector<Choice> topologies{CHOICE (Topology, Topology::AUTO),
                                       CHOICE (Topology, Topology::SURFACE)};
  const std::vector<Choice> policies{
      CHOICE (HolePolicy, HolePolicy::AUTO), CHOICE (HolePolicy, HolePolicy::KEEP_LARGEST),
      CHOICE (HolePolicy, HolePolicy::KEEP_COUNT), CHOICE (HolePolicy, HolePolicy::BY_SIZE)};
  for (const Choice& topology : topologies)
    for (const Choice& policy : policies) {
      SCOPED_TRACE (topology.name + ", " + policy.name);
      Floater floater;
      floater.setInputCloud (cloud);
      topology.set (floater);
      policy.set (floater);
      floater.setLargestHole (6.0);
      const Triangles triangles = runWell (floater);
      EXPECT_TRUE (topology.is_set (floater));
      EXPECT_TRUE (policy.is_set (floater));
      const MeshCheck& check = floater.getMeshCheck ();
      EXPECT_TRUE (check.done);
      EXPECT_EQ (check.components, 1U);
      EXPECT_EQ (check.euler_characteristic, 1);
      EXPECT_EQ (check.genus, 0);
      ASSERT_EQ (check.loops.size (), 1U);
      EXPECT_EQ (check.loops.front ().points, floater.getBoundaryLoop ().size ());
      expectDisc (triangles, allOf (cloud->size ()), floater.getBoundaryLoop ());
      EXPECT_TRUE (floater.getOutlierIndices ().empty ());
      EXPECT_NE (floater.getReport ().topology, Topology::AUTO);
    }
  Floater floater;
  floater.setInputCloud (cloud);
  floater.setTopology (Topology::AUTO);
  floater.setHolePolicy (HolePolicy::BY_SIZE); // without a size
  expectFailure (floater, RunStatus::INVALID_OPTION);
  floater.setHolePolicy (HolePolicy::AUTO);
  floater.setTopology (Topology::SURFACE);
  floater.setPrescribedLoop ({0, 1, 2});
  expectFailure (floater, RunStatus::INVALID_OPTION);
}

} // namespace
} // namespace pcl::floater

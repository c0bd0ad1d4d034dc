// SPDX-License-Identifier: GPL-3.0-or-later
// Setters and getters of FloaterReconstruction, and what parameters do to a run.
#include "mesh_check.h"

#include <functional>
#include <limits>

namespace pcl
{
namespace floater
{
namespace
{
/// A setter given a value, and whether the getter returns that value.
struct Choice
{
  std::string name;
  std::function<void (Floater&)> set;
  std::function<bool (const Floater&)> is_set;
};

#define CHOICE(parameter, value)                                                                   \
  Choice                                                                                           \
  {                                                                                                \
#parameter " " #value, [] (Floater& floater) { floater.set##parameter (value); },              \
        [] (const Floater& floater) { return floater.get##parameter () == (value); }   \
  }

TEST_F (FloaterClass, DefaultsAreThoseOfTheOptions)
{
  const Options defaults;
  const pcl::FloaterReconstruction<pcl::PointXYZ> floater;
  EXPECT_EQ (floater.getTopology (), defaults.topology);
  EXPECT_EQ (floater.getHolePolicy (), defaults.holes.policy);
  EXPECT_EQ (floater.getKeptLoops (), defaults.holes.kept_loops);
  EXPECT_EQ (floater.getLargestHole (), defaults.holes.largest_hole);
  EXPECT_EQ (floater.getLargestHoleLength (), defaults.holes.largest_hole_length);
  EXPECT_EQ (floater.getMaximumEdgeLength (), defaults.trimming.maximum_edge_length);
  EXPECT_EQ (floater.getMaximumEdgeRatio (), defaults.trimming.maximum_edge_ratio);
  EXPECT_EQ (floater.getMinimumComponentSize (), defaults.trimming.minimum_component_size);
  EXPECT_EQ (floater.getRemoveOutliers (), defaults.remove_outliers);
  EXPECT_EQ (floater.getDenoise (), defaults.denoise);
  EXPECT_EQ (floater.getKNearest (), defaults.neighbors.k);
  EXPECT_EQ (floater.getOpeningAngle (), defaults.boundary.opening_angle);
  EXPECT_EQ (floater.getClusterTolerance (), defaults.boundary.cluster_tolerance);
  EXPECT_EQ (floater.getClusterK (), defaults.boundary.cluster_k);
  EXPECT_EQ (floater.getBoundaryMethod (), defaults.boundary.method);
  EXPECT_EQ (floater.getDomain (), defaults.domain.curve);
  EXPECT_EQ (floater.getPolygonSides (), defaults.domain.polygon_sides);
  EXPECT_EQ (floater.getWeighting (), defaults.weighting);
  EXPECT_EQ (floater.getNeighborhood (), defaults.neighbors.kind);
  EXPECT_EQ (floater.getBallRadius (), defaults.neighbors.ball_radius);
  EXPECT_EQ (floater.getLoopSpacing (), defaults.domain.loop_spacing);
  EXPECT_EQ (floater.getSolver (), defaults.solver.method);
  EXPECT_EQ (floater.getOrdering (), defaults.solver.ordering);
  EXPECT_EQ (floater.getTolerance (), defaults.solver.tolerance);
  EXPECT_EQ (floater.getMaxIterations (), defaults.solver.max_iterations);
  EXPECT_EQ (floater.getIlutFill (), defaults.solver.ilut_fill);
  EXPECT_EQ (floater.getIlutDropTolerance (), defaults.solver.ilut_drop);
  EXPECT_EQ (floater.getFilterSheets (), defaults.filter_sheets);
  EXPECT_EQ (floater.getFlipEdges (), defaults.flip_edges);
  EXPECT_EQ (floater.getRemoveSelfIntersections (), defaults.remove_self_intersections);
  EXPECT_EQ (floater.getNumberOfThreads (), defaults.threads);
  EXPECT_EQ (floater.getNumberOfBlocks (), defaults.blocks);
  EXPECT_TRUE (floater.getPrescribedLoop ().empty ());
  EXPECT_FALSE (floater.getStageCallback ());
  EXPECT_FALSE (floater.getProgressCallback ());
  EXPECT_FALSE (floater.getCancelledCallback ());

  EXPECT_EQ (floater.getStatus (), Status::NOT_RUN);
  EXPECT_EQ (floater.getReport ().status, Status::NOT_RUN);
  EXPECT_TRUE (floater.getBoundaryLoop ().empty ());
  EXPECT_TRUE (floater.getParameters ().empty ());
  EXPECT_TRUE (floater.getOutlierIndices ().empty ());
  EXPECT_FALSE (floater.getMeshCheck ().done);
  EXPECT_EQ (floater.getStatistics ().cloud_points, 0U);
}

TEST_F (FloaterClass, EveryChoiceMakesADiscAndIsKept)
{
  const std::vector<Choice> choices{
      CHOICE (HolePolicy, HolePolicy::KEEP_LARGEST),
      CHOICE (KeptLoops, 3),
      CHOICE (LargestHole, 5.0),
      CHOICE (LargestHoleLength, 0.5),
      CHOICE (MaximumEdgeLength, 100.0),
      CHOICE (MaximumEdgeRatio, 100.0),
      CHOICE (MinimumComponentSize, 10),
      CHOICE (RemoveOutliers, false),
      CHOICE (Denoise, false),
      CHOICE (BoundaryMethod, BoundaryMethod::CONSENSUS),
      CHOICE (KNearest, 12),
      CHOICE (OpeningAngle, 150.0),
      CHOICE (ClusterTolerance, 0.07),
      CHOICE (ClusterK, 12),
      CHOICE (Domain, Domain::SQUARE),
      CHOICE (Domain, Domain::POLYGON),
      CHOICE (PolygonSides, 5),
      CHOICE (Weighting, Weighting::UNIFORM),
      CHOICE (Weighting, Weighting::INVERSE_DISTANCE),
      CHOICE (Weighting, Weighting::SHAPE_PRESERVING),
      CHOICE (Ordering, Ordering::AMD),
      CHOICE (Ordering, Ordering::METIS),
      CHOICE (Ordering, Ordering::REVERSE_CUTHILL_MCKEE),
      CHOICE (Ordering, Ordering::NATURAL),
      CHOICE (Neighborhood, Neighborhood::NEAREST),
      CHOICE (Neighborhood, Neighborhood::BALL_DELAUNAY),
      CHOICE (Neighborhood, Neighborhood::BALL),
      CHOICE (BallRadius, 3.0),
      CHOICE (Domain, Domain::OWN_SHAPE),
      CHOICE (LoopSpacing, LoopSpacing::CENTRIPETAL),
      CHOICE (LoopSpacing, LoopSpacing::UNIFORM),
      CHOICE (Solver, Solver::UMFPACK_UNSYMMETRIC),
      CHOICE (Solver, Solver::EIGEN_SPARSE_LU),
      CHOICE (Solver, Solver::BICGSTAB_ILUT),
      CHOICE (Tolerance, 1e-12),
      CHOICE (MaxIterations, 500),
      CHOICE (IlutFill, 10),
      CHOICE (IlutDropTolerance, 1e-3),
      CHOICE (FilterSheets, false),
      CHOICE (FlipEdges, false),
      CHOICE (RemoveSelfIntersections, false),
      CHOICE (NumberOfThreads, 1),
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

TEST_F (FloaterClass, RefusesValuesOutOfRange)
{
  constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN ();
  const std::vector<Choice> choices{
      CHOICE (HolePolicy, HolePolicy::CLOSE_ALL), // not for a disc
      CHOICE (HolePolicy, HolePolicy::KEEP_COUNT),
      CHOICE (HolePolicy, HolePolicy::BY_SIZE),
      CHOICE (KeptLoops, -1),
      CHOICE (LargestHole, -0.5),
      CHOICE (LargestHoleLength, -1e-9),
      CHOICE (KNearest, 5),
      CHOICE (KNearest, 201),
      CHOICE (OpeningAngle, 0.0),
      CHOICE (OpeningAngle, 360.0),
      {"OpeningAngle NaN", [] (Floater& floater) { floater.setOpeningAngle (NOT_A_NUMBER); },
       [] (const Floater& floater) {
         return floater.getOpeningAngle () != floater.getOpeningAngle ();
       }},
      CHOICE (ClusterTolerance, 0.0),
      CHOICE (ClusterTolerance, 1.5),
      CHOICE (ClusterK, 0),
      CHOICE (PolygonSides, 2),
      CHOICE (NumberOfThreads, -1),
      CHOICE (Ordering, Ordering::COLAMD), // not for the default solver
      CHOICE (BallRadius, 0.5),
      CHOICE (BallRadius, 11.0),
      CHOICE (Tolerance, 0.0),
      CHOICE (Tolerance, 1.0),
      CHOICE (MaxIterations, 0),
      CHOICE (IlutFill, 0),
      CHOICE (IlutDropTolerance, 1.5),
  };
  const Cloud::Ptr cloud = heightField (100);
  for (const Choice& choice : choices) {
    SCOPED_TRACE (choice.name);
    Floater floater;
    floater.setInputCloud (cloud);
    choice.set (floater);
    expectFailure (floater, Status::INVALID_OPTION);
    EXPECT_TRUE (choice.is_set (floater)); // refused, not replaced
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
  expectFailure (floater, Status::INVALID_OPTION);
  floater.setHolePolicy (HolePolicy::AUTO);
  floater.setTopology (Topology::SURFACE);
  floater.setPrescribedLoop ({0, 1, 2});
  expectFailure (floater, Status::INVALID_OPTION);
}

TEST_F (FloaterClass, LongEdgesAreCutOff)
{
  const Cloud::Ptr cloud = heightField ();
  for (const Topology topology : {Topology::DISC, Topology::SURFACE}) {
    pcl::FloaterReconstruction<pcl::PointXYZ> floater;
    floater.setInputCloud (cloud);
    floater.setTopology (topology);
    pcl::PolygonMesh whole, mesh;
    floater.reconstruct (whole);
    floater.setMaximumEdgeLength (1.5);
    floater.reconstruct (mesh);
    ASSERT_EQ (floater.getStatus (), Status::OK) << floater.getMessage ();
    EXPECT_GT (floater.getStatistics ().trimmed_triangles, 0U);
    EXPECT_EQ (mesh.polygons.size () + floater.getStatistics ().trimmed_triangles,
               whole.polygons.size ());
    EXPECT_EQ (floater.getUnusedIndices ().size (), floater.getStatistics ().trimmed_points);
    for (const pcl::Vertices& polygon : mesh.polygons)
      for (std::size_t i = 0; i < 3; ++i) {
        const pcl::PointXYZ& a = (*cloud)[polygon.vertices[i]];
        const pcl::PointXYZ& b = (*cloud)[polygon.vertices[(i + 1) % 3]];
        EXPECT_LE ((a.getVector3fMap () - b.getVector3fMap ()).norm (), 1.5F + 1e-6F);
      }
    floater.setMaximumEdgeRatio (-1.0);
    floater.reconstruct (mesh);
    EXPECT_EQ (floater.getStatus (), Status::INVALID_OPTION);
    EXPECT_TRUE (mesh.polygons.empty ());
  }
}

// The octree for balls is that of the points that are left.
TEST_F (FloaterClass, AGrossOutlierDoesNotHarmBalls)
{
  const Cloud::Ptr cloud = heightField ();
  pcl::FloaterReconstruction<pcl::PointXYZ> floater;
  floater.setNeighborhood (Neighborhood::BALL_DELAUNAY);
  floater.setInputCloud (cloud);
  pcl::PolygonMesh expected, mesh;
  floater.reconstruct (expected);
  const Cloud::Ptr with_outlier (new Cloud (*cloud));
  with_outlier->push_back (pcl::PointXYZ (std::numeric_limits<float>::max (), 0.0F, 0.0F));
  floater.setInputCloud (with_outlier);
  floater.reconstruct (mesh);
  ASSERT_EQ (floater.getStatus (), Status::OK) << floater.getMessage ();
  EXPECT_EQ (floater.getOutlierIndices (), pcl::Indices (1, 500));
  ASSERT_EQ (mesh.polygons.size (), expected.polygons.size ());
  for (std::size_t t = 0; t < mesh.polygons.size (); ++t)
    EXPECT_EQ (mesh.polygons[t].vertices, expected.polygons[t].vertices);
}

// A given loop is the boundary of a disc, whatever topology is to be found.
TEST_F (FloaterClass, AGivenLoopMakesADisc)
{
  Floater floater;
  floater.setInputCloud (heightField ());
  const Triangles expected = runWell (floater);
  EXPECT_EQ (floater.getReport ().topology, Topology::DISC);
  const pcl::Indices loop = floater.getBoundaryLoop ();
  floater.setTopology (Topology::AUTO);
  floater.setPrescribedLoop (loop);
  EXPECT_EQ (runWell (floater), expected);
  EXPECT_EQ (floater.getReport ().topology, Topology::DISC);
  EXPECT_FALSE (floater.getParameters ().empty ());
}

TEST_F (FloaterClass, ParametersChangeTheRun)
{
  Floater floater;
  floater.setInputCloud (heightField ());
  runWell (floater);
  const std::vector<Eigen::Vector2d> on_circle = floater.getParameters ();
  floater.setWeighting (Weighting::UNIFORM);
  runWell (floater);
  EXPECT_NE (floater.getParameters (), on_circle);
  floater.setWeighting (Weighting::MEAN_VALUE);
  floater.setFlipEdges (false);
  runWell (floater);
  EXPECT_EQ (floater.getParameters (), on_circle);
  EXPECT_EQ (floater.getStatistics ().flips, 0U);

  // Border points lie on the domain. On a triangle they are at least half as far from the centre as
  // its corners, on the circle all equally far.
  floater.setDomain (Domain::POLYGON);
  floater.setPolygonSides (3);
  runWell (floater);
  double nearest = 1.0;
  for (const pcl::index_t i : floater.getBoundaryLoop ())
    nearest = std::min (nearest, floater.getParameters ()[static_cast<std::size_t> (i)].norm ());
  EXPECT_GE (nearest, 0.5 - 1e-12);
  EXPECT_LT (nearest, 0.6);
  for (const pcl::index_t i : floater.getBoundaryLoop ())
    EXPECT_NEAR (on_circle[static_cast<std::size_t> (i)].norm (), 1.0, 1e-12);
}

TEST_F (FloaterClass, TwoSegmentsFollowTheClusterParameters)
{
  // The border of 500 points is sparse: the distance that suits a real scan is too short for it.
  Floater floater;
  floater.setInputCloud (heightField ());
  floater.setBoundaryMethod (BoundaryMethod::TWO_SEGMENTS);
  floater.setClusterTolerance (0.2);
  runDisc (floater, allOf (500));
  EXPECT_EQ (floater.getBoundaryMethod (), BoundaryMethod::TWO_SEGMENTS);
  const std::size_t whole = floater.getBoundaryLoop ().size ();
  EXPECT_EQ (floater.getStatistics ().boundary_candidates, whole);

  floater.setOpeningAngle (140.0); // more points see a sector as wide as that
  runDisc (floater, allOf (500));
  EXPECT_GT (floater.getBoundaryLoop ().size (), whole);

  // A cluster that may not grow so far holds only a part of the border.
  const auto expect_less = [&floater, whole] {
    Cloud points;
    Polygons polygons;
    testing::internal::CaptureStderr ();
    floater.reconstruct (points, polygons);
    testing::internal::GetCapturedStderr ();
    EXPECT_LT (floater.getBoundaryLoop ().size (), whole);
    EXPECT_EQ (floater.getStatistics ().boundary_candidates, whole);
  };
  floater.setOpeningAngle (160.0);
  floater.setClusterTolerance (0.05);
  expect_less ();
  floater.setClusterTolerance (0.2);
  floater.setClusterK (1);
  expect_less ();
}

TEST_F (FloaterClass, ThreadsDoNotChangeTheResult)
{
  const Cloud::Ptr cloud = makeCloud<pcl::PointXYZ> (SurfaceKind::HEMISPHERE, 3000);
  Floater floater;
  floater.setInputCloud (cloud);
  Cloud points;
  Polygons polygons;
  floater.setNumberOfThreads (1);
  floater.reconstruct (points, polygons);
  ASSERT_EQ (floater.getStatus (), Status::OK);
  const std::vector<Eigen::Vector2d> parameters = floater.getParameters ();
  const pcl::Indices loop = floater.getBoundaryLoop ();
  for (const int threads : {2, 5, 0}) {
    SCOPED_TRACE (threads);
    floater.setNumberOfThreads (threads);
    floater.setNumberOfBlocks (threads);
    Polygons again;
    floater.reconstruct (points, again);
    ASSERT_EQ (again.size (), polygons.size ());
    for (std::size_t i = 0; i < polygons.size (); ++i)
      ASSERT_EQ (again[i].vertices, polygons[i].vertices);
    EXPECT_EQ (floater.getParameters (), parameters);
    EXPECT_EQ (floater.getBoundaryLoop (), loop);
  }
}

TEST_F (FloaterClass, TakesTheUsersLoop)
{
  const Cloud::Ptr cloud = heightField ();
  Floater floater;
  floater.setInputCloud (cloud);
  const Triangles expected = runWell (floater);
  pcl::Indices loop = floater.getBoundaryLoop ();

  std::rotate (loop.begin (), loop.begin () + 5, loop.end ());
  floater.setPrescribedLoop (loop);
  EXPECT_EQ (floater.getPrescribedLoop (), loop);
  EXPECT_EQ (runWell (floater), expected);
  EXPECT_EQ (floater.getPrescribedLoop (), loop);
  const std::set<pcl::index_t> members (loop.begin (), loop.end ());
  const pcl::Indices found = floater.getBoundaryLoop ();
  EXPECT_EQ (std::set<pcl::index_t> (found.begin (), found.end ()), members);

  std::reverse (loop.begin (), loop.end ());
  floater.setPrescribedLoop (loop);
  const Triangles reversed = runWell (floater);
  EXPECT_TRUE (reversed == expected || turnedOver (reversed) == expected);

  // A given loop is used as it is: a border point that it leaves out becomes interior, or is cut
  // off.
  loop.erase (loop.begin ());
  floater.setPrescribedLoop (loop);
  runWell (floater);
  EXPECT_EQ (floater.getBoundaryLoop ().size (), loop.size ());

  floater.setPrescribedLoop ({});
  EXPECT_EQ (runWell (floater), expected);
}

TEST_F (FloaterClass, RefusesLoopsThatAreNone)
{
  const Cloud::Ptr cloud = heightField (200);
  Floater floater;
  floater.setInputCloud (cloud);
  runWell (floater);
  const pcl::Indices loop = floater.getBoundaryLoop ();
  const auto with = [&loop] (pcl::index_t last) {
    pcl::Indices changed = loop;
    changed.back () = last;
    return changed;
  };
  cloud->push_back (pcl::PointXYZ (0.0F, 0.0F, std::numeric_limits<float>::quiet_NaN ()));
  const std::vector<pcl::Indices> wrong{
      {loop[0], loop[1]}, with (loop.front ()), with (200), with (201), with (-1)};
  for (const pcl::Indices& loop_given : wrong) {
    SCOPED_TRACE (loop_given.back ());
    floater.setPrescribedLoop (loop_given);
    expectFailure (floater, Status::INVALID_LOOP);
  }
  // A point of the loop that is not selected.
  pcl::IndicesPtr indices (new pcl::Indices);
  for (pcl::index_t i = 0; i < 200; ++i)
    if (i != loop[4])
      indices->push_back (i);
  floater.setIndices (indices);
  floater.setPrescribedLoop (loop);
  expectFailure (floater, Status::INVALID_LOOP);
}

TEST_F (FloaterClass, ReportsASolverThatGaveUp)
{
  Floater floater;
  floater.setInputCloud (heightField ());
  floater.setSolver (Solver::GAUSS_SEIDEL);
  floater.setMaxIterations (20);
  expectFailure (floater, Status::NOT_CONVERGED);
  EXPECT_EQ (floater.getStatistics ().iterations_u, 20U);
  floater.setSolver (Solver::BICGSTAB_ILUT);
  runWell (floater);
  EXPECT_GT (floater.getStatistics ().iterations_u, 0U);
  EXPECT_LT (floater.getStatistics ().relative_residual, 1e-14);
}

} // namespace
} // namespace floater
} // namespace pcl

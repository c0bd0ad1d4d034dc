// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Values that FloaterReconstruction refuses, and a solver that gives up.
#include "parameter_choice.h"

#include <cmath>
#include <limits>
#include <set>

namespace pcl::floater {
namespace {
TEST_F (FloaterClass, RefusesValuesOutOfRange)
{
  constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN ();
  const std::vector<Choice> choices{
      CHOICE (HolePolicy, HolePolicy::CLOSE_ALL), // not for a disc
      CHOICE (HolePolicy, HolePolicy::KEEP_COUNT),
      CHOICE (HolePolicy, HolePolicy::BY_SIZE),
      CHOICE (KeptLoops, -1),
      CHOICE (LargestHole, -0.5),
      {"LargestHole NaN", [] (Floater& floater) { floater.setLargestHole (NOT_A_NUMBER); },
       [] (const Floater& floater) { return std::isnan (floater.getLargestHole ()); }},
      CHOICE (KSearch, 5),
      CHOICE (KSearch, 201),
      DISC_CHOICE (boundary.opening_angle, 0.0),
      DISC_CHOICE (boundary.opening_angle, 360.0),
      {"opening angle NaN",
       [] (Floater& floater) {
         DiscOptions options;
         options.boundary.opening_angle = NOT_A_NUMBER;
         floater.setDiscOptions (options);
       },
       [] (const Floater& floater) {
         return std::isnan (floater.getDiscOptions ().boundary.opening_angle);
       }},
      DISC_CHOICE (boundary.cluster_tolerance, 0.0),
      DISC_CHOICE (boundary.cluster_tolerance, 1.5),
      DISC_CHOICE (boundary.cluster_k, 0),
      DISC_CHOICE (domain.polygon_sides, 2),
      CHOICE (NumberOfThreads, static_cast<unsigned int> (-1)),
      DISC_CHOICE (solver.ordering, Ordering::COLAMD), // no longer offered
      CHOICE (BallRadius, 0.5),
      CHOICE (BallRadius, 11.0),
      DISC_CHOICE (solver.tolerance, 0.0),
      DISC_CHOICE (solver.tolerance, 1.0),
      DISC_CHOICE (solver.max_iterations, 0),
      DISC_CHOICE (solver.ilut_fill, 0),
      DISC_CHOICE (solver.ilut_drop, 1.5),
  };
  const Cloud::Ptr cloud = heightField (100);
  for (const Choice& choice : choices) {
    SCOPED_TRACE (choice.name);
    Floater floater;
    floater.setInputCloud (cloud);
    choice.set (floater);
    expectFailure (floater, RunStatus::INVALID_OPTION);
    EXPECT_TRUE (choice.is_set (floater)); // refused, not replaced
  }
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
    expectFailure (floater, RunStatus::INVALID_LOOP);
  }
  // A point of the loop that is not selected.
  pcl::IndicesPtr indices (new pcl::Indices);
  for (pcl::index_t i = 0; i < 200; ++i)
    if (i != loop[4])
      indices->push_back (i);
  floater.setIndices (indices);
  floater.setPrescribedLoop (loop);
  expectFailure (floater, RunStatus::INVALID_LOOP);
}

TEST_F (FloaterClass, ReportsASolverThatGaveUp)
{
  Floater floater;
  floater.setInputCloud (heightField ());
  DiscOptions options;
  options.solver.method = Solver::GAUSS_SEIDEL;
  options.solver.max_iterations = 20;
  floater.setDiscOptions (options);
  expectFailure (floater, RunStatus::NOT_CONVERGED);
  EXPECT_EQ (floater.getStatistics ().iterations_u, 20U);
  options.solver.method = Solver::BICGSTAB_ILUT;
  floater.setDiscOptions (options);
  runWell (floater);
  EXPECT_GT (floater.getStatistics ().iterations_u, 0U);
  EXPECT_LT (floater.getStatistics ().relative_residual, 1e-14);
}

} // namespace
} // namespace pcl::floater

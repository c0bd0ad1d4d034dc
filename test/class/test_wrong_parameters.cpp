// SPDX-License-Identifier: GPL-3.0-or-later
// Values that FloaterReconstruction refuses, and a solver that gives up.
#include "parameter_choice.h"

#include <limits>
#include <set>

namespace pcl
{
namespace floater
{
namespace
{
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
  floater.setSolver (Solver::GAUSS_SEIDEL);
  floater.setMaxIterations (20);
  expectFailure (floater, RunStatus::NOT_CONVERGED);
  EXPECT_EQ (floater.getStatistics ().iterations_u, 20U);
  floater.setSolver (Solver::BICGSTAB_ILUT);
  runWell (floater);
  EXPECT_GT (floater.getStatistics ().iterations_u, 0U);
  EXPECT_LT (floater.getStatistics ().relative_residual, 1e-14);
}

} // namespace
} // namespace floater
} // namespace pcl

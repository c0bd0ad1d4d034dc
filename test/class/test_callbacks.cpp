// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Callbacks of FloaterReconstruction: stages, progress, cancellation.
#include "mesh_check.h"

#include <pcl/console/print.h>

#include <stdexcept>

namespace pcl::floater {
namespace {
TEST_F (FloaterClass, CallsBackForEachStage)
{
  std::vector<Stage> stages;
  Floater floater;
  floater.setInputCloud (heightField ());
  floater.setStageCallback ([&stages] (Stage stage) { stages.push_back (stage); });
  ASSERT_TRUE (floater.getStageCallback ());
  runWell (floater);
  const std::vector<Stage> all{Stage::WORKING_SET, Stage::NEIGHBORS, Stage::STARS,
                               Stage::BOUNDARY,    Stage::WEIGHTS,   Stage::SOLVE,
                               Stage::DELAUNAY,    Stage::FLIPS,     Stage::CHECK};
  EXPECT_EQ (stages, all);

  floater.setStageCallback ([] (Stage) { throw std::runtime_error ("enough of this"); });
  expectFailure (floater, RunStatus::INTERNAL_ERROR);
  EXPECT_NE (floater.getMessage ().find ("enough of this"), std::string::npos);
  floater.setStageCallback ([] (Stage) { throw 1; });
  expectFailure (floater, RunStatus::INTERNAL_ERROR);
  floater.setStageCallback (nullptr);
  runWell (floater);
}

TEST_F (FloaterClass, ReportsProgressAndCanBeCancelled)
{
  double done = -1.0;
  Floater floater;
  floater.setInputCloud (heightField ());
  floater.setProgressCallback ([&done] (double fraction) { done = fraction; });
  ASSERT_TRUE (floater.getProgressCallback ());
  runWell (floater);
  EXPECT_EQ (done, 1.0);

  floater.setCancelledCallback ([&done] { return done > 0.1; });
  ASSERT_TRUE (floater.getCancelledCallback ());
  done = 0.0;
  expectFailure (floater, RunStatus::CANCELLED);
  EXPECT_GT (done, 0.0);
  EXPECT_LT (done, 1.0);
  EXPECT_NE (floater.getMessage ().find ("cancelled"), std::string::npos);

  // That is no error: who wants to see errors only sees nothing.
  const auto printed = [&floater] {
    pcl::PolygonMesh mesh;
    testing::internal::CaptureStderr ();
    floater.reconstruct (mesh);
    return testing::internal::GetCapturedStderr ();
  };
  const pcl::console::VERBOSITY_LEVEL level = pcl::console::getVerbosityLevel ();
  pcl::console::setVerbosityLevel (pcl::console::L_ERROR);
  done = 0.0;
  EXPECT_EQ (printed (), "");
  EXPECT_EQ (floater.getStatus (), RunStatus::CANCELLED);
  floater.setNumberOfBlocks (-1);
  EXPECT_NE (printed (), "");
  floater.setNumberOfBlocks (0);
  pcl::console::setVerbosityLevel (level);

  floater.setCancelledCallback (nullptr);
  runWell (floater);
}

} // namespace
} // namespace pcl::floater

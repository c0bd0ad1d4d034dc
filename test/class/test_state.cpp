// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What an object of FloaterReconstruction consists of, and its copies.
#include "mesh_check.h"

#include <memory>
#include <type_traits>

namespace pcl::floater {
namespace {
// Programs have the size of the class compiled into them: it must not grow with the options.
struct BaseAndPointer : pcl::SurfaceReconstruction<pcl::PointXYZ>
{
  std::unique_ptr<int> pointer;
};
static_assert (sizeof (pcl::FloaterReconstruction<pcl::PointXYZ>) == sizeof (BaseAndPointer),
               "the class has nothing but its base and a pointer");
static_assert (sizeof (ReconstructionState) == sizeof (void*), "the state is behind a pointer");
// Nor may anyone take the state for a whole object.
static_assert (!std::is_destructible_v<ReconstructionState> &&
                   !std::is_default_constructible_v<ReconstructionState>,
               "the state is a part of an object");

TEST_F (FloaterClass, ACopyHasOptionsAndResultsOfItsOwn)
{
  Floater floater;
  const Cloud::Ptr cloud = heightField ();
  floater.setInputCloud (cloud);
  floater.setKSearch (12);
  const Triangles expected = runWell (floater);

  Floater copy (floater);
  EXPECT_EQ (copy.getKSearch (), 12);
  EXPECT_EQ (copy.getStatus (), RunStatus::SUCCESS);
  EXPECT_EQ (copy.getBoundaryLoop (), floater.getBoundaryLoop ());
  EXPECT_EQ (copy.getParameters (), floater.getParameters ());
  EXPECT_EQ (runWell (copy), expected);

  copy.setKSearch (5);
  expectFailure (copy, RunStatus::INVALID_OPTION);
  EXPECT_EQ (floater.getKSearch (), 12);
  EXPECT_EQ (floater.getStatus (), RunStatus::SUCCESS);

  copy = floater;
  EXPECT_EQ (copy.getKSearch (), 12);
  EXPECT_EQ (copy.getStatus (), RunStatus::SUCCESS);
  const Floater& same = copy;
  copy = same; // to itself
  EXPECT_EQ (copy.getKSearch (), 12);
  EXPECT_EQ (runWell (copy), expected);

  // What is moved from may be used again.
  Floater moved (std::move (copy));
  EXPECT_EQ (moved.getKSearch (), 12);
  copy.setInputCloud (cloud); // NOLINT(bugprone-use-after-move)
  copy.setKSearch (14);
  runWell (copy);
  EXPECT_EQ (moved.getKSearch (), 12);
}

// A callback that sets an option sets it for the next run.
TEST_F (FloaterClass, ACallbackMaySetOptions)
{
  Floater floater;
  floater.setInputCloud (heightField ());
  const Triangles expected = runWell (floater);
  floater.setStageCallback ([&floater] (Stage) {
    floater.setKSearch (5);
    floater.setStageCallback (nullptr);
  });
  EXPECT_EQ (runWell (floater), expected);
  EXPECT_EQ (floater.getKSearch (), 5);
  expectFailure (floater, RunStatus::INVALID_OPTION);
}

} // namespace
} // namespace pcl::floater

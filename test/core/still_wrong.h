// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Expectations that are right but not met yet, on one list so that none is forgotten.
#pragma once

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <set>
#include <string>

namespace pcl::floater {
/// Cases that do not work yet. They are skipped as long as they fail. A case that works fails until
/// it is taken off this list.
inline const std::set<std::string>&
stillWrong ()
{
  static const std::set<std::string> names{
      // Outliers less than 10 spacings away in the plane of a sheet are taken for a part of it.
      "sphere_outliers_near",
      // Close sheets: a thin body without points at its sides has the same.
      "parallel_2"};
  return names;
}

/// Calls `expect`. If the case is known to be wrong, its failures skip the test instead.
inline void
expectUnlessStillWrong (const std::string& name, const std::function<void ()>& expect)
{
  if (stillWrong ().count (name) == 0 || std::getenv ("PCL_FLOATER_SHOW_WRONG") != nullptr) {
    expect ();
    return;
  }
  testing::TestPartResultArray results;
  {
    testing::ScopedFakeTestPartResultReporter catch_failures (
        testing::ScopedFakeTestPartResultReporter::INTERCEPT_ALL_THREADS, &results);
    expect ();
  }
  std::string what;
  for (int i = 0; i < results.size (); ++i)
    if (results.GetTestPartResult (i).failed ())
      what += "\n" + std::string (results.GetTestPartResult (i).message ());
  EXPECT_NE (what, "") << name << " works now: take it off the list";
  if (!what.empty ())
    GTEST_SKIP () << name << " is still wrong:" << what;
}

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Curves are no surface; parallel lines on a sheet are one.
#include "points/point_samples.h"

#include <pcl/surface/floater/reconstruct.h>

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::Positions;

// Waving curves of 100 points, at this many times their steps.
Positions
curves (int count, double apart)
{
  RandomStream random (1);
  Positions positions;
  for (int i = 0; i < count; ++i)
    for (int step = 0; step < 100; ++step)
      positions.emplace_back (step + 0.2 * random.uniform (), i * apart,
                              5.0 * std::sin (0.05 * step));
  return positions;
}

RunStatus
statusOf (const Positions& positions, std::string& message)
{
  Options options;
  options.threads = 1;
  options.view.use = ViewUse::NEVER;
  Report report = reconstruct (positions, options).report;
  message = report.message;
  return report.status;
}

TEST (Curves, AreRefused)
{
  std::string message;
  EXPECT_EQ (statusOf (curves (1, 0.0), message), RunStatus::DEGENERATE);
  EXPECT_NE (message.find ("profiles"), std::string::npos) << message;
  EXPECT_EQ (statusOf (curves (3, 300.0), message), RunStatus::DEGENERATE);
  EXPECT_NE (message.find (" times as far apart"), std::string::npos) << message;
}

TEST (Curves, OnASheetAreNone)
{
  std::string message;
  for (const double apart : {1.0, 5.0, 10.0, 20.0, 30.0})
    EXPECT_EQ (statusOf (curves (12, apart), message), RunStatus::SUCCESS) << apart << message;
}

} // namespace
} // namespace pcl::floater

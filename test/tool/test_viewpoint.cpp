// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Single scans: --viewpoint, and the viewpoint of a PCD file.
#include "command_line_test.h"
#include "mesh_files.h"

#include <cmath>

namespace pcl::floater {
namespace {
class ViewpointTest : public CommandLineTest
{
protected:
  // A square before a wall, seen from (1, 2, 3).
  ViewpointTest ()
  {
    for (int i = 0; i < 90; ++i)
      for (int j = 0; j < 80; ++j) {
        const double noise = 0.02 * std::sin (17.0 * i + 29.0 * j * j);
        const double depth = (i > 30 && i < 60 && j > 30 && j < 60 ? 1.0 : 2.0) + noise;
        scan_.emplace_back (1.0 + 0.01 * depth * (i - 45), 2.0 + 0.01 * depth * (j - 40),
                            3.0 + depth);
      }
    text_ = pcdText (scan_);
    writeFile ("scan.pcd", withViewpoint ("1 2 3 1 0 0 0"));
    writeFile ("origin.pcd", withViewpoint ("0 0 0 1 0 0 0"));
  }

  std::string withViewpoint (const std::string& viewpoint) const
  {
    const std::size_t begin = text_.find ("VIEWPOINT"), end = text_.find ('\n', begin);
    EXPECT_NE (begin, std::string::npos);
    std::string changed = text_;
    return changed.replace (begin, end - begin, "VIEWPOINT " + viewpoint);
  }

  Json reportOf (std::vector<std::string> options) const
  {
    options.insert (options.end (), {"out.ply", "--report", "out.json"});
    const Outcome outcome = run (options);
    EXPECT_EQ (outcome.code, 0) << outcome.err;
    EXPECT_NE (outcome.out.find ("viewpoint  at "), std::string::npos) << outcome.out;
    return Json::parse (readFile ("out.json"));
  }

  std::vector<Eigen::Vector3d> scan_;
  std::string text_;
};

void
expectPlace (const Json& report, double x, double y, double z)
{
  const Json& viewpoint = report.at ("viewpoint");
  ASSERT_TRUE (viewpoint.is_object ());
  EXPECT_EQ (viewpoint.at ("is_far"), false);
  EXPECT_EQ (viewpoint.at ("by_pixels"), false);
  EXPECT_NEAR (viewpoint.at ("place").at (0).get<double> (), x, 1e-6);
  EXPECT_NEAR (viewpoint.at ("place").at (1).get<double> (), y, 1e-6);
  EXPECT_NEAR (viewpoint.at ("place").at (2).get<double> (), z, 1e-6);
}

TEST_F (ViewpointTest, ThatOfTheFileIsTried)
{
  const Json report = reportOf ({"scan.pcd"});
  expectPlace (report, 1.0, 2.0, 3.0);
  EXPECT_GT (report.at ("statistics").at ("view_steps").get<int> (), 100);
}

TEST_F (ViewpointTest, ItIsShiftedWithThePoints)
{
  expectPlace (reportOf ({"scan.pcd", "--shift", "1,1,1"}), 0.0, 1.0, 2.0);
  expectPlace (reportOf ({"origin.pcd", "--viewpoint", "1,2,3", "--shift", "1,1,1"}), 0.0, 1.0,
               2.0);
}

TEST_F (ViewpointTest, AWrongLineInTheFileIsTold)
{
  writeFile ("bad.pcd", withViewpoint ("1 2 north 1 0 0 0"));
  const Outcome outcome = run ({"bad.pcd", "out.ply"});
  EXPECT_NE (outcome.code, 0);
  EXPECT_NE (outcome.err.find ("north"), std::string::npos) << outcome.err;
}

} // namespace
} // namespace pcl::floater

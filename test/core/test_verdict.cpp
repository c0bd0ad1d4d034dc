// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The verdict on a mesh.
#include "report/verdict.h"

#include "reconstruct.h"
#include "surface_samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;

void
expectIn (const std::string& text, const std::string& part)
{
  EXPECT_NE (text.find (part), std::string::npos) << text;
}

Report
cleanReport ()
{
  Report report;
  report.statistics.working_points = 5000;
  report.statistics.triangles = 10000;
  report.check.largest_area_share = 0.02;
  return report;
}

TEST (Verdict, OfAMeshWithoutFlawsIsGood)
{
  const Verdict verdict = judge (cleanReport ());
  EXPECT_EQ (verdict.value, Quality::GOOD);
  EXPECT_EQ (verdict.cause + verdict.remedy, "");
}

TEST (Verdict, CrossingTrianglesAreExplainedByWhatIsAround)
{
  Report report = cleanReport ();
  report.check.self_intersections = 6;
  EXPECT_EQ (judge (report).value, Quality::USABLE);
  expectIn (judge (report).cause, "6 pairs of triangles cross, one for each 1667 triangles");
  report.check.self_intersections = 500;
  EXPECT_EQ (judge (report).value, Quality::POOR);
  expectIn (judge (report).cause, "sheets");
  report.scatter.resize (200);
  expectIn (judge (report).remedy, "--scatter drop");
  report.statistics.projected_points = 3000;
  report.statistics.noise_quantile_90 = 0.75;
  expectIn (judge (report).cause, "noisy (90 % of them by less than 0.75");
  expectIn (judge (report).remedy, "voxel grid");
  report.statistics.stacked_points = 4000;
  expectIn (judge (report).cause, "on one another");
  report.statistics.coordinate_step = 0.5;
  expectIn (judge (report).cause, "coarse");
  expectIn (judge (report).remedy, "more digits");
  report.findings.push_back ({FindingId::COORDINATES_IN_FLOAT, {}, {0, 1, 2}, {}});
  expectIn (judge (report).remedy, "--shift");
}

TEST (Verdict, TheWorstMeasureIsTheCause)
{
  Report report = cleanReport ();
  report.check.largest_area_share = 0.95;
  report.check.self_intersections = 6;
  EXPECT_EQ (judge (report).value, Quality::POOR);
  expectIn (judge (report).cause, "95 % of the area");
  report.is_view = true; // far surfaces have few, large triangles
  report.check.self_intersections = 0;
  EXPECT_EQ (judge (report).value, Quality::USABLE);
  expectIn (judge (report).cause, "seen edge-on");
  report.check.largest_area_share = 0.1;
  EXPECT_EQ (judge (report).value, Quality::GOOD);
  report.check.folds = 700;
  expectIn (judge (report).cause, "700 edges are folded");
  report.statistics.view_steps = 300;
  report.statistics.view_gaps = 800;
  expectIn (judge (report).cause, "9.9 % of the view is open");
  report.unused.resize (600);
  expectIn (judge (report).cause, "12 % of the points are in no triangle");
  EXPECT_EQ (judge (report).value, Quality::POOR);
  report = cleanReport ();
  report.scatter.resize (1000);
  expectIn (judge (report).cause, "17 % of the points lie on no surface");
  report = cleanReport ();
  report.outliers.resize (1000);
  expectIn (judge (report).cause, "17 % of the points lie off any surface");
  report = cleanReport ();
  report.findings.push_back ({FindingId::LONG_EDGES, {}, {50, 20}, {}});
  expectIn (judge (report).cause, "longer");
  report.findings = {{FindingId::GUESSED_UP, {}, {1}, {}}};
  expectIn (judge (report).cause, "guess");
  report.findings = {{FindingId::NO_AREA, {}, {2}, {}}};
  expectIn (judge (report).cause, "no area");
  report.findings = {{FindingId::SMALL_HOLES, {}, {1, 10}, {}}};
  expectIn (judge (report).cause, "holes stay open");
  report.is_view = true; // rays are missing there
  EXPECT_EQ (judge (report).value, Quality::GOOD);
  report.findings = {{FindingId::DEEP_HOLES, {}, {1, 10}, {}}};
  expectIn (judge (report).cause, "holes stay open");
  report.findings = {{FindingId::ONE_SIDED, {}, {8}, {}}};
  expectIn (judge (report).cause, "one-sided");
}

TEST (Verdict, TheLargestHundredthOfTheTrianglesIsMeasured)
{
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < 200; ++i) {
    const double size = i % 100 == 7 ? 10.0 : 1.0; // two of 200
    positions.insert (positions.end (), {{0, 0, 0}, {size, 0, 0}, {0, size, 0}});
    triangles.push_back ({3 * i, 3 * i + 1, 3 * i + 2});
  }
  EXPECT_NEAR (largestAreaShare (triangles, positions), 200.0 / 398.0, 1e-6);
  EXPECT_EQ (largestAreaShare ({}, {}), 0.0);
  triangles.resize (99); // with one of the large ones, which few triangles may have
  EXPECT_EQ (largestAreaShare (triangles, positions), 0.0);
}

TEST (Verdict, OfGeneratedClouds)
{
  const auto of = [] (const Positions& points) { return reconstruct (points, {}).report.verdict; };
  for (const Positions& clean :
       {sheetWithHoles (3, 15.0, 5.0, 5.0, 2).points,
        prism ({rectangle (25.0, 18.0)}, 15.0, 1).points, evenSphere (300), latticeCube (5)})
    EXPECT_EQ (of (clean).value, Quality::GOOD);
  const KnownSurface noisy = withNoise (sheetWithHoles (1, 25.0, 10.0, 10.0, 1), 0.5, 6);
  EXPECT_EQ (of (noisy.points).value, Quality::USABLE);
  Positions rough = evenSphere (300);
  RandomStream random (17);
  for (Eigen::Vector3d& p : rough)
    p *= 0.82 + 0.36 * random.uniform ();
  expectIn (of (rough).cause, "too few for the shape");
}

TEST (Verdict, ThereIsNoneWithoutAMesh)
{
  const Result result = reconstruct (Positions (5, Eigen::Vector3d::Zero ()), {});
  EXPECT_EQ (result.report.verdict.value, Quality::NO_MESH);
  EXPECT_STREQ (qualityName (Quality::NO_MESH), "none");
  EXPECT_STREQ (qualityName (Quality::POOR), "poor");
}

} // namespace
} // namespace pcl::floater

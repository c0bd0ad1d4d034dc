// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Warnings on a mesh, in words that fit their numbers.
#include "report/findings.h"
#include "report/report_mesh.h"

#include "samples.h"

#include <gtest/gtest.h>

#include <string>

namespace pcl::floater {
namespace {
// All warnings on so many flaws of each kind, at the same two points.
std::string
warningsOn (std::size_t count)
{
  const Points points =
      makePoints (samples::randomPoints (2000, 1), samples::indices (2000), RunContext (1));
  MeshExamination found;
  found.check.folds = found.check.degenerate_triangles = found.long_edges = count;
  found.fold_at = found.degenerate_at = found.crossing_at = 0;
  found.longest_inside = 7.0;
  found.longest_inside_at = {0, 1};
  found.check.self_intersections = count;
  found.smallest_component = found.largest_component = 2000;
  found.component_points = {2000};
  for (std::size_t i = 0; i < count; ++i) {
    BoundaryLoop loop;
    loop.points = {0, 1, 2};
    found.loops.push_back (loop);
    found.check.loops.emplace_back ().points = 3;
    found.unused.push_back (static_cast<Index> (i));
  }
  Report report;
  EXPECT_FALSE (reportCheck (points, found, {}, report));
  describeFindings (report);
  std::string text;
  for (const std::string& warning : report.warnings)
    text += warning + "\n";
  return text;
}

TEST (ReportMesh, NumbersAndWordsFit)
{
  const std::string one = warningsOn (1), two = warningsOn (2);
  for (const char* words :
       {"1 edge is folded by more than 120 degrees at point",
        "1 pair of triangles crosses each other at point",
        "1 edge inside the surface is much longer than the local spacing, of 7 spacings",
        "1 triangle has no area at point", "1 small hole stays open, of 3 points",
        "1 point is in no triangle, point"})
    EXPECT_NE (one.find (words), std::string::npos) << words << " in:\n" << one;
  for (const char* words : {"one of them", "the largest", "the longest", "among them", "they"})
    EXPECT_EQ (one.find (words), std::string::npos) << words << " in:\n" << one;
  for (const char* words :
       {"2 edges are folded by more than 120 degrees, one of them at point",
        "2 pairs of triangles cross each other, one of them at point",
        "2 edges inside the surface are much longer than the local spacing, the longest one of 7 "
        "spacings",
        "2 triangles have no area, one of them at point",
        "2 small holes stay open, the largest, of 3 points", "2 points are in no triangle, point",
        " among them: they do not connect"})
    EXPECT_NE (two.find (words), std::string::npos) << words << " in:\n" << two;
}

} // namespace
} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Coordinates far from zero: --shift, and the warning on coordinates that are too coarse.
#include "command_line_test.h"
#include "mesh_files.h"

#include <Eigen/Geometry>

namespace pcl::floater {
namespace {
class ShiftTest : public CommandLineTest
{
protected:
  // Points 0.3 m apart at map coordinates.
  ShiftTest ()
  {
    for (const Eigen::Vector3d& p : sample_.points)
      on_map_.emplace_back (Eigen::Vector3d (500123.4, 5500456.7, 312.0) + 0.3 * p);
    Sample sample = sample_;
    sample.is_double = true;
    sample.points = on_map_;
    writePcd (path ("double.pcd"), sample, PcdKind::BINARY);
    writeFile ("double.ply", plyText (sample, PlyKind::LITTLE));
    writeFile ("double.obj", objText (sample));
    // Text whose header says float, with more digits than that.
    writeFile ("text.pcd", pcdText (on_map_));
    std::string ply = plyText (sample, PlyKind::ASCII);
    for (std::size_t at = ply.find ("property double"); at != std::string::npos;
         at = ply.find ("property double"))
      ply.replace (at, 15, "property float");
    writeFile ("text.ply", ply);
    sample.is_double = false;
    writePcd (path ("float.pcd"), sample, PcdKind::BINARY);
  }

  Json reportOf (const std::string& input, std::vector<std::string> options) const
  {
    options.insert (options.begin (), {input, "out.ply", "--report", "out.json"});
    const Outcome outcome = run (options);
    EXPECT_EQ (outcome.code, 0) << outcome.err;
    return Json::parse (readFile ("out.json"));
  }

  std::vector<Eigen::Vector3d> on_map_;
};

double
largestDifference (const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b)
{
  EXPECT_EQ (a.size (), b.size ());
  double largest = 0.0;
  for (std::size_t i = 0; i < std::min (a.size (), b.size ()); ++i)
    largest = std::max (largest, (a[i] - b[i]).norm ());
  return largest;
}

TEST_F (ShiftTest, AutoMovesTheOriginToTheCloud)
{
  ASSERT_EQ (run ({"double.pcd", "plain.ply", "-q"}).code, 0);
  const MeshContent plain = readPly (path ("plain.ply"));
  for (const std::string input :
       {"double.pcd", "double.ply", "double.obj", "text.pcd", "text.ply"}) {
    SCOPED_TRACE (input);
    const Json all = reportOf (input, {"--shift", "auto"});
    const Eigen::Vector3d shift (all.at ("shift")[0], all.at ("shift")[1], all.at ("shift")[2]);
    EXPECT_LT ((shift - on_map_.front ()).norm (), 10.0);
    EXPECT_EQ (shift, shift.array ().round ().matrix ());
    EXPECT_EQ (all.at ("statistics").at ("coordinate_step"), 0.0);
    const MeshContent mesh = readPly (path ("out.ply"));
    EXPECT_EQ (mesh.is_double, input.rfind ("text", 0) != 0);
    std::vector<Eigen::Vector3d> back = mesh.points;
    for (Eigen::Vector3d& p : back)
      p += shift;
    EXPECT_LT (largestDifference (back, on_map_), 1e-6);
    EXPECT_EQ (mesh.triangles, plain.triangles);
    EXPECT_NE (readFile ("out.ply").find ("\ncomment shift 5001"), std::string::npos);
  }
  // Near zero there is no need.
  const Json all = reportOf ("in.pcd", {"--shift", "auto"});
  EXPECT_EQ (all.at ("shift"), (Json{0.0, 0.0, 0.0}));
  EXPECT_EQ (readFile ("out.ply").find ("comment shift"), std::string::npos);
}

TEST_F (ShiftTest, AutoIgnoresGrossOutliers)
{
  std::vector<Eigen::Vector3d> points = on_map_;
  points.emplace_back (0, 0, 0);
  points.emplace_back (1e10, 0, 0);
  writeFile ("far.pcd", pcdText (points));
  const Json all = reportOf ("far.pcd", {"--shift", "auto"});
  EXPECT_NEAR (all.at ("shift")[0].get<double> (), 500123.4, 10.0);
  EXPECT_EQ (all.at ("outliers"), (Json{on_map_.size (), on_map_.size () + 1}));
  const Json plain = reportOf ("in.pcd", {});
  EXPECT_EQ (all.at ("statistics").at ("used_points"), on_map_.size ());
}

TEST_F (ShiftTest, AGivenOrigin)
{
  for (const std::string output : {"out.ply", "out.vtk", "out.obj", "out.stl"}) {
    SCOPED_TRACE (output);
    const Outcome outcome =
        run ({"double.ply", output, "--json", "--shift", "500000,5500000,-12.5"});
    ASSERT_EQ (outcome.code, 0) << outcome.err;
    EXPECT_NE (outcome.out.find ("shift      500000 5500000 -12.5, subtracted"), std::string::npos)
        << outcome.out;
    const std::string text = readFile (output);
    EXPECT_EQ (text.find ("shift 500000 5500000 -12.5") == std::string::npos, output == "out.stl");
    if (output == "out.stl")
      continue;
    std::vector<Eigen::Vector3d> back = readMesh (path (output)).points;
    for (Eigen::Vector3d& p : back)
      p += Eigen::Vector3d (500000, 5500000, -12.5);
    EXPECT_LT (largestDifference (back, on_map_), 1e-9);
  }
  // A first number below zero is no option.
  EXPECT_EQ (run ({"in.pcd", "out.ply", "-q", "--shift", "-5,0,0"}).code, 0);
  EXPECT_NEAR (readPly (path ("out.ply")).points.front ().x (), sample_.points.front ().x () + 5.0,
               1e-5);
}

// An origin of the sensor of (0, 0, 0) tells nothing. Shifted, it would be a sensor below the
// ground.
TEST_F (ShiftTest, AnUnknownSensorStaysUnknown)
{
  const auto upward = [this] (const std::vector<std::string>& options) {
    reportOf ("in.pcd", options);
    const MeshContent mesh = readPly (path ("out.ply"));
    std::size_t count = 0;
    for (const auto& t : mesh.triangles) {
      const Eigen::Vector3d &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
      count += (b - a).cross (c - a).z () > 0.0 ? 1 : 0;
    }
    return count;
  };
  const std::size_t plain = upward ({});
  EXPECT_GT (plain, 100U);
  EXPECT_EQ (upward ({"--facing", "viewpoint", "--shift", "5,5,40"}), plain);
}

TEST_F (ShiftTest, CoarseCoordinatesAreTold)
{
  for (const std::string input : {"float.pcd", "text.pcd"}) {
    const Json all = reportOf (input, {"-q"});
    EXPECT_GT (all.at ("statistics").at ("coordinate_step").get<double> (), 0.1);
    EXPECT_NE (all.at ("warnings").dump ().find ("the coordinates are coarse"), std::string::npos);
    std::filesystem::remove (path ("out.ply"));
    const Outcome strict = run ({input, "out.ply", "--strict"});
    EXPECT_EQ (strict.code, WARNINGS);
    EXPECT_NE (strict.err.find ("--shift"), std::string::npos) << strict.err;
    EXPECT_FALSE (std::filesystem::exists (path ("out.ply")));
  }
  EXPECT_EQ (run ({"double.pcd", "out.ply", "--precision", "double", "--strict"}).code, 0);
  EXPECT_EQ (run ({"text.pcd", "out.ply", "--strict", "--shift", "auto"}).code, 0);
}

// A shift that leaves more digits than 32 bits hold.
TEST_F (ShiftTest, WhatWasGivenIsNotAdvised)
{
  const auto warnings = [this] (std::vector<std::string> options) {
    return reportOf ("double.ply", std::move (options)).at ("warnings").dump ();
  };
  const std::string doubles = "the coordinates are written as doubles", advice = "--shift if";
  const std::string without = warnings ({}), with = warnings ({"--shift", "500000,5500000,0"});
  EXPECT_NE (without.find (doubles), std::string::npos);
  EXPECT_NE (without.find (advice), std::string::npos);
  EXPECT_NE (with.find (doubles), std::string::npos);
  EXPECT_EQ (with.find (advice), std::string::npos);
}

} // namespace
} // namespace pcl::floater

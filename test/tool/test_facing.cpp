// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Which side of the mesh is its front: --facing and --use-input-normals.
#include "command_line_test.h"
#include "mesh_files.h"

#include <Eigen/Geometry>

namespace pcl::floater {
namespace {
// The wavy square of the sample, with normals that point down.
class FacingTest : public CommandLineTest
{
protected:
  FacingTest ()
  {
    Sample sample = sample_;
    for (Eigen::Vector3f& normal : sample.normals)
      normal = Eigen::Vector3f (0.1F, 0.0F, -1.0F);
    writePcd (path ("down.pcd"), sample, PcdKind::BINARY);
    writeFile ("down.ply", plyText (sample, PlyKind::ASCII));
    writeFile ("down.obj", objText (sample));
  }

  Json reportOf (const std::string& input, std::vector<std::string> options) const
  {
    options.insert (options.begin (), {input, "out.ply", "--report", "out.json"});
    const Outcome outcome = run (options);
    EXPECT_EQ (outcome.code, 0) << outcome.err;
    return Json::parse (readFile ("out.json"));
  }

  // Share of the triangles of the last mesh that face up.
  double shareUp () const
  {
    const MeshContent mesh = readPly (path ("out.ply"));
    std::size_t up = 0;
    for (const auto& t : mesh.triangles) {
      const Eigen::Vector3d &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
      up += (b - a).cross (c - a).z () > 0.0 ? 1 : 0;
    }
    return static_cast<double> (up) / static_cast<double> (mesh.triangles.size ());
  }
};

TEST_F (FacingTest, NormalsOfEveryFormat)
{
  for (const std::string input : {"down.pcd", "down.ply", "down.obj"}) {
    SCOPED_TRACE (input);
    EXPECT_EQ (reportOf (input, {}).at ("options").at ("use_input_normals"), false);
    EXPECT_EQ (shareUp (), 1.0);
    EXPECT_EQ (reportOf (input, {"--facing", "normals"}).at ("facing_parts"),
               (Json{{"normals", 1}}));
    EXPECT_EQ (shareUp (), 0.0);
    EXPECT_EQ (
        reportOf (input, {"--use-input-normals", "on"}).at ("options").at ("use_input_normals"),
        true);
    EXPECT_EQ (shareUp (), 0.0);
  }
}

TEST_F (FacingTest, WhatCannotBeDone)
{
  expectFailure ({"in.pcd", "out.ply", "--facing", "normals"}, USAGE,
                 "--facing normals: the points of 'in.pcd' have no normals");
  expectFailure ({"in.pcd", "out.ply", "--use-input-normals", "on"}, USAGE,
                 "--use-input-normals on: the points of 'in.pcd' have no normals");
  expectFailure ({"in.pcd", "out.ply", "--facing", "viewpoint", "--viewpoint", "none"}, USAGE,
                 "no viewpoint is looked for");
}

TEST_F (FacingTest, TheOriginOfTheSensorThatTheFileTells)
{
  std::string text = readFile ("in.pcd");
  const std::string place = "VIEWPOINT 0 0 0";
  const std::size_t at = text.find (place);
  ASSERT_NE (at, std::string::npos);
  writeFile ("below.pcd", text.replace (at, place.size (), "VIEWPOINT 5 5 -40"));
  const Json all = reportOf ("below.pcd", {"--facing", "viewpoint", "--viewpoint", "none"});
  EXPECT_EQ (shareUp (), 0.0);
  EXPECT_EQ (all.at ("facing_parts"), (Json{{"sensor", 1}}));
}

} // namespace
} // namespace pcl::floater

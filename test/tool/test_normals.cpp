// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Normals of the vertices in every format: --normals.
#include "command_line_test.h"
#include "mesh_files.h"

#include <Eigen/Geometry>

namespace pcl::floater {
namespace {
// As vertexNormals () has them, by the simplest means.
std::vector<Eigen::Vector3d>
normalsOf (const MeshContent& mesh)
{
  std::vector<Eigen::Vector3d> normals (mesh.points.size (), Eigen::Vector3d::Zero ());
  for (const auto& triangle : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d u =
          (mesh.points[triangle[(i + 1) % 3]] - mesh.points[triangle[i]]).normalized ();
      const Eigen::Vector3d v =
          (mesh.points[triangle[(i + 2) % 3]] - mesh.points[triangle[i]]).normalized ();
      normals[triangle[i]] += std::acos (u.dot (v)) * u.cross (v).normalized ();
    }
  for (Eigen::Vector3d& normal : normals)
    normal.normalize (); // leaves zero as it is
  return normals;
}

class NormalsTest : public ToolTestWith<bool>
{
protected:
  NormalsTest () : sample_ (makeSample (GetParam ()))
  {
    for (Eigen::Vector3f& normal : sample_.normals)
      normal = Eigen::Vector3f (0.0F, 1.0F, 0.0F);
    sample_.points[5].x () = std::nan ("");           // is left out
    sample_.points[9] += Eigen::Vector3d (0, 0, 1e4); // is in no triangle
    writePcd (path ("in.pcd"), sample_, PcdKind::BINARY);
  }

  Sample sample_;
};

TEST_P (NormalsTest, AreInEveryFormatThatHasThem)
{
  ASSERT_EQ (run ({"in.pcd", "plain.ply"}).code, 0);
  const MeshContent plain = readPly (path ("plain.ply"));
  for (const Eigen::Vector3f& normal : plain.normals)
    EXPECT_EQ (normal, Eigen::Vector3f (0.0F, 1.0F, 0.0F)); // of the input
  const std::vector<Eigen::Vector3d> expected = normalsOf (plain);
  for (const std::string extension : {"ply", "vtk", "obj", "off"}) {
    SCOPED_TRACE (extension);
    const Outcome outcome = run ({"in.pcd", "out." + extension, "--normals", "--report", "r.json"});
    ASSERT_EQ (outcome.code, 0) << outcome.err;
    const MeshContent mesh = readMesh (path ("out." + extension));
    EXPECT_EQ (mesh.triangles, plain.triangles);
    ASSERT_EQ (mesh.normals.size (), sample_.size () - 1);
    for (std::size_t p = 0; p < mesh.normals.size (); ++p)
      EXPECT_LT ((mesh.normals[p].cast<double> () - expected[p]).norm (), 1e-6);
    EXPECT_EQ (mesh.normals[8], Eigen::Vector3f (0.0F, 0.0F, 0.0F));
    EXPECT_EQ (mesh.colors, plain.colors);
    if (extension == "ply" || extension == "vtk") {
      EXPECT_EQ (mesh.fields, plain.fields);
    }
    EXPECT_TRUE (Json::parse (readFile ("r.json")).at ("output").at ("normals"));
  }
}

INSTANTIATE_TEST_SUITE_P (All, NormalsTest, testing::Bool (), [] (const auto& instance) {
  return instance.param ? "Double" : "Float";
});

TEST_F (CommandLineTest, NormalsOfPointsThatHadNone)
{
  ASSERT_EQ (run ({"in.pcd", "out.ply", "--normals"}).code, 0);
  const MeshContent mesh = readPly (path ("out.ply"));
  const std::vector<Eigen::Vector3d> expected = normalsOf (mesh);
  ASSERT_EQ (mesh.normals.size (), expected.size ());
  for (std::size_t p = 0; p < expected.size (); ++p)
    EXPECT_LT ((mesh.normals[p].cast<double> () - expected[p]).norm (), 1e-6);
  // The flat mesh has none: they are those of the surface in space.
  ASSERT_EQ (run ({"in.pcd", "out.ply", "--normals", "--parameterization", "flat.ply"}).code, 0);
  EXPECT_TRUE (readPly (path ("flat.ply")).normals.empty ());
  const Outcome stl = run ({"in.pcd", "out.stl", "--normals"});
  EXPECT_NE (stl.err.find ("no effect: --normals; STL has normals of triangles only"),
             std::string::npos)
      << stl.err;
}

} // namespace
} // namespace pcl::floater

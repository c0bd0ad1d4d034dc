// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a file has beside its points: left out with a word, and normals given to the right points.
#include "cloud_reader.h"
#include "tool_runner.h"

#include <gmock/gmock.h>

#include <cmath>

namespace pcl::floater {
namespace {
using testing::HasSubstr;

class LeftOut : public ToolTest
{
protected:
  Cloud read (const std::string& name, const std::string& text) const
  {
    writeFile (name, text);
    return readCloud (path (name));
  }

  /// Of x coordinates; NaN where a point has no normal.
  static std::vector<double> normalsOf (const Cloud& cloud)
  {
    std::vector<double> values;
    const FieldTriple normals = normalFields (cloud);
    for (std::size_t i = 0; normals[0] != nullptr && i < cloud.size (); ++i)
      values.push_back (normals[0]->asDouble (i));
    return values;
  }
};

const std::string POINTS = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST_F (LeftOut, FacesOfAPlyFile)
{
  const std::string vertices =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
      "z\n";
  const std::string list = "property list uchar int vertex_indices\nend_header\n";
  EXPECT_THAT (read ("a.ply", vertices + "element face 2\n" + list + "0 0 0\n").warnings,
               testing::ElementsAre (HasSubstr ("2 faces of the input file were left out")));
  EXPECT_TRUE (read ("b.ply", vertices + "element face 0\n" + list + "0 0 0\n").warnings.empty ());
}

TEST_F (LeftOut, RowsOfAnOrganizedCloud)
{
  const auto pcd = [] (const std::string& width, const std::string& height) {
    return "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + width +
           "\nHEIGHT " + height + "\nDATA ascii\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 0 0\n2 1 0\n";
  };
  EXPECT_THAT (read ("a.pcd", pcd ("3", "2")).warnings,
               testing::ElementsAre (HasSubstr ("organized in 2 rows of 3 points")));
  EXPECT_TRUE (read ("b.pcd", pcd ("6", "1")).warnings.empty ());
}

TEST_F (LeftOut, NormalsOfAnObjFileAreThoseOfItsFaces)
{
  // As many as points, and in another order.
  const std::string normals = "vn 0.1 0 1\nvn 0.2 0 1\nvn 0.3 0 1\n";
  Cloud cloud = read ("a.obj", POINTS + normals + "f 1//3 2/7/2 3//1\n");
  EXPECT_EQ (normalsOf (cloud), (std::vector<double>{0.3, 0.2, 0.1}));
  EXPECT_THAT (cloud.warnings, testing::ElementsAre (HasSubstr ("1 face of the input file was")));
  cloud = read ("b.obj", POINTS + normals + "f -3//-1 -2//-2 -1//-3\n");
  EXPECT_EQ (normalsOf (cloud), (std::vector<double>{0.3, 0.2, 0.1}));

  // One for two points, and none for the third.
  cloud = read ("c.obj", POINTS + "vn 0.5 0 1\nf 1//1 2//1 3\n");
  const std::vector<double> shared = normalsOf (cloud);
  ASSERT_EQ (shared.size (), 3U);
  EXPECT_EQ (shared[0], 0.5);
  EXPECT_EQ (shared[1], 0.5);
  EXPECT_TRUE (std::isnan (shared[2]));

  // At a sharp edge a point has several.
  cloud = read ("d.obj", POINTS + normals + "f 1//1 2//1 3//1\nf 1//2 2//1 3//1\n");
  EXPECT_EQ (normalsOf (cloud), (std::vector<double>{0.1, 0.1, 0.1}));
  EXPECT_THAT (cloud.warnings, testing::Contains (HasSubstr ("1 point had several normals")));
}

TEST_F (LeftOut, NormalsWithoutFacesComeInTheOrderOfThePoints)
{
  Cloud cloud = read ("a.obj", POINTS + "vn 0.1 0 1\nvn 0.2 0 1\nvn 0.3 0 1\n");
  EXPECT_EQ (normalsOf (cloud), (std::vector<double>{0.1, 0.2, 0.3}));
  EXPECT_TRUE (cloud.warnings.empty ());
  cloud = read ("b.obj", POINTS + "vn 0.1 0 1\n");
  EXPECT_TRUE (normalsOf (cloud).empty ());
  EXPECT_THAT (cloud.warnings, testing::ElementsAre (HasSubstr ("1 normal for 3 points")));
}

TEST_F (LeftOut, FacesThatNameWhatIsNotThereAreRefused)
{
  for (const std::string face : {"1//2", "4//1", "0//1", "-4//1", "1//x"})
    EXPECT_THROW (read ("a.obj", POINTS + "vn 0 0 1\nf " + face + "\n"), ReadError) << face;
}

} // namespace
} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Oddities of PCD, PLY and OBJ files that other programs take: they are read, and where something
// was guessed, a warning tells.
#include "cloud_reader.h"
#include "command_line_test.h"
#include "mesh_files.h"
#include "sample.h"

#include <gmock/gmock.h>

namespace pcl::floater {
namespace {
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::vector<Eigen::Vector3d> TWO_POINTS{{1, 2, 3}, {4, 5, 6}};
constexpr std::string_view BYTE_ORDER_MARK = "\xef\xbb\xbf";

std::string
pcd (const std::string& fields, const std::string& header, const std::string& rows)
{
  return "FIELDS " + fields + "\n" + header + "WIDTH 2\nHEIGHT 1\nDATA ascii\n" + rows;
}

TEST (Tolerance, PcdHeadersWithoutTypes)
{
  for (const std::string header : {"", "COUNT 1 1 1\n", "SIZE 4 4 4\n", "TYPE F F F\n"}) {
    SCOPED_TRACE (header);
    const std::string text = pcd ("x y z", header, "1 2 3\n4 5 6\n");
    const Cloud cloud = parsePcd (FileBytes (std::string_view (text)));
    EXPECT_EQ (cloud.positions (), TWO_POINTS);
    EXPECT_TRUE (cloud.single_precision);
    EXPECT_THAT (cloud.warnings, ElementsAre (HasSubstr ("taken for floats of 4 bytes")));
  }
  const std::string complete = pcd ("x y z", "SIZE 4 4 4\nTYPE F F F\n", "1 2 3\n4 5 6\n");
  EXPECT_THAT (parsePcd (FileBytes (std::string_view (complete))).warnings, IsEmpty ());
  std::string binary = "FIELDS x y z\nWIDTH 1\nHEIGHT 1\nDATA binary\n";
  const std::array<float, 3> point{1.0F, 2.0F, 3.0F};
  binary.append (reinterpret_cast<const char*> (point.data ()), sizeof point);
  EXPECT_EQ (parsePcd (FileBytes (std::string_view (binary))).position (0), TWO_POINTS[0]);
}

TEST (Tolerance, RepeatedNames)
{
  const std::string text = pcd ("x y z i i i_2 x", "SIZE 4 4 4 4 4 4 4\nTYPE F F F F F F F\n",
                                "1 2 3 10 20 30 40\n4 5 6 11 21 31 41\n");
  const Cloud cloud = parsePcd (FileBytes (std::string_view (text)));
  EXPECT_EQ (cloud.positions (), TWO_POINTS);
  EXPECT_THAT (namesOf (cloud), ElementsAre ("i", "i_3", "i_2", "x_2"));
  EXPECT_EQ (cloud.find ("i")->asDouble (1), 11.0);
  EXPECT_EQ (cloud.find ("i_3")->asDouble (1), 21.0);
  EXPECT_EQ (cloud.find ("i_2")->asDouble (1), 31.0);
  EXPECT_EQ (cloud.find ("x_2")->asDouble (1), 41.0);
  EXPECT_THAT (cloud.warnings,
               ElementsAre (HasSubstr ("two fields 'i': the second was renamed 'i_3'"),
                            HasSubstr ("two fields 'x': the second was renamed 'x_2'")));
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float "
      "y\nproperty float z\nproperty int a\nproperty int a\nend_header\n1 2 3 7 "
      "8\n4 5 6 9 10\n";
  EXPECT_THAT (namesOf (parsePly (FileBytes (std::string_view (ply)))), ElementsAre ("a", "a_2"));
}

TEST (Tolerance, ColorsThatAreThereTwice)
{
  const std::string types = "SIZE 4 4 4 4 4\nTYPE F F F U U\n";
  const std::string rows = "1 2 3 66051 16909060\n4 5 6 0 0\n"; // 0x010203, 0x01020304
  const std::string rgb_first = pcd ("x y z rgb rgba", types, rows);
  const Cloud rgb = parsePcd (FileBytes (std::string_view (rgb_first)));
  EXPECT_THAT (namesOf (rgb), ElementsAre ("red", "green", "blue"));
  EXPECT_EQ (colorFields (rgb)[0]->value<std::uint8_t> (0), 1);
  EXPECT_THAT (rgb.warnings, ElementsAre (HasSubstr ("colour twice: the field 'rgba'")));
  const std::string rgba_first = pcd ("x y z rgba rgb", types, "1 2 3 16909060 66051\n4 5 6 0 0\n");
  const Cloud rgba = parsePcd (FileBytes (std::string_view (rgba_first)));
  EXPECT_THAT (namesOf (rgba), ElementsAre ("red", "green", "blue", "alpha"));
  EXPECT_EQ (colorFields (rgba)[0]->value<std::uint8_t> (0), 2);
  EXPECT_EQ (rgba.find ("alpha")->value<std::uint8_t> (0), 1);
}

TEST (Tolerance, CoordinatesInCapitals)
{
  const std::string text = pcd ("X Y Z", "SIZE 4 4 4\nTYPE F F F\n", "1 2 3\n4 5 6\n");
  const Cloud cloud = parsePcd (FileBytes (std::string_view (text)));
  EXPECT_EQ (cloud.positions (), TWO_POINTS);
  EXPECT_THAT (cloud.fields, IsEmpty ());
  EXPECT_THAT (cloud.warnings, IsEmpty ());
  const std::string both = pcd ("X x y z", "SIZE 4 4 4 4\nTYPE F F F F\n", "9 1 2 3\n9 4 5 6\n");
  const Cloud small = parsePcd (FileBytes (std::string_view (both)));
  EXPECT_EQ (small.positions (), TWO_POINTS);
  EXPECT_THAT (namesOf (small), ElementsAre ("X"));
}

TEST (Tolerance, ByteOrderMarks)
{
  const std::string pcd_text =
      std::string (BYTE_ORDER_MARK) + pcd ("x y z", "SIZE 4 4 4\nTYPE F F F\n", "1 2 3\n4 5 6\n");
  EXPECT_EQ (parsePcd (FileBytes (std::string_view (pcd_text))).positions (), TWO_POINTS);
  const std::string obj_text = std::string (BYTE_ORDER_MARK) + "v 1 2 3\nv 4 5 6\n";
  EXPECT_EQ (parseObj (FileBytes (std::string_view (obj_text))).positions (), TWO_POINTS);
  const Sample sample = makeSample (false, 4);
  for (const PlyKind kind : {PlyKind::ASCII, PlyKind::LITTLE, PlyKind::BIG}) {
    const std::string ply = std::string (BYTE_ORDER_MARK) + plyText (sample, kind);
    EXPECT_EQ (parsePly (FileBytes (std::string_view (ply))).positions (), sample.points);
  }
}

TEST (Tolerance, ObjColorsTo255)
{
  const std::string text = "v 1 2 3 255 0 7 # a comment\nv 4 5 6 0 1 128\n";
  const Cloud cloud = parseObj (FileBytes (std::string_view (text)));
  EXPECT_EQ (cloud.positions (), TWO_POINTS);
  EXPECT_EQ (colorFields (cloud)[0]->value<std::uint8_t> (0), 255);
  EXPECT_EQ (colorFields (cloud)[2]->value<std::uint8_t> (1), 128);
  EXPECT_EQ (colorFields (cloud)[1]->value<std::uint8_t> (1), 1);
  EXPECT_THAT (cloud.warnings, ElementsAre (HasSubstr ("they were taken for 0 to 255")));
}

TEST (Tolerance, ObjLinesThatGoOn)
{
  const std::string text =
      "# c:\\\nv 1 \\\n2 \\\r\n  3\nv 4 5 6\nvn 0 0 1\nvn 0 1 0\nf 1//1 \\\n 2//2 1//1\n";
  const Cloud cloud = parseObj (FileBytes (std::string_view (text)));
  EXPECT_EQ (cloud.positions (), TWO_POINTS);
  EXPECT_EQ (cloud.find ("ny")->asDouble (1), 1.0);
  const std::string wrong = "v 1 \\\n2 3\n\nv 4 high 6\n"; // lines keep their numbers
  try {
    parseObj (FileBytes (std::string_view (wrong)));
    FAIL () << "it was read";
  }
  catch (const ReadError& error) {
    EXPECT_THAT (error.what (), HasSubstr ("line 4: 'high' is not a number"));
  }
  const std::string last = "v 1 2 3\nv 4 5 6\\";
  EXPECT_EQ (parseObj (FileBytes (std::string_view (last + "\n"))).positions (), TWO_POINTS);
}

TEST_F (CommandLineTest, WarningsOfOddFilesAreFailuresWithStrict)
{
  std::string text = readFile ("in.pcd");
  const std::string line = "SIZE 4 4 4\n";
  const std::size_t at = text.find (line);
  ASSERT_NE (at, std::string::npos);
  writeFile ("odd.pcd", text.erase (at, line.size ()));
  const Outcome outcome = run ({"odd.pcd", "out.ply"});
  EXPECT_EQ (outcome.code, 0);
  EXPECT_THAT (outcome.err, HasSubstr ("warning: the PCD header has no SIZE"));
  EXPECT_EQ (readPly (path ("out.ply")).points, sample_.points);
  EXPECT_EQ (run ({"odd.pcd", "out.ply", "--strict"}).code, WARNINGS);
}

} // namespace
} // namespace pcl::floater

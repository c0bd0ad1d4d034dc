// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Text with a point in each line: .xyz, .txt, .csv, .asc and .pts.
#include "cloud_reader.h"
#include "command_line_test.h"
#include "mesh_files.h"
#include "sample.h"

#include <gmock/gmock.h>

#include <cmath>
#include <iomanip>
#include <sstream>

namespace pcl::floater {
namespace {
using testing::ElementsAre;
using testing::HasSubstr;

Cloud
parse (std::string_view text, bool is_intensity_first = false)
{
  return parseTable (FileBytes (text), is_intensity_first);
}

std::string
errorOf (std::string_view text)
{
  try {
    parse (text);
  }
  catch (const ReadError& error) {
    return error.what ();
  }
  return "none";
}

std::vector<double>
valuesOf (const Cloud& cloud, const std::string& name)
{
  const Field* const field = cloud.find (name);
  std::vector<double> values;
  for (std::size_t row = 0; field != nullptr && row < cloud.rows; ++row)
    values.push_back (field->asDouble (row));
  return values;
}

void
expectPoints (const Cloud& cloud, const std::vector<Eigen::Vector3d>& points)
{
  EXPECT_EQ (cloud.positions (), points);
  EXPECT_TRUE (cloud.are_decimals);
}

const std::vector<Eigen::Vector3d> TWO{{1.5, 2.0, -3.0}, {4.0, 5.0e-3, 0.1}};

TEST (Tables, EverySeparator)
{
  for (const std::string_view text :
       {"1.5 2 -3\n4 5e-3 0.1\n", "1.5\t2\t-3\r\n4\t5e-3\t.1\r\n", "  1.5   2  -3  \n\n4 5e-3 0.1",
        "1.5,2,-3\n4,5e-3,0.1\n", "1.5, 2, -3,\n4, 5E-3, +0.1,\n", "1.5;2;-3\n4;0.005;0.1\n",
        "\xef\xbb\xbf"
        "1.5 2 -3\n4 5e-3 0.1\n",
        "# text\n//\n% more\n1.5 2 -3\n#\n4 5e-3 0.1\n",
        "\"1.5\",\"2\",\"-3\"\n\"4\",\"5e-3\",\"0.1\"\n"}) {
    SCOPED_TRACE (text);
    const Cloud cloud = parse (text);
    expectPoints (cloud, TWO);
    EXPECT_TRUE (cloud.fields.empty ());
    EXPECT_TRUE (cloud.warnings.empty ());
  }
}

TEST (Tables, DecimalCommasAreTold)
{
  for (const std::string_view text : {"1,5;2;-3\n4;0,005;0,1\n", "1,5 2,0 -3,0\n4,0 0,005 0,1\n"}) {
    SCOPED_TRACE (text);
    const Cloud cloud = parse (text);
    expectPoints (cloud, TWO);
    EXPECT_THAT (cloud.warnings, ElementsAre (HasSubstr ("read as decimal points")));
  }
}

TEST (Tables, HeadersNameTheColumns)
{
  for (const std::string_view header :
       {"red,green,blue,x,y,z,label,Intensity\n", "R;G;B;X;Y;Z;label;I\n",
        "//R G B X Y Z label Scalar_Intensity\n",
        "# red green blue X[m] Y[m] Z[m] Label intensity\n",
        "\xef\xbb\xbf\"Red\",\"Green\",\"Blue\",\"Easting\",\"Northing\",\"Height (m)\",\"label\","
        "\"reflectance\"\r\n"}) {
    SCOPED_TRACE (header);
    for (const char separator : {' ', ',', ';'}) {
      std::string text =
          std::string (header) + "255 0 7 1.5 2 -3 12 0.25\n0 1 2 4 5e-3 0.1 -1 0.5\n";
      std::replace (text.begin () + static_cast<std::ptrdiff_t> (header.size ()), text.end (), ' ',
                    separator);
      const Cloud cloud = parse (text);
      expectPoints (cloud, TWO);
      EXPECT_THAT (namesOf (cloud), ElementsAre ("red", "green", "blue", "label", "intensity"));
      EXPECT_NE (colorFields (cloud)[0], nullptr);
      EXPECT_THAT (valuesOf (cloud, "red"), ElementsAre (255, 0));
      EXPECT_THAT (valuesOf (cloud, "blue"), ElementsAre (7, 2));
      EXPECT_THAT (valuesOf (cloud, "label"), ElementsAre (12, -1));
      EXPECT_THAT (valuesOf (cloud, "intensity"), ElementsAre (0.25, 0.5));
      EXPECT_EQ (cloud.find ("intensity")->type, ScalarType::FLOAT32);
      EXPECT_TRUE (cloud.warnings.empty ());
    }
  }
}

struct Guess
{
  std::string rows;
  bool is_intensity_first;
  std::vector<std::string> names;
  std::string told;
};

TEST (Tables, ColumnsWithoutNamesAreGuessedAndTold)
{
  const std::vector<Guess> guesses{
      {"0.5\n0.7", false, {"intensity"}, "4 for the intensity"},
      {"255 0 7\n1 2 3", false, {"red", "green", "blue"}, "4 to 6 for colours"},
      {"0 0 1\n0.6 0 -0.8", false, {"nx", "ny", "nz"}, "4 to 6 for normals"},
      {"255 0 7 0.5\n1 2 3 -9",
       false,
       {"red", "green", "blue", "intensity"},
       "7 for the intensity"},
      {"-9 255 0 7\n0.5 1 2 3", false, {"intensity", "red", "green", "blue"}, "5 to 7 for colours"},
      {"9 255 0 7\n5 1 2 3", true, {"intensity", "red", "green", "blue"}, "5 to 7 for colours"},
      {"9 255 0 7\n5 1 2 3", false, {"red", "green", "blue", "intensity"}, "4 to 6 for colours"},
      {"0 0 1 255 0 7\n0.6 0 -0.8 1 2 3",
       false,
       {"nx", "ny", "nz", "red", "green", "blue"},
       "4 to 6 for normals, 7 to 9 for colours"},
      {"255 0 7 0 0 1\n1 2 3 0.6 0 -0.8",
       false,
       {"red", "green", "blue", "nx", "ny", "nz"},
       "4 to 6 for colours, 7 to 9 for normals"},
      {"0.5 300\n0.7 -1", false, {"column_4", "column_5"}, "4 for another field"},
      {"256 0 7\n1 2 3", false, {"column_4", "column_5", "column_6"}, "6 for another field"}};
  for (const Guess& guess : guesses) {
    SCOPED_TRACE (guess.rows);
    const std::size_t end = guess.rows.find ('\n');
    const Cloud cloud = parse ("1.5 2 -3 " + guess.rows.substr (0, end) + "\n4 5e-3 0.1 " +
                                   guess.rows.substr (end + 1) + "\n",
                               guess.is_intensity_first);
    expectPoints (cloud, TWO);
    EXPECT_EQ (namesOf (cloud), guess.names);
    EXPECT_THAT (cloud.warnings, ElementsAre (testing::AllOf (HasSubstr ("have no names"),
                                                              HasSubstr (guess.told))));
  }
}

TEST (Tables, ColoursOfEveryScale)
{
  EXPECT_THAT (valuesOf (parse ("x y z r g b\n0 0 0 0 0.5 1\n1 1 1 0.2 0 0\n"), "green"),
               ElementsAre (128, 0));
  const Cloud wide = parse ("x y z r g b\n0 0 0 0 65535 257\n1 1 1 0 0 0\n");
  EXPECT_THAT (valuesOf (wide, "green"), ElementsAre (255, 0));
  EXPECT_THAT (valuesOf (wide, "blue"), ElementsAre (1, 0));
  EXPECT_THAT (wide.warnings, ElementsAre (HasSubstr ("16 bits")));
  const Cloud none = parse ("x y z r g b\n0 0 0 -1 65535 257\n1 1 1 0 0 0\n");
  EXPECT_EQ (colorFields (none)[0], nullptr);
  EXPECT_THAT (valuesOf (none, "red"), ElementsAre (-1, 0));
  EXPECT_THAT (none.warnings, ElementsAre (HasSubstr ("kept as other fields")));
}

TEST (Tables, ValuesKeepTheirDigits)
{
  const Cloud cloud =
      parse ("x y z time short exact huge\n0 0 0 413456.123456 0.1 0.1000000014901161193847656 "
             "1e300\n1 1 1 413456.123457 12345.678 -0.5 nan\n");
  EXPECT_EQ (cloud.find ("time")->type, ScalarType::FLOAT64);
  EXPECT_THAT (valuesOf (cloud, "time"), ElementsAre (413456.123456, 413456.123457));
  EXPECT_EQ (cloud.find ("short")->type, ScalarType::FLOAT32);
  EXPECT_EQ (cloud.find ("exact")->type, ScalarType::FLOAT32);
  EXPECT_EQ (cloud.find ("exact")->value<float> (0), 0.1F);
  EXPECT_EQ (cloud.find ("huge")->type, ScalarType::FLOAT64);
  EXPECT_EQ (valuesOf (cloud, "huge")[0], 1e300);
}

TEST (Tables, TextAndEmptyColumns)
{
  const Cloud cloud = parse ("x,y,z,class,a\n1.5,2,-3,tree,\n4,5e-3,0.1,grass 2,7\n");
  expectPoints (cloud, TWO);
  ASSERT_THAT (namesOf (cloud), ElementsAre ("a")); // no alpha without a colour
  EXPECT_TRUE (std::isnan (valuesOf (cloud, "a")[0]));
  EXPECT_EQ (valuesOf (cloud, "a")[1], 7.0);
  EXPECT_THAT (cloud.warnings, ElementsAre (HasSubstr ("column 4 of the input file, 'class',")));
  const Cloud twice = parse ("x y z t t\n1.5 2 -3 1 2\n4 5e-3 0.1 3 4\n");
  EXPECT_THAT (namesOf (twice), ElementsAre ("t", "t_2"));
  EXPECT_THAT (twice.warnings, ElementsAre (HasSubstr ("two fields 't'")));
}

TEST (Tables, NonFinitePointsAreKept)
{
  Cloud cloud = parse ("1.5 2 -3\nnan 0 0\n4 5e-3 0.1\n1 inf 0\n");
  EXPECT_EQ (cloud.size (), 4U);
  Triangles none;
  EXPECT_EQ (removeNonFinitePoints (cloud, none), 2U);
  EXPECT_EQ (cloud.position (1), TWO[1]);
}

TEST (Tables, LinesBeforeThePointsAreTold)
{
  const Cloud cloud =
      parse ("Made by a scanner\n\x01\x02\nno. of points below\n1.5 2 -3\n4 5e-3 0.1\n");
  expectPoints (cloud, TWO);
  EXPECT_THAT (cloud.warnings,
               ElementsAre (HasSubstr ("3 lines at the beginning of the input file "
                                       "are no points and were left out: 'Made by")));
}

TEST (Tables, CommentsAboutXAndYAreNoHeader)
{
  for (const std::string comment : {"# x y z are in metres\n", "# the axes x , y , z\n"}) {
    const std::string text = comment + "1.5 2 -3\n4 5e-3 0.1\n";
    const Cloud cloud = parse (text);
    expectPoints (cloud, TWO);
    EXPECT_TRUE (cloud.fields.empty ());
  }
  const Cloud named = parse ("# columns: y x z\n2 1.5 -3\n5e-3 4 0.1\n");
  expectPoints (named, TWO);
  EXPECT_THAT (errorOf ("x y z a\n1 2 3\n"), HasSubstr ("in the columns that its header names"));
}

TEST (Tables, GarbageIsNotSearchedForEver)
{
  std::string lines;
  for (int i = 0; i < 1100; ++i)
    lines += "no point\n";
  EXPECT_THAT (errorOf (lines + "1 2 3\n"), HasSubstr ("no line of the first 1000 has three"));
  EXPECT_THAT (errorOf (std::string (100000, '1') + " 2 3\n"), HasSubstr ("no line has three"));
}

TEST (Tables, CountsArePromises)
{
  expectPoints (parse ("2\n1.5 2 -3\n4 5e-3 0.1\n"), TWO);
  expectPoints (parse ("1\n1.5 2 -3\n1\n4 5e-3 0.1\n"), TWO); // two scans in one file
  EXPECT_THAT (errorOf ("3\n1.5 2 -3\n4 5e-3 0.1\n"), HasSubstr ("promises 3 points, but the file "
                                                                 "has only 2"));
  EXPECT_THAT (errorOf ("18446744073709551615\n1.5 2 -3\n"), HasSubstr ("has only 1"));
  EXPECT_THAT (parse ("1\n1.5 2 -3\n4 5e-3 0.1\n").warnings,
               ElementsAre (HasSubstr ("promises 1 points, but there are 2")));
}

TEST (Tables, WhatIsNoTable)
{
  const std::vector<std::pair<std::string, std::string>> cases{
      {"hello\n",
       "it has no points: no line has three numbers, x, y and z; it begins with 'hello'"},
      {"1 2\n3 4\n", "no line has three numbers"},
      {std::string (1000, '\xfe'), "no line has three numbers"},
      {std::string (1000, '\x80'), "no line has three numbers"},
      {"x y z\nx y z\n", "in the columns that its header names"},
      {"x y z r\n1 2\n", "no line has three numbers"},
      {"7\n", "no line has three numbers"},
      {"ncols 3\nnrows 2\nxllcorner 0\n1 2 3\n4 5 6\n", "a grid of heights (ESRI ASCII)"},
      {"1 2 3\n4 5\n", "line 2: it does not have 3 columns"},
      {"1 2 3\n4 5 6 7\n", "line 2: it does not have 3 columns"},
      {"1,2,3,4\n5,6\n", "line 2: it does not have 4 columns"},
      {"1 2 3\n4 5 high\n", "line 2: 'high' is not a number"},
      {"1 2 3\n4 5 6x\n", "line 2: '6x' is not a number"},
      {"x,y,z,a\n1,2,3,4\n1,2,3,high\n", "line 3: 'high' is not a number"},
      {"\xff\xfe"
       "1\0 \0",
       "UTF-16"}};
  for (const auto& [text, cause] : cases)
    EXPECT_THAT (errorOf (text), HasSubstr (cause)) << text;
}

// Every end of a line is one of the points, or of the file.
TEST (Tables, EveryPrefixIsRefusedOrWhole)
{
  const std::string text =
      "3\nx y z red green blue label\n1 2 3 4 5 6 a\n7,8 2 3 4 5 6 b\n1 1 1 1 1 1 c\n";
  std::string points;
  for (char c : text)
    points += c == ',' ? '.' : c;
  for (std::size_t length = 0; length <= points.size (); ++length) {
    const std::vector<char> prefix (points.begin (),
                                    points.begin () + static_cast<std::ptrdiff_t> (length));
    try {
      EXPECT_EQ (parse ({prefix.data (), prefix.size ()}).size (), 3U);
      EXPECT_GE (length + 1, points.size ());
    }
    catch (const ReadError& error) {
      EXPECT_STRNE (error.what (), "");
      EXPECT_LT (length + 1, points.size ());
    }
  }
}

TEST_F (CommandLineTest, EveryKindOfTextMakesTheSameMesh)
{
  std::ostringstream text;
  text << std::setprecision (17);
  for (const Eigen::Vector3d& p : sample_.points)
    text << p.x () << ',' << p.y () << ',' << p.z () << ",1,2,3\n";
  ASSERT_EQ (run ({"in.pcd", "expected.ply"}).code, 0);
  const MeshContent expected = readPly (path ("expected.ply"));
  for (const std::string name : {"in.xyz", "in.txt", "in.csv", "in.asc", "in.pts", "IN.XYZ"}) {
    SCOPED_TRACE (name);
    writeFile (name, (name == "in.pts" ? std::to_string (sample_.size ()) + "\n" : "") +
                         "x,y,z,red,green,blue\n" + text.str ());
    const Outcome outcome = run ({name, "out.ply"});
    ASSERT_EQ (outcome.code, 0) << outcome.err;
    EXPECT_EQ (outcome.err, "");
    const MeshContent mesh = readPly (path ("out.ply"));
    EXPECT_FALSE (mesh.is_double);
    EXPECT_EQ (mesh.points, expected.points);
    EXPECT_EQ (mesh.triangles, expected.triangles);
    ASSERT_EQ (mesh.colors.size (), sample_.size ());
    EXPECT_EQ (mesh.colors[3], (std::array<std::uint8_t, 3>{1, 2, 3}));
  }
}

} // namespace
} // namespace pcl::floater

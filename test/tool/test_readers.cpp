// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the readers make of the bytes of a file: clouds, warnings, and messages.
#include "atomic_file.h"
#include "cloud_reader.h"
#include "tool_runner.h"

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <iomanip>
#include <limits>
#include <random>
#include <sstream>

#include <unistd.h>

namespace pcl::floater {
namespace {
const std::string BYTE_ORDER_MARK = "\xef\xbb\xbf";
constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN ();
constexpr std::int32_t LARGEST = std::numeric_limits<std::int32_t>::max ();

class Readers : public ToolTest
{
protected:
  Cloud read (const std::string& file, const std::string& bytes) const
  {
    writeFile (file, bytes);
    return readCloud (path (file));
  }

  std::string errorOf (const std::string& file, const std::string& bytes) const
  {
    try {
      read (file, bytes);
    }
    catch (const ReadError& error) {
      return error.what ();
    }
    return "none";
  }
};

std::vector<double>
valuesOf (const Field& field, std::size_t rows)
{
  std::vector<double> values;
  for (std::size_t row = 0; row < rows; ++row)
    values.push_back (field.asDouble (row));
  return values;
}

/// Names and values of all fields, such as "red 255 0, green 0 1".
std::string
fieldsOf (const Cloud& cloud)
{
  constexpr int DIGITS = 15;
  std::ostringstream text;
  text << std::setprecision (DIGITS);
  for (const Field& field : cloud.fields) {
    text << (&field == &cloud.fields.front () ? "" : ", ") << field.name;
    for (const double value : valuesOf (field, cloud.rows))
      text << ' ' << value;
  }
  return text.str ();
}

/// A file of two points.
struct Readable
{
  std::string file; ///< tells the format
  std::string bytes;
  std::string fields;   ///< as fieldsOf has them
  std::string warnings; ///< a part of each, in lines
};

std::string
pcd (const std::string& fields, const std::string& header, const std::string& rows)
{
  return "FIELDS " + fields + "\n" + header + "WIDTH 2\nHEIGHT 1\nDATA ascii\n" + rows;
}

const std::string XYZ_FLOATS = "SIZE 4 4 4\nTYPE F F F\n";

std::vector<Readable>
readablePcds ()
{
  const std::string rows = "1 2 3\n4 5 6\n", missing = "taken for floats of 4 bytes";
  const std::string colors = "SIZE 4 4 4 4 4\nTYPE F F F U U\n";
  const std::array<float, 6> numbers{1, 2, 3, 4, 5, 6};
  const std::string binary (reinterpret_cast<const char*> (numbers.data ()), sizeof numbers);
  const std::string repeated = pcd ("x y z i i i_2 x", "SIZE 4 4 4 4 4 4 4\nTYPE F F F F F F F\n",
                                    "1 2 3 10 20 30 40\n4 5 6 11 21 31 41\n");
  // 0x010203 and 0x01020304
  const std::string rgb = pcd ("x y z rgb rgba", colors, "1 2 3 66051 16909060\n4 5 6 0 0\n");
  const std::string rgba = pcd ("x y z rgba rgb", colors, "1 2 3 16909060 66051\n4 5 6 0 0\n");
  const std::string capital = pcd ("X x y z", "SIZE 4 4 4 4\nTYPE F F F F\n", "9 1 2 3\n9 4 5 6\n");
  const std::string typed = "FIELDS x y z\n" + XYZ_FLOATS;
  return {
      {"a.pcd", pcd ("x y z", XYZ_FLOATS, rows), "", ""},
      {"a.pcd", typed + "WIDTH 1\nHEIGHT 2\nDATA ascii\n" + rows, "", ""}, // not organized
      {"a.pcd", typed + "WIDTH 0\nHEIGHT 0\nPOINTS 2\nDATA ascii\n" + rows, "", "as a list"},
      {"a.pcd", typed + "WIDTH 2\nHEIGHT 1\nDATA ascii 1 2 3\n4 5 6", "", ""},
      {"a.pcd",
       pcd ("x y z _ t", "SIZE 4 4 4 1 4\nTYPE F F F U U\nCOUNT 1 1 1 0 1\n", "1 2 3 7\n4 5 6 8\n"),
       "t 7 8", "field '_' of the PCD header has COUNT 0"},
      {"a.pcd", BYTE_ORDER_MARK + pcd ("x y z", XYZ_FLOATS, rows), "", ""},
      {"a.pcd", pcd ("x y z", "", rows), "", missing},
      {"a.pcd", pcd ("x y z", "COUNT 1 1 1\n", rows), "", missing},
      {"a.pcd", pcd ("x y z", "SIZE 4 4 4\n", rows), "", missing},
      {"a.pcd", pcd ("x y z", "TYPE F F F\n", rows), "", missing},
      {"a.pcd", "FIELDS x y z\nWIDTH 2\nHEIGHT 1\nDATA binary\n" + binary, "", missing},
      {"a.pcd", pcd ("X Y Z", XYZ_FLOATS, rows), "", ""},
      {"a.pcd", capital, "X 9 9", ""},
      {"a.pcd", repeated, "i 10 11, i_3 20 21, i_2 30 31, x_2 40 41",
       "two fields 'i': the second was renamed 'i_3'\ntwo fields 'x': the second was renamed "
       "'x_2'"},
      {"a.pcd", rgb, "red 1 0, green 2 0, blue 3 0", "colour twice: the field 'rgba'"},
      {"a.pcd", rgba, "red 2 0, green 3 0, blue 4 0, alpha 1 0", "the field 'rgb'"}};
}

std::string
ply (const std::string& properties, const std::string& faces, const std::string& rows)
{
  return "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
         "property float z\n" +
         properties + "element face " + faces +
         "\nproperty list uchar int vertex_indices\nend_header\n" + rows;
}

std::vector<Readable>
readablePlys ()
{
  const std::string rows = "1 2 3\n4 5 6\n";
  const std::string repeated =
      ply ("property int a\nproperty int a\n", "0", "1 2 3 7 8\n4 5 6 9 10\n");
  const std::string words = "property ushort r\nproperty ushort g\nproperty ushort b\n";
  const std::string shares =
      "property float Red\nproperty float Green\nproperty float Blue\nproperty float alpha\n";
  const std::string diffuse = "property int diffuse_red\nproperty int diffuse_green\nproperty int "
                              "diffuse_blue\n";
  return {{"a.ply", BYTE_ORDER_MARK + ply ("", "0", rows), "", ""},
          // Colours of every name and scale are bytes.
          {"a.ply", ply (words, "0", "1 2 3 65535 0 514\n4 5 6 255 256 0\n"),
           "red 255 0, green 0 1, blue 2 0", ""},
          {"a.ply", ply (words, "0", "1 2 3 255 0 7\n4 5 6 1 2 3\n"),
           "red 255 1, green 0 2, blue 7 3", ""},
          {"a.ply", ply (shares, "0", "1 2 3 1 0 .2 1\n4 5 6 0 nan 0 .4\n"),
           "red 255 0, green 0 0, blue 51 0, alpha 255 102", ""},
          {"a.ply", ply (diffuse, "0", "1 2 3 255 0 7\n4 5 6 1 2 3\n"),
           "red 255 1, green 0 2, blue 7 3", ""},
          {"a.ply", ply (diffuse, "0", "1 2 3 255 0 -7\n4 5 6 1 2 3\n"),
           "red 255 1, green 0 2, blue -7 3", "kept as other fields"},
          {"a.ply", ply ("", "2", rows), "", "2 faces of the input file were left out"},
          {"a.ply", repeated, "a 7 9, a_2 8 10", "two fields 'a'"}};
}

std::vector<Readable>
readableObjs ()
{
  const std::string points = "v 1.5 2 -3\nv 4 5e-3 0.1\n", half = points + "vn 0.5 0 1\n";
  const std::string normals = points + "vn 0.1 0 1\nvn 0.2 0 1\n", face = "1 face of the input";
  const std::string lines_that_go_on =
      "# c:\\\nv 1.5 \\\n2 \\\r\n  -3\nv 4 5e-3 .1\nvn 0 0 1\nvn 0 1 0\nf 1//1 \\\n 2//2 1//1\n";
  const std::string bytes = "v 1.5 2 -3 255 0 7 # a comment\nv 4 5e-3 0.1 0 1 128\n";
  const std::string as_given = "nx 0.1 0.2, ny 0 0, nz 1 1", swapped = "nx 0.2 0.1, ny 0 0, nz 1 1";
  return {{"a.obj", BYTE_ORDER_MARK + points, "", ""},
          {"a.obj", "v 1.5 2 -3\nv 4 5e-3 0.1\\\n", "", ""},
          {"a.obj", bytes, "red 255 0, green 0 1, blue 7 128", ""},
          {"a.obj", lines_that_go_on, "nx 0 0, ny 0 1, nz 1 0", face},
          {"a.obj", normals, as_given, ""},
          {"a.obj", normals + "f 1//2 2/7/1 1//2\n", swapped, face},
          {"a.obj", normals + "f -2//-1 -1//-2 -2//-1\n", swapped, face},
          {"a.obj", half + "f 1//1 2//1 1//1\n", "nx 0.5 0.5, ny 0 0, nz 1 1", face},
          {"a.obj", half + "f 1//1 2 2\n", "nx 0.5 nan, ny 0 nan, nz 1 nan", face},
          // At a sharp edge a point has several.
          {"a.obj", normals + "f 1//1 2//1 2//2\n", "nx 0.1 0.1, ny 0 0, nz 1 1",
           "1 point had several normals\n" + face},
          {"a.obj", half, "", "1 normal for 2 points"}};
}

/// Rows of a table: what comes after the coordinates of either point.
std::string
table (const std::string& first, const std::string& second)
{
  return "1.5 2 -3 " + first + "\n4 5e-3 0.1 " + second + "\n";
}

/// Text with a point in each line.
std::vector<Readable>
readableTables ()
{
  const std::string points = "1.5 2 -3\n4 5e-3 0.1\n", commas = "read as decimal points";
  const std::string rgb_header = "x y z r g b\n", skipped = "Made by a scanner\n\x01\x02\nno. of\n";
  std::vector<Readable> all{
      {"a.xyz", "1,5;2;-3\n4;0,005;0,1\n", "", commas},
      {"a.xyz", "1,5 2,0 -3,0\n4,0 0,005 0,1\n", "", commas},
      {"a.xyz", "1\n" + points, "", "promises 1 points, but there are 2"},
      {"a.xyz", skipped + points, "",
       "3 lines at the beginning of the input file are no points "
       "and were left out: 'Made by"},
      // Columns without names are guessed.
      {"a.xyz", table ("0.5", "0.75"), "intensity 0.5 0.75", "have no names"},
      {"a.xyz", table ("0.5", "0.75"), "intensity 0.5 0.75", "4 for the intensity"},
      {"a.xyz", table ("255 0 7", "1 2 3"), "red 255 1, green 0 2, blue 7 3", "4 to 6 for colours"},
      {"a.xyz", table ("0 0 1", "0 -1 0"), "nx 0 0, ny 0 -1, nz 1 0", "4 to 6 for normals"},
      {"a.xyz", table ("255 0 7 0.5", "1 2 3 -9"),
       "red 255 1, green 0 2, blue 7 3, intensity 0.5 -9", "7 for the intensity"},
      {"a.xyz", table ("-9 255 0 7", "0.5 1 2 3"),
       "intensity -9 0.5, red 255 1, green 0 2, blue 7 3", "5 to 7 for colours"},
      {"a.pts", table ("9 255 0 7", "5 1 2 3"), "intensity 9 5, red 255 1, green 0 2, blue 7 3",
       "5 to 7 for colours"},
      {"a.xyz", table ("9 255 0 7", "5 1 2 3"), "red 9 5, green 255 1, blue 0 2, intensity 7 3",
       "4 to 6 for colours"},
      {"a.xyz", table ("0 0 1 255 0 7", "0 -1 0 1 2 3"),
       "nx 0 0, ny 0 -1, nz 1 0, red 255 1, green 0 2, blue 7 3",
       "4 to 6 for normals, 7 to 9 for colours"},
      {"a.xyz", table ("255 0 7 0 0 1", "1 2 3 0 -1 0"),
       "red 255 1, green 0 2, blue 7 3, nx 0 0, ny 0 -1, nz 1 0",
       "4 to 6 for colours, 7 to 9 for normals"},
      {"a.xyz", table ("0.5 300", "0.75 -1"), "column_4 0.5 0.75, column_5 300 -1",
       "4 for another field"},
      {"a.xyz", table ("256 0 7", "1 2 3"), "column_4 256 1, column_5 0 2, column_6 7 3",
       "6 for another field"},
      // The better name is that of the coordinate.
      {"a.csv", "lat,height,x_m,Y [m],z,lng\n5,6,1.5,2,-3,7\n8,9,4,5e-3,.1,3\n",
       "lat 5 8, height 6 9, lng 7 3", ""},
      {"a.csv", "LONGITUDE_M,LATITUDE_M,Z_M,alpha\n1.5,2,-3,.5\n4,5e-3,.1,.5\n", "alpha 0.5 0.5",
       ""},
      {"a.csv", "longitude,latitude,depth\n1.5,2,-3\n4,5e-3,.1\n", "", ""},
      {"a.csv", "\"a\",\"Points:0\",\"Points:1\",\"Points:2\"\n7,1.5,2,-3\n8,4,5e-3,.1\n", "a 7 8",
       ""},
      // All normals after all points.
      {"a.pwn", "2\n1.5 2 -3\n4 5e-3 0.1\n0 0 1\n0 -1 0\n", "nx 0 0, ny 0 -1, nz 1 0", ""},
      // Colours of every scale.
      {"a.txt", rgb_header + table ("0 0.5 1", "0.2 0 0"), "red 0 51, green 128 0, blue 255 0", ""},
      {"a.txt", rgb_header + table ("0 65535 257", "0 0 0"), "red 0 0, green 255 0, blue 1 0",
       "16 bits"},
      {"a.txt", rgb_header + table ("-1 65535 257", "0 0 0"), "red -1 0, green 65535 0, blue 257 0",
       "kept as other fields"},
      // No alpha without a colour.
      {"a.csv", "x,y,z,class,a\n1.5,2,-3,tree,\n4,5e-3,0.1,grass 2,7\n", "a nan 7",
       "column 4 of the input file, 'class',"},
      {"a.asc", "x y z t t\n" + table ("1 2", "3 4"), "t 1 3, t_2 2 4", "two fields 't'"},
      // Floats where these hold the digits.
      {"a.asc",
       "x y z time short exact huge\n" +
           table ("413456.123456 0.1 0.1000000014901161193847656 1e300",
                  "413456.123457 12345.678 -0.5 nan"),
       "time 413456.123456 413456.123457, short 0.100000001490116 12345.677734375, exact "
       "0.100000001490116 -0.5, huge 1e+300 nan",
       ""}};
  for (const std::string& text :
       {points, std::string ("1.5\t2\t-3\r\n4\t5e-3\t.1\r\n"),
        std::string ("  1.5   2  -3  \n\n4 5e-3 0.1"), std::string ("1.5,2,-3\n4,5e-3,0.1\n"),
        std::string ("1.5, 2, -3,\n4, 5E-3, +0.1,\n"), std::string ("1.5;2;-3\n4;0.005;0.1\n"),
        BYTE_ORDER_MARK + points, std::string ("# text\n//\n% more\n1.5 2 -3\n#\n4 5e-3 0.1\n"),
        std::string ("\"1.5\",\"2\",\"-3\"\n\"4\",\"5e-3\",\"0.1\"\n"), "2\n" + points,
        std::string ("1.5 2 -3\r\r4 5e-3 0.1\r"),
        std::string ("BEGIN\n1.5 2 -3\nEnd\nBegin\n4 5e-3 0.1\nEND\n"),
        std::string ("1\n1.5 2 -3\n1\n4 5e-3 0.1\n"), // two scans in one file
        // Comments that are no header, and one that is.
        "# x y z are in metres\n" + points, "# the axes x , y , z\n" + points,
        std::string ("# columns: y x z\n2 1.5 -3\n5e-3 4 0.1\n")})
    all.push_back ({"a.xyz", text, "", ""});
  for (const std::string header :
       {"red,green,blue,x,y,z,label,Intensity\n", "R;G;B;X;Y;Z;label;I\n",
        "//R G B X Y Z label Scalar_Intensity\n",
        "# red green blue X[m] Y[m] Z[m] Label intensity\n",
        "\xef\xbb\xbf\"Red\",\"Green\",\"Blue\",\"Easting\",\"Northing\",\"Height (m)\",\"label\","
        "\"reflectance\"\r\n"})
    for (const char separator : {' ', ',', ';'}) {
      std::string rows = "255 0 7 1.5 2 -3 12 0.25\n0 1 2 4 5e-3 0.1 -1 0.5\n";
      std::replace (rows.begin (), rows.end (), ' ', separator);
      all.push_back ({"a.csv", header + rows,
                      "red 255 0, green 0 1, blue 7 2, label 12 -1, intensity 0.25 0.5", ""});
    }
  return all;
}

std::vector<Readable>
readableOthers ()
{
  const std::string begin = "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET ";
  const std::string points = "POINTS 2 double\n1.5 2 -3 4 5e-3 0.1\n";
  const std::string data = "POINT_DATA 2\nNORMALS n float\n0 0 1\n0 1 0\nSCALARS a float\n"
                           "LOOKUP_TABLE default\n7 8\nCOLOR_SCALARS rgb 4\n1 0 .2 1\n0 0 0 1\n";
  return {{"a.vtk", begin + "UNSTRUCTURED_GRID\n" + points, "", ""},
          {"a.vtk", begin + "POLYDATA\n" + points + data,
           "red 255 0, green 0 0, blue 51 0, nx 0 0, ny 0 1, nz 1 0", ""},
          {"a.vtk", begin + "POLYDATA\n" + points + "POLYGONS 1 4\n3 0 1 0\n", "", "1 face of"}};
}

TEST_F (Readers, FilesOfTwoPoints)
{
  std::vector<Readable> all = readablePcds ();
  for (const auto& more : {readablePlys (), readableObjs (), readableTables (), readableOthers ()})
    all.insert (all.end (), more.begin (), more.end ());
  for (const Readable& expected : all) {
    SCOPED_TRACE (expected.file + ": " + expected.bytes);
    const Cloud cloud = read (expected.file, expected.bytes);
    const bool has_types = expected.file == "a.pcd" || expected.file == "a.ply";
    EXPECT_EQ (cloud.positions (),
               has_types ? (std::vector<Eigen::Vector3d>{{1, 2, 3}, {4, 5, 6}})
                         : (std::vector<Eigen::Vector3d>{{1.5, 2.0, -3.0}, {4.0, 5.0e-3, 0.1}}));
    EXPECT_EQ (cloud.single_precision, has_types);
    EXPECT_EQ (fieldsOf (cloud), expected.fields);
    std::istringstream parts (expected.warnings);
    std::size_t count = 0;
    for (std::string part; std::getline (parts, part); ++count)
      EXPECT_THAT (cloud.warnings, testing::Contains (HasSubstr (part)));
    EXPECT_EQ (cloud.warnings.size (), count) << testing::PrintToString (cloud.warnings);
  }
}

TEST_F (Readers, ColumnsAreChosen)
{
  const std::vector<std::pair<std::string, std::string>> texts{
      {"0 7 2 1.5 -3\n1 8 5e-3 4 0.1\n", "column_1 0 1, column_2 7 8"},
      {"id;a;b;c;d\n0;7;2;1.5;-3\n1;8;5e-3;4;.1\n", "id 0 1, a 7 8"},
      {"# x y z red n\n0 7 2 1.5 -3\n1 8 5e-3 4 0.1\n", "column_1 0 1, column_2 7 8"}};
  for (const auto& [text, fields] : texts) {
    writeFile ("a.xyz", text);
    const Cloud cloud = readCloud (path ("a.xyz"), {false, {4, 3, 5}});
    EXPECT_EQ (cloud.positions (), (std::vector<Eigen::Vector3d>{{1.5, 2, -3}, {4, 5e-3, 0.1}}));
    EXPECT_EQ (fieldsOf (cloud), fields);
    EXPECT_THAT (cloud.warnings, IsEmpty ());
    EXPECT_THROW (readCloud (path ("a.xyz"), {false, {4, 3, 6}}), ReadError);
  }
  EXPECT_THAT (run ({"--columns", "1,2,2", "a.xyz", "o.ply"}).err, HasSubstr ("three different"));
  writeFile ("a.ply", ply ("", "0", "1 2 3\n4 5 6\n"));
  expectFailure ({"--columns", "1,2,3", "a.ply", "o.ply"}, INPUT_FAILED, "--columns is for text");
}

TEST_F (Readers, RowsOfAnOrganizedCloudAreTold)
{
  const std::string text = "FIELDS x y z\n" + XYZ_FLOATS + "WIDTH 3\nHEIGHT 2\nDATA ascii\n" +
                           "0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 0 0\n2 1 0\n";
  EXPECT_THAT (read ("a.pcd", text).notes, ElementsAre (HasSubstr ("in 2 rows of 3 points")));
}

// As VTK writes them.
TEST_F (Readers, EveryEncodingOfVtp)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkUnsignedCharArray> colors;
  vtkNew<vtkDoubleArray> weights;
  colors->SetName ("RGB");
  colors->SetNumberOfComponents (3);
  weights->SetName ("weight");
  for (int i = 0; i < 50; ++i) {
    points->InsertNextPoint (0.5 * i, 2.0, -i);
    colors->InsertNextTuple3 (5 * i, 6, 7);
    weights->InsertNextValue (0.1 * i);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints (points);
  data->GetPointData ()->SetScalars (colors);
  data->GetPointData ()->AddArray (weights);
  for (int kind = 0; kind < 24; ++kind) {
    SCOPED_TRACE (kind);
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData (data);
    writer->SetFileName (path ("a.vtp").c_str ());
    writer->SetDataMode (kind % 3);
    writer->SetEncodeAppendedData (kind / 3 % 2);
    if (kind / 6 % 2 == 0)
      writer->SetCompressorTypeToNone ();
    else
      writer->SetBlockSize (64);
    if (kind >= 12) {
      writer->SetHeaderTypeToUInt64 ();
      writer->SetByteOrderToBigEndian ();
    }
    writer->Write ();
    const Cloud cloud = readCloud (path ("a.vtp"));
    ASSERT_EQ (cloud.size (), 50U);
    EXPECT_EQ (cloud.position (49), Eigen::Vector3d (24.5, 2.0, -49.0));
    EXPECT_EQ (colorFields (cloud)[0]->asDouble (49), 245.0);
    EXPECT_EQ (cloud.find ("weight")->asDouble (30), 0.1 * 30);
    const std::string bytes = readFile ("a.vtp");
    for (std::size_t length = 0; length < bytes.find ("</DataArray"); length += 37)
      EXPECT_NE (errorOf ("a.vtp", bytes.substr (0, length)), "none") << length;
  }
}

// KITTI stores four floats of a point, nuScenes five.
TEST_F (Readers, FloatsOfALidar)
{
  for (const std::size_t count : {4U, 5U}) {
    std::string bytes (40 * count, '\0'); // of ten points
    for (std::size_t i = 0; i < 10 * count; ++i)
      putNumber (bytes, 4 * i, static_cast<float> (i % count == 4 ? i % 32 : 0.25 * i));
    const Cloud cloud = read ("a.bin", bytes);
    ASSERT_EQ (cloud.size (), 10U);
    EXPECT_EQ (cloud.position (1), 0.25 * Eigen::Vector3d (count, count + 1, count + 2));
    EXPECT_EQ (namesOf (cloud), count == 4 ? std::vector<std::string>{"intensity"}
                                           : (std::vector<std::string>{"intensity", "ring"}));
    putNumber (bytes, 8, 1e30F);
    EXPECT_THAT (errorOf ("a.bin", bytes), HasSubstr ("does not hold four floats"));
  }
}

TEST_F (Readers, PointsThatAreNotFiniteAreLeftOut)
{
  Cloud cloud = read ("a.xyz", "1.5 2 -3\nnan 0 0\n4 5e-3 0.1\n1 inf 0\n");
  EXPECT_EQ (cloud.size (), 4U);
  Triangles none;
  EXPECT_EQ (removeNonFinitePoints (cloud, none), 2U);
  EXPECT_EQ (cloud.position (1), Eigen::Vector3d (4.0, 5.0e-3, 0.1));
}

using Facets = std::vector<std::array<std::array<float, 3>, 3>>;

std::string
stlBytes (const Facets& facets, const std::string& header = "a mesh")
{
  std::string bytes (84 + 50 * facets.size (), '\0');
  bytes.replace (0, header.size (), header);
  putNumber (bytes, 80, static_cast<std::uint32_t> (facets.size ()));
  for (std::size_t f = 0; f < facets.size (); ++f)
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (std::size_t axis = 0; axis < 3; ++axis)
        putNumber (bytes, 84 + 50 * f + 12 * (corner + 1) + 4 * axis, facets[f][corner][axis]);
  return bytes;
}

const Facets SQUARE{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                    {{{1, 0, -0.0F}, {1, 1, 0.5F}, {0, 1, 0}}}};

const std::string SQUARE_TEXT =
    "solid name\n facet normal 0 0 0\n  outer loop\n   vertex 0 0 0\r\n   vertex 1 0 0\n"
    "   vertex 0 1 0\n  endloop\n endfacet\n facet normal 0 0 0\n  outer loop\n"
    "   vertex 1 0 -0\n   vertex 1 1 0.5\n   vertex 0 1 0\n  endloop\n endfacet\nendsolid name\n";

TEST_F (Readers, EqualCornersOfStlAreOnePoint)
{
  std::string upper = SQUARE_TEXT;
  std::transform (upper.begin (), upper.end (), upper.begin (), ::toupper);
  for (const std::string& bytes :
       {stlBytes (SQUARE), stlBytes (SQUARE, "solid, but binary"), SQUARE_TEXT, upper}) {
    const Cloud cloud = read ("a.stl", bytes);
    EXPECT_EQ (cloud.positions (),
               (std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.5}}));
    EXPECT_EQ (cloud.single_precision, bytes != SQUARE_TEXT && bytes != upper);
    EXPECT_THAT (cloud.warnings, ElementsAre (HasSubstr ("2 faces of the input file were left")));
  }
  EXPECT_THAT (read ("a.stl", stlBytes (SQUARE) + std::string (120, 'x')).warnings,
               ElementsAre (HasSubstr ("2 faces"), HasSubstr ("more data than the 2 facets")));
  const float nan = std::nanf (""); // the tool leaves such a corner out
  EXPECT_EQ (read ("a.stl", stlBytes ({{{{nan, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                                       {{{nan, 0, 0}, {1, 0, 0}, {2, 2, 0}}}}))
                 .size (),
             4U);
}

TEST_F (Readers, ManyPointsOfStlStayInTheirOrder)
{
  Facets facets;
  std::vector<Eigen::Vector3d> points;
  std::set<std::array<float, 3>> seen;
  for (int i = 0; i < 5000; ++i) {
    facets.emplace_back ();
    for (int k = 0; k < 3; ++k) {
      const std::array<float, 3> corner{static_cast<float> (i % 70 + k % 2),
                                        static_cast<float> (i / 70 + k / 2), 0.0F};
      facets.back ()[static_cast<std::size_t> (k)] = corner;
      if (seen.insert (corner).second)
        points.emplace_back (corner[0], corner[1], corner[2]);
    }
  }
  EXPECT_EQ (read ("a.stl", stlBytes (facets)).positions (), points);
}

TEST_F (Readers, TemporaryFilesArePrivateAndTheirLeftoversAreTold)
{
  ::setenv ("TMPDIR", path ("").c_str (), 1);
  {
    const AtomicFile file ("-");
    std::size_t found = 0;
    for (const auto& entry : std::filesystem::directory_iterator (path (""))) {
      ++found;
      EXPECT_EQ (entry.status ().permissions () & std::filesystem::perms::all,
                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    }
    EXPECT_EQ (found, 1U);
  }
  ::unsetenv ("TMPDIR");
  // As runs that were killed leave them, where each process has the same number.
  for (int i = 0; i < 100; ++i)
    writeFile (".pcl_floater." + std::to_string (::getpid ()) + "." + std::to_string (i) + ".tmp",
               "");
  try {
    const AtomicFile file (path ("mesh.ply"));
    ADD_FAILURE () << "there is a name left";
  }
  catch (const WriteError& error) {
    EXPECT_THAT (error.what (), HasSubstr ("remove the files '.pcl_floater.*.tmp'"));
  }
}

double
secondsToRead (const std::function<void ()>& read)
{
  const auto start = std::chrono::steady_clock::now ();
  read ();
  return std::chrono::duration<double> (std::chrono::steady_clock::now () - start).count ();
}

// Corners whose hashes without a seed share a 4096th of all places.
TEST_F (Readers, CornersOfStlThatShareTheirHashesTakeNoLonger)
{
  constexpr std::uint32_t ONE = 0x3F800000, CORNERS = 60000;
  constexpr std::uint64_t GOLD = 0x9E3779B97F4A7C15U, PLACES = 0xFFFU << 6U;
  const auto mix = [] (std::uint64_t hash, std::uint64_t bits) {
    hash = (hash ^ bits) * GOLD;
    return hash ^ hash >> 32U;
  };
  const auto number = [] (std::uint32_t bits) {
    float value = 0.0F;
    std::memcpy (&value, &bits, sizeof value);
    return value;
  };
  std::vector<std::array<float, 3>> alike, others;
  for (std::uint32_t i = 0; alike.size () < CORNERS; ++i) {
    const std::uint32_t x = ONE + 977 * i, y = ONE + 7919 * i;
    const std::uint64_t hash = mix (mix (0, x), y);
    for (std::uint32_t z = ONE; z < ONE + (1U << 23U) && alike.size () < CORNERS; ++z)
      if ((mix (hash, z) & PLACES) == 0) {
        alike.push_back ({number (x), number (y), number (z)});
        others.push_back (
            {number (x), number (y), number (ONE + static_cast<std::uint32_t> (alike.size ()))});
      }
  }
  const auto bytesOf = [] (const std::vector<std::array<float, 3>>& corners) {
    Facets facets (corners.size () / 3);
    for (std::size_t i = 0; i < corners.size (); ++i)
      facets[i / 3][i % 3] = corners[i];
    return stlBytes (facets);
  };
  const std::string bad = bytesOf (alike), plain = bytesOf (others);
  const double usual = secondsToRead ([&] { read ("a.stl", plain); });
  EXPECT_LT (secondsToRead ([&] { read ("b.stl", bad); }), 10.0 * usual + 0.3);
}

TEST_F (Readers, ManyFieldsOfOneName)
{
  constexpr std::size_t FIELDS = 20000;
  std::string names, sizes, types;
  for (std::size_t i = 0; i < FIELDS; ++i) {
    names += " a";
    sizes += " 1";
    types += " U";
  }
  const std::string bytes = "FIELDS x y z" + names + "\nSIZE 4 4 4" + sizes + "\nTYPE F F F" +
                            types + "\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA binary\n" +
                            std::string (12 + FIELDS, '\0');
  Cloud cloud;
  EXPECT_LT (secondsToRead ([&] { cloud = read ("a.pcd", bytes); }), 5.0);
  EXPECT_EQ (cloud.fields.back ().name, "a_20000");
  EXPECT_THAT (cloud.warnings, testing::Contains (HasSubstr ("and 19998 other fields alike")));
  EXPECT_LT (cloud.warnings.size (), 4U);
}

LasFile
lasFile (int minor = 2, int format = 0)
{
  LasFile file;
  file.minor = minor;
  file.format = format;
  file.scale = {0.01, 0.001, 0.5};
  file.offset = {500000.0, 5500000.0, -10.0};
  file.points = {{0, 1, -2}, {LARGEST, -LARGEST - 1, 3}, {7, 7, 7}};
  file.colors = {{0x1234, 0, 0xFFFF}, {255, 256, 257}, {0, 0, 0}};
  return file;
}

TEST_F (Readers, EveryVersionAndPointFormatOfLas)
{
  for (int minor = 0; minor <= 4; ++minor)
    for (int format = 0; format <= 10; ++format) {
      SCOPED_TRACE ("1." + std::to_string (minor) + ", format " + std::to_string (format));
      LasFile file = lasFile (minor, format);
      file.extra_bytes = static_cast<std::size_t> (format % 3);
      file.variable_records = static_cast<std::size_t> (minor % 3);
      const Cloud cloud = read ("a.las", lasBytes (file));
      ASSERT_EQ (cloud.size (), 3U);
      EXPECT_FALSE (cloud.single_precision);
      EXPECT_THAT (cloud.warnings, IsEmpty ());
      const std::vector<Eigen::Vector3d> positions = cloud.positions ();
      for (std::size_t p = 0; p < 3; ++p)
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
          const double expected =
              file.points[p][static_cast<std::size_t> (axis)] * file.scale[axis] +
              file.offset[axis];
          EXPECT_EQ (positions[p][axis], expected);
          EXPECT_EQ (cloud.position (p)[axis], expected);
        }
      EXPECT_EQ (cloud.find ("intensity")->value<std::uint16_t> (2), 14);
      const FieldTriple colors = colorFields (cloud);
      ASSERT_EQ (colors[0] != nullptr, (std::set<int>{2, 3, 5, 7, 8, 10}).count (format) == 1);
      if (colors[0] != nullptr) {
        EXPECT_THAT (valuesOf (*colors[0], 3), ElementsAre (0x12, 0, 0));
        EXPECT_THAT (valuesOf (*colors[1], 3), ElementsAre (0, 1, 0));
        EXPECT_THAT (valuesOf (*colors[2], 3), ElementsAre (0xFF, 1, 0));
      }
    }
}

// Points of ground, of noise and withheld, and one that was made up.
TEST_F (Readers, ClassesOfLas)
{
  for (const bool is_long : {false, true}) {
    SCOPED_TRACE (is_long);
    LasFile file = lasFile (4, is_long ? 6 : 1);
    file.points.push_back ({1, 2, 3});
    std::string bytes = lasBytes (file);
    const std::size_t record = (bytes.size () - 375) / 4;
    const std::array<int, 4> classes{2, 7, 6, 5};
    for (std::size_t p = 0; p < 4; ++p) {
      const std::size_t at = 375 + p * record + 14;
      const int withheld = p == 2 ? 1 : 0, synthetic = p == 3 ? 1 : 0;
      putNumber (bytes, at, static_cast<std::uint8_t> (is_long ? 0x52 : 0x2A)); // second of five
      putNumber (bytes, at + 1,
                 static_cast<std::uint8_t> (is_long
                                                ? synthetic + 4 * withheld
                                                : classes[p] + 32 * synthetic + 128 * withheld));
      if (is_long)
        putNumber (bytes, at + 2, static_cast<std::uint8_t> (classes[p]));
      putNumber (bytes, at + (is_long ? 6 : 4), static_cast<std::uint16_t> (300 + p));
      putNumber (bytes, at + (is_long ? 8 : 6), 0.25 * static_cast<double> (p));
    }
    const Cloud cloud = read ("a.las", bytes);
    EXPECT_EQ (fieldsOf (cloud),
               "intensity 0 7 14 21, return_number 2 2 2 2, number_of_returns 5 5 5 5, "
               "classification 2 7 6 5, synthetic 0 0 0 1, withheld 0 0 1 0, "
               "point_source_id 300 301 302 303, gps_time 0 0.25 0.5 0.75");
    EXPECT_EQ (cloud.left_out, (std::vector<bool>{false, true, true, false}));
    EXPECT_THAT (cloud.notes, ElementsAre ("1 point that the file marks as withheld was left out",
                                           "1 point of class 7 (1) was left out"));
    const auto leftOut = [this] (const std::vector<int>& chosen) {
      return readCloud (path ("a.las"), {false, {}, chosen}).left_out;
    };
    EXPECT_EQ (leftOut ({7, 5}), (std::vector<bool>{true, false, true, false}));
    EXPECT_THROW (leftOut ({6}), ReadError); // which is withheld
    EXPECT_THAT (read ("a.las", lasBytes (lasFile ())).left_out, IsEmpty ());
  }
  writeFile ("a.xyz", "1 2 3\n4 5 6\n");
  expectFailure ({"--classes", "2,6", "a.xyz", "o.ply"}, INPUT_FAILED, "no field 'classification'");
  expectFailure ({"--classes", "2,six", "a.xyz", "o.ply"}, USAGE, "no numbers of classes");
}

// A quarter turn about z, and a move; the scans have 2 x 2 and 3 x 1 pixels.
TEST_F (Readers, ScansOfPtx)
{
  const std::string head = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n10 20 30 1\n";
  const std::string first = "2\n2\n" + head + "1 2 3 .5\n0 0 0 .5\n4 5 6 .25\n7 8 9 1\n";
  const Cloud one = read ("a.ptx", first);
  EXPECT_EQ (one.lattice_width, 2U);
  EXPECT_EQ (one.sensor_origin, (std::array<double, 3>{10, 20, 30}));
  EXPECT_EQ (one.position (0), Eigen::Vector3d (8, 21, 33));
  EXPECT_EQ (one.left_out, (std::vector<bool>{false, true, false, false}));
  EXPECT_EQ (fieldsOf (one), "intensity 0.5 0.5 0.25 1");
  EXPECT_THAT (one.notes, ElementsAre ("1 scan: 2 x 2 pixels from (10, 20, 30)",
                                       "1 point without a return was left out"));
  const Cloud two = read ("a.ptx", first + "3\n1\n" + head + "1 0 0 1\n1 0 1 1\n1 0 2 1\n\n");
  EXPECT_EQ (two.size (), 7U);
  EXPECT_EQ (two.lattice_width, 0U);
  EXPECT_EQ (two.towards_sensors.size (), 7U);
  EXPECT_EQ (two.find ("scan")->asDouble (4), 1.0);
  EXPECT_EQ (fieldsOf (read ("a.ptx", "1\n1\n" + head + "1 2 3 .5 7 8 9\n")),
             "intensity 0.5, red 7, green 8, blue 9");
  EXPECT_THAT (errorOf ("a.ptx", first.substr (0, first.size () - 9)), HasSubstr ("truncated"));
  EXPECT_THAT (errorOf ("a.ptx", "9\n999\n" + head), HasSubstr ("no number of the rows"));
}

TEST_F (Readers, OddLasFiles)
{
  LasFile file = lasFile (2, 2); // colours that were written as 8 bits
  file.colors = {{255, 0, 3}, {1, 2, 3}, {0, 0, 0}};
  const Cloud bright = read ("bright.las", lasBytes (file));
  EXPECT_THAT (valuesOf (*colorFields (bright)[0], 3), ElementsAre (255, 1, 0));
  file.colors.assign (3, {0, 0, 0});
  const Cloud black = read ("black.las", lasBytes (file));
  EXPECT_EQ (colorFields (black)[0], nullptr);
  EXPECT_THAT (black.warnings, ElementsAre (HasSubstr ("all colours of the input file are black")));
  // The number of 32 bits is 0 where it does not hold all points, and in files of the new formats.
  std::string bytes = lasBytes (lasFile (4));
  putNumber (bytes, 107, std::uint32_t{0});
  EXPECT_EQ (read ("a.las", bytes).size (), 3U);
  putNumber (bytes, 107, std::uint32_t{3});
  putNumber (bytes, 247, std::uint64_t{0});
  EXPECT_EQ (read ("a.las", bytes).size (), 3U);
  putNumber (bytes, 247, std::uint64_t{2});
  EXPECT_EQ (read ("a.las", bytes).size (), 2U);
  // A scale that takes a coordinate beyond all numbers makes a point that is left out.
  file.scale = {1e300, 1.0, 1.0};
  Cloud far = read ("far.las", lasBytes (file));
  Triangles none;
  EXPECT_EQ (removeNonFinitePoints (far, none), 1U);
}

struct BadFile
{
  std::string file, bytes, cause;
};

template <typename T>
BadFile
lasWith (std::size_t at, T number, const std::string& cause)
{
  std::string bytes = lasBytes (lasFile ());
  putNumber (bytes, at, number);
  return {"a.las", bytes, cause};
}

std::vector<BadFile>
badFiles ()
{
  const std::string typed = "FIELDS x y z\n" + XYZ_FLOATS, two = "WIDTH 2\nHEIGHT 1\n";
  const std::string many = "WIDTH 4000000000\nHEIGHT 4000000000\nPOINTS 16000000000000000000\n";
  const std::string zeros (12, '\0'), sizes ("\x05\0\0\0\x18\0\0\0", 8);
  const std::string ascii = typed + two + "DATA ascii\n", compressed = "DATA binary_compressed\n";
  const std::string vertex = "property float x\nproperty float y\nproperty float z\nend_header\n";
  const std::string two_vertices = "ply\nformat ascii 1.0\nelement vertex 2\n" + vertex;
  const std::string points = "v 0 0 0\nv 1 0 0\nvn 0 0 1\n", las = lasBytes (lasFile ());
  std::string lying = stlBytes (SQUARE), absurd_las = lasBytes (lasFile (4)), garbage;
  putNumber (lying, 80, std::uint32_t{4294967295U});
  std::string short_las = absurd_las;
  putNumber (short_las, 94, std::uint16_t{227});
  putNumber (absurd_las, 247, std::numeric_limits<std::uint64_t>::max ());
  for (int i = 0; i < 1100; ++i)
    garbage += "no point\n";
  std::string counting;
  for (int i = 5; i < 15; ++i)
    counting += std::to_string (i) + " 1 2 3\n";
  return {
      {"a.pcd", "", "empty"},
      {"a.pcd", "hello world\n", "line 1: this is not a line of a PCD header"},
      {"a.pcd", std::string (100, '\xfe'), "this is not a line of a PCD header"},
      {"a.pcd", typed + two, "truncated"},
      {"a.pcd", ascii + "0.00000 0.00000 0.00000\n", "only 1"},
      {"a.pcd", ascii + "0 0 0\n0 1   \n    \n", "line 8: it has fewer values"},
      {"a.pcd", ascii + "0 0 0\n0 1 2 3\n", "line 8: it has more values"},
      {"a.pcd", ascii + "0 0 0\n0 1 high\n", "line 8: 'high' is not a number"},
      {"a.pcd", ascii + "0 0 0\n0 1 2x\n", "line 8: '2x' is not a number"},
      {"a.pcd", typed + two + "DATA binary\n" + zeros, "truncated"},
      {"a.pcd", typed + many + "DATA binary\n" + zeros, "truncated"},
      {"a.pcd", typed + many + "DATA ascii\n0 0 0\n", "truncated"},
      {"a.pcd", typed + many + compressed + sizes + "abcde", "truncated"},
      {"a.pcd", typed + two + compressed + sizes + "ab", "truncated"},
      {"a.pcd", typed + two + compressed + "\x05", "truncated"},
      {"a.pcd", typed + two + compressed + sizes + "\xff\xff\xff\xff\xff",
       READS_COMPRESSED ? "damaged" : "liblzf"},
      {"a.pcd", typed + "WIDTH 18446744073709551615\nHEIGHT 2\nDATA ascii\n", "is too large"},
      {"a.pcd", typed + two + "DATA hex\n00\n", "'hex'"},
      {"a.pcd", typed + two + "VIEWPOINT 1 2 north 1 0 0 0\nDATA ascii\n0 0 0\n1 1 1\n", "north"},
      {"a.pcd", typed + "WIDTH 0\nHEIGHT 1\nPOINTS 0\nDATA ascii\n", "no points"},
      {"a.pcd", typed + "WIDTH 3\nHEIGHT 2\nPOINTS 5\nDATA ascii\n", "POINTS is 5"},
      {"a.pcd", typed + "WIDTH -3\nHEIGHT 1\nDATA ascii\n", "'-3' is not a number"},
      {"a.pcd", pcd ("a y z", XYZ_FLOATS, "0 0 0\n1 1 1\n"),
       "no coordinate 'x' (fields of the file: a, y, z)"},
      {"a.pcd", pcd ("x y z", "SIZE 4 4 3\nTYPE F F Q\n", "0 0 0\n1 1 1\n"), "TYPE Q and SIZE 3"},
      {"a.pcd", pcd ("x y z", "SIZE 4 4\nTYPE F F F\n", "0 0 0\n"), "differ in length"},
      {"a.pcd", pcd ("x y z", XYZ_FLOATS + "COUNT 1 1 -20\n", ""), "'-20'"},
      {"a.ply", "plywood\n", "not a PLY file"},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 2\n", "truncated"},
      {"a.ply", "ply\nelement vertex 2\n" + vertex, "no format line"},
      {"a.ply", "ply\nformat ascii 1.0\nelement face 0\n" + vertex, "no element 'vertex'"},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty quad x\n" + vertex,
       "line 4: 'quad' is not a type of PLY"},
      {"a.ply", "ply\nformat binary 1.0\nelement vertex 2\n" + vertex, "'binary' is not a format"},
      {"a.ply", two_vertices + "0.00000 0.00000 0.00000\n", "only 1"},
      {"a.ply", two_vertices + "0 0 0\n0 high 1\n", "line 9: 'high' is not a number"},
      {"a.ply", "ply\nformat binary_big_endian 1.0\nelement vertex 2\n" + vertex + zeros,
       "truncated"},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 18446744073709551615\n" + vertex + "0 0 0\n",
       "truncated"},
      {"a.ply",
       "ply\nformat binary_little_endian 1.0\nelement vertex 1\n"
       "property list uint double marks\n" +
           vertex + std::string (16, '\xff'),
       "truncated"},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 0\n" + vertex, "no points"},
      {"a.ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
       "end_header\n0 0\n",
       "no coordinate 'z'"},
      {"a.obj", "# nothing\nf 1 2 3\n", "no points"},
      {"a.obj", "v 1 \\\n2 3\n\nv 4 high 6\n", "line 4: 'high' is not a number"},
      {"a.obj", "v 0 0 0\nv 1 2\n", "line 2: a point has 3, 4 or 6 numbers"},
      {"a.obj", "v 0 0 0 256 255 255\n", "a colour must be from 0 to 1"},
      {"a.obj", points + "f 1//2\n", "a face names point 1 and normal 2"},
      {"a.obj", points + "f 3//1\n", "a face names point 3 and normal 1"},
      {"a.obj", points + "f 0//1\n", ""},
      {"a.obj", points + "f -3//1\n", ""},
      {"a.obj", points + "f 1//x\n", ""},
      {"a.stl", "hello", "too short for a binary STL file"},
      {"a.stl", std::string (200, 'x'), "promises"},
      {"a.stl", lying, "promises 4294967295 facets, but the file has only 2"},
      {"a.stl", stlBytes ({}), "no points"},
      {"a.stl", "solid a\nendsolid a\n", "no points"},
      {"a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 high 2\n",
       "line 4: 'high' is not a number"},
      {"a.stl", "solid a\nvertex 1 2 3\nendsolid\n", "after a whole facet"},
      {"a.las", "lasf" + las.substr (4), "does not begin with 'LASF'"},
      {"a.las", las.substr (0, 100), "its header is truncated"},
      lasWith (24, std::uint8_t{2}, "version 2.2 of LAS"),
      lasWith (25, std::uint8_t{5}, "version 1.5 of LAS"),
      lasWith (94, std::uint16_t{226}, "its header has 226 bytes"),
      {"a.las", short_las, "its header has 227 bytes, fewer than the 375"},
      lasWith (96, std::uint32_t{100}, "the points begin at byte 100"),
      lasWith (96, std::uint32_t{4000000000U}, "the points begin at byte 4000000000"),
      lasWith (104, std::uint8_t{0x80}, "laszip -i a.laz -o a.las, or pdal translate"),
      lasWith (104, std::uint8_t{0x41}, "compressed"),
      lasWith (104, std::uint8_t{11}, "its points are of format 11; 0 to 10"),
      lasWith (105, std::uint16_t{19}, "each point 19 bytes, fewer than the 20"),
      lasWith (107, std::uint32_t{0}, "no points"),
      lasWith (107, std::uint32_t{4},
               "promises 4 points of 20 bytes each, but the file has only 3"),
      {"a.las", absurd_las, "promises 18446744073709551615 points"},
      lasWith (131, 0.0, "the scale or the offset"),
      lasWith (139, NOT_A_NUMBER, "the scale or the offset"),
      lasWith (171, -std::numeric_limits<double>::infinity (), "the scale or the offset"),
      {"a.e57", las, "convert it: pdal translate a.e57 a.las, or CloudCompare"},
      {"a.laz", las, "it is compressed (LAZ), which cannot be read; decompress it: laszip -i"},
      {"a.xyz", "hello\n",
       "it has no points: no line has three numbers, x, y and z; it begins with 'hello'"},
      {"a.xyz", "1 2\n3 4\n", "no line has three numbers"},
      {"a.xyz", std::string (1000, '\xfe'), "no line has three numbers"},
      {"a.xyz", std::string (100000, '1') + " 2 3\n", "no line has three"},
      {"a.xyz", "x y z r\n1 2\n", "no line has three numbers"},
      {"a.xyz", "7\n", "no line has three numbers"},
      {"a.xyz", garbage + "1 2 3\n", "no line of the first 1000 has three"},
      {"a.xyz", "x y z\nx y z\n", "in the columns that its header names"},
      {"a.xyz", "x y z a\n1 2 3\n", "in the columns that its header names"},
      {"a.asc", "ncols 3\nnrows 2\nxllcorner 0\n1 2 3\n4 5 6\n", "a grid of heights (ESRI ASCII)"},
      {"a.csv", "id,d 1,d2\n1,2,3\n", "its header 'id,d 1,d2' names no x, y and z: name them"},
      {"a.xyz", "id d1 d2 d3\n1 2 3 4\n", "such as --columns 2,3,4"},
      {"a.xyz", counting, "its first column counts the points"},
      {"a.xyz", "1 2 3\n4 5\n", "line 2: it does not have 3 columns"},
      {"a.xyz", "1 2 3\n4 5 6 7\n", "line 2: it does not have 3 columns"},
      {"a.csv", "1,2,3,4\n5,6\n", "line 2: it does not have 4 columns"},
      {"a.xyz", "1 2 3\n4 5 high\n", "line 2: 'high' is not a number"},
      {"a.xyz", "1 2 3\n4 5 6x\n", "line 2: '6x' is not a number"},
      {"a.csv", "x,y,z,a\n1,2,3,4\n1,2,3,high\n", "line 3: 'high' is not a number"},
      {"a.pts", "3\n1 2 3\n4 5 6\n", "promises 3 points, but the file has only 2"},
      {"a.pts", "18446744073709551615\n1.5 2 -3\n", "has only 1"},
      {"a.xyz", std::string ("\xff\xfe\x31\0 \0", 6), "UTF-16"}};
}

TEST_F (Readers, FilesThatCannotBeRead)
{
  for (const BadFile& bad : badFiles ()) {
    SCOPED_TRACE (bad.bytes.substr (0, 300));
    const std::string error = errorOf (bad.file, bad.bytes);
    EXPECT_THAT (error, HasSubstr (bad.cause));
    EXPECT_NE (error, "none");
  }
}

/// With the sanitizers, this also finds reads beyond the end of a file.
TEST_F (Readers, EveryPrefixIsRefusedOrWhole)
{
  const Sample sample = makeSample (true, 4);
  // No prefix shorter than `least` may be read.
  const auto check = [&] (const std::string& bytes, auto parse, std::size_t least) {
    std::size_t refused = 0;
    for (std::size_t length = 0; length <= bytes.size (); ++length) {
      // A copy, so that a sanitizer notices reads beyond the prefix.
      const std::vector<char> prefix (bytes.begin (),
                                      bytes.begin () + static_cast<std::ptrdiff_t> (length));
      try {
        const Cloud cloud = parse (FileBytes (std::string_view (prefix.data (), prefix.size ())));
        EXPECT_GE (length, least);
        EXPECT_LE (cloud.size (), sample.size ());
        EXPECT_EQ (cloud.positions ().size (), cloud.size ());
        for (const Field& field : cloud.fields)
          EXPECT_EQ (valuesOf (field, cloud.size ()).size (), cloud.size ());
      }
      catch (const ReadError& error) {
        EXPECT_LT (length, bytes.size ()) << error.what ();
        EXPECT_STRNE (error.what (), "");
        ++refused;
      }
    }
    EXPECT_GT (refused, 0U);
  };
  for (const PcdKind kind : readPcdKinds ()) {
    writePcd (path ("in.pcd"), sample, kind);
    const auto parse = [] (const FileBytes& file) { return parsePcd (file, true); };
    check (readFile ("in.pcd"), parse, 1);
  }
  for (const PlyKind kind : {PlyKind::ASCII, PlyKind::LITTLE, PlyKind::BIG})
    check (
        plyText (sample, kind), [] (const FileBytes& file) { return parsePly (file, true); }, 1);
  check (objText (sample), parseObj, 1);
  const std::string rows =
      "3\nx y z red green blue label\n1 2 3 4 5 6 a\n7.8 2 3 4 5 6 b\n1 1 1 1 1 1 c\n";
  check (
      rows, [] (const FileBytes& file) { return parseTable (file); }, rows.size () - 1);
  check (stlBytes (SQUARE), parseStl, stlBytes (SQUARE).size ());
  check (SQUARE_TEXT, parseStl, SQUARE_TEXT.rfind ("endsolid") + 8);
  const std::string scan =
      "1\n2\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n1 2 3 1\n4 5 6 1";
  check (scan, parsePtx, scan.size () - 2);
  for (const int minor : {2, 4}) {
    const std::string las = lasBytes (lasFile (minor, 3));
    check (las, parseLas, las.size ());
  }
}

} // namespace
} // namespace pcl::floater

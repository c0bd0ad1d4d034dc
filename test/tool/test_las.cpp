// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// LAS files of every version and point format.
#include "cloud_reader.h"
#include "command_line_test.h"
#include "las_file.h"
#include "mesh_files.h"

#include <gmock/gmock.h>

#include <limits>

namespace pcl::floater {
namespace {
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::int32_t LARGEST = std::numeric_limits<std::int32_t>::max ();

LasFile
smallFile ()
{
  LasFile file;
  file.scale = {0.01, 0.001, 0.5};
  file.offset = {500000.0, 5500000.0, -10.0};
  file.points = {{0, 1, -2}, {LARGEST, -LARGEST - 1, 3}, {7, 7, 7}};
  file.colors = {{0x1234, 0, 0xFFFF}, {255, 256, 257}, {0, 0, 0}};
  return file;
}

Cloud
parsed (const std::string& bytes)
{
  return parseLas (FileBytes (std::string_view (bytes)));
}

std::string
lasError (const std::string& bytes)
{
  try {
    parsed (bytes);
  }
  catch (const ReadError& error) {
    return error.what ();
  }
  return "none";
}

TEST (Las, EveryVersionAndPointFormat)
{
  for (int minor = 0; minor <= 4; ++minor)
    for (int format = 0; format <= 10; ++format) {
      SCOPED_TRACE ("1." + std::to_string (minor) + ", format " + std::to_string (format));
      LasFile file = smallFile ();
      file.minor = minor;
      file.format = format;
      file.extra_bytes = static_cast<std::size_t> (format % 3);
      file.variable_records = static_cast<std::size_t> (minor % 3);
      const std::string bytes = lasBytes (file);
      const Cloud cloud = parsed (bytes);
      ASSERT_EQ (cloud.size (), 3U);
      EXPECT_FALSE (cloud.single_precision);
      const std::vector<Eigen::Vector3d> positions = cloud.positions ();
      for (std::size_t p = 0; p < 3; ++p)
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
          const double expected =
              file.points[p][static_cast<std::size_t> (axis)] * file.scale[axis] +
              file.offset[axis];
          EXPECT_EQ (positions[p][axis], expected);
          EXPECT_EQ (cloud.position (p)[axis], expected);
        }
      ASSERT_NE (cloud.find ("intensity"), nullptr);
      EXPECT_EQ (cloud.find ("intensity")->value<std::uint16_t> (2), 14);
      const FieldTriple colors = colorFields (cloud);
      const bool has_colors =
          format == 2 || format == 3 || format == 5 || format == 7 || format == 8 || format == 10;
      ASSERT_EQ (colors[0] != nullptr, has_colors);
      EXPECT_THAT (cloud.warnings, IsEmpty ());
      if (has_colors) {
        EXPECT_EQ (colors[0]->value<std::uint8_t> (0), 0x12);
        EXPECT_EQ (colors[2]->value<std::uint8_t> (0), 0xFF);
        EXPECT_EQ (colors[0]->value<std::uint8_t> (1), 0);
        EXPECT_EQ (colors[1]->value<std::uint8_t> (1), 1);
      }
    }
}

TEST (Las, ColorsThatWereWrittenAs8Bits)
{
  LasFile file = smallFile ();
  file.format = 2;
  file.colors = {{255, 0, 3}, {1, 2, 3}, {0, 0, 0}};
  const std::string bytes = lasBytes (file);
  const Cloud cloud = parsed (bytes);
  EXPECT_EQ (colorFields (cloud)[0]->value<std::uint8_t> (0), 255);
  EXPECT_EQ (colorFields (cloud)[2]->value<std::uint8_t> (1), 3);
  file.colors.assign (3, {0, 0, 0});
  const std::string black_bytes = lasBytes (file);
  const Cloud black = parsed (black_bytes);
  EXPECT_EQ (colorFields (black)[0], nullptr);
  EXPECT_THAT (black.warnings, ElementsAre (HasSubstr ("all colours of the input file are black")));
}

// The number of 32 bits is 0 where it does not hold all points, and in files of the new formats.
TEST (Las, CountsOf64Bits)
{
  LasFile file = smallFile ();
  file.minor = 4;
  std::string bytes = lasBytes (file);
  putNumber (bytes, 107, std::uint32_t{0});
  EXPECT_EQ (parsed (bytes).size (), 3U);
  putNumber (bytes, 107, std::uint32_t{3});
  putNumber (bytes, 247, std::uint64_t{0});
  EXPECT_EQ (parsed (bytes).size (), 3U);
  putNumber (bytes, 247, std::uint64_t{2});
  EXPECT_EQ (parsed (bytes).size (), 2U);
}

template <typename T>
std::string
withNumber (std::size_t at, T number)
{
  std::string bytes = lasBytes (smallFile ());
  putNumber (bytes, at, number);
  return bytes;
}

TEST (Las, WhatCannotBeRead)
{
  const std::string good = lasBytes (smallFile ());
  LasFile new_file = smallFile ();
  new_file.minor = 4;
  std::string many = lasBytes (new_file), short_header = many;
  putNumber (many, 247, std::numeric_limits<std::uint64_t>::max ());
  putNumber (short_header, 94, std::uint16_t{227});
  const double nan = std::numeric_limits<double>::quiet_NaN ();
  const std::vector<std::pair<std::string, std::string>> cases{
      {"lasf" + good.substr (4), "does not begin with 'LASF'"},
      {good.substr (0, 100), "its header is truncated"},
      {withNumber (24, std::uint8_t{2}), "version 2.2 of LAS"},
      {withNumber (25, std::uint8_t{5}), "version 1.5 of LAS"},
      {withNumber (94, std::uint16_t{226}), "its header has 226 bytes"},
      {short_header, "its header has 227 bytes, fewer than the 375"},
      {withNumber (96, std::uint32_t{100}), "the points begin at byte 100"},
      {withNumber (96, std::uint32_t{4000000000U}), "the points begin at byte 4000000000"},
      {withNumber (104, std::uint8_t{0x80}), "laszip -i a.laz -o a.las, or pdal translate"},
      {withNumber (104, std::uint8_t{0x41}), "compressed"},
      {withNumber (104, std::uint8_t{11}), "its points are of format 11; 0 to 10"},
      {withNumber (105, std::uint16_t{19}), "each point 19 bytes, fewer than the 20"},
      {withNumber (105, std::uint16_t{0}), "each point 0 bytes"},
      {withNumber (107, std::uint32_t{0}), "no points"},
      {withNumber (107, std::uint32_t{4}), "promises 4 points of 20 bytes each, but the file has "
                                           "only 3"},
      {withNumber (107, std::uint32_t{4294967295U}), "promises 4294967295 points"},
      {many, "promises 18446744073709551615 points"},
      {withNumber (131, 0.0), "the scale or the offset"},
      {withNumber (139, nan), "the scale or the offset"},
      {withNumber (171, -std::numeric_limits<double>::infinity ()), "the scale or the offset"},
      {good.substr (0, good.size () - 1), "truncated"}};
  for (const auto& [bytes, cause] : cases)
    EXPECT_THAT (lasError (bytes), HasSubstr (cause));
}

// A scale that takes a coordinate beyond all numbers makes a point that is left out.
TEST (Las, CoordinatesBeyondAllNumbers)
{
  LasFile file = smallFile ();
  file.scale = {1e300, 1.0, 1.0};
  const std::string bytes = lasBytes (file);
  Cloud cloud = parsed (bytes);
  Triangles none;
  EXPECT_EQ (removeNonFinitePoints (cloud, none), 1U);
}

TEST (Las, EveryPrefixIsRefused)
{
  for (const int minor : {2, 4}) {
    LasFile file = smallFile ();
    file.minor = minor;
    file.format = 3;
    const std::string bytes = lasBytes (file);
    for (std::size_t length = 0; length < bytes.size (); ++length) {
      // A copy, so that a sanitizer notices reads beyond the prefix.
      const std::vector<char> prefix (bytes.begin (),
                                      bytes.begin () + static_cast<std::ptrdiff_t> (length));
      EXPECT_THROW (parseLas (FileBytes (std::string_view (prefix.data (), length))), ReadError);
    }
  }
}

class LasTool : public CommandLineTest
{
protected:
  LasTool ()
  {
    file_.format = 7;
    file_.minor = 4;
    file_.scale = {0.001, 0.001, 0.001};
    file_.offset = {654321.0, 5123456.0, 0.0};
    for (const Eigen::Vector3d& p : sample_.points) {
      const Eigen::Vector3d steps = (1000.0 * p).array ().round ();
      file_.points.push_back ({static_cast<std::int32_t> (steps.x ()),
                               static_cast<std::int32_t> (steps.y ()),
                               static_cast<std::int32_t> (steps.z ())});
      const auto red = static_cast<std::uint16_t> (256 * (file_.points.size () % 200));
      file_.colors.push_back ({red, 512, 65535});
    }
    writeFile ("in.las", lasBytes (file_));
  }

  LasFile file_;
};

TEST_F (LasTool, MeshesOfMapCoordinates)
{
  ASSERT_EQ (run ({"in.las", "out.vtk", "--strict"}).code, 0);
  const MeshContent mesh = readVtk (path ("out.vtk"));
  EXPECT_TRUE (mesh.is_double);
  ASSERT_EQ (mesh.points.size (), file_.points.size ());
  for (std::size_t p = 0; p < mesh.points.size (); ++p)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ (mesh.points[p][axis],
                 file_.points[p][static_cast<std::size_t> (axis)] * 0.001 + file_.offset[axis]);
  EXPECT_EQ (mesh.colors[4], (std::array<std::uint8_t, 3>{5, 2, 255}));
  EXPECT_EQ (mesh.fields.at ("intensity")[2], 14.0);

  ASSERT_EQ (run ({"in.las", "out.ply", "--shift", "auto", "--precision", "single"}).code, 0);
  const MeshContent shifted = readPly (path ("out.ply"));
  EXPECT_EQ (shifted.triangles, mesh.triangles);
  EXPECT_LT (shifted.points[0].cwiseAbs ().maxCoeff (), 100.0);
}

TEST_F (LasTool, CompressedFilesAreRefusedWithAdvice)
{
  writeFile ("in.laz", lasBytes (file_));
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"in.laz", "out.ply"},
        std::vector<std::string>{"in.laz", "out.ply", "--normals"}})
    expectFailure (arguments, INPUT_FAILED,
                   "cannot read 'in.laz': it is compressed (LAZ), which cannot be read; decompress "
                   "it: laszip -i a.laz -o a.las");
}

} // namespace
} // namespace pcl::floater

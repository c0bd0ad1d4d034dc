// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points of STL files, binary and text.
#include "cloud_reader.h"
#include "command_line_test.h"
#include "las_file.h"
#include "mesh_files.h"

#include <gmock/gmock.h>

#include <cmath>

namespace pcl::floater {
namespace {
using testing::ElementsAre;
using testing::HasSubstr;

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

std::string
stlText (const Facets& facets)
{
  std::string text = "solid name\n";
  for (const auto& facet : facets) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const auto& corner : facet)
      text += "      vertex " + std::to_string (corner[0]) + " " + std::to_string (corner[1]) +
              " " + std::to_string (corner[2]) + "\r\n";
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid name\n";
}

std::vector<Eigen::Vector3d>
pointsOf (const std::string& bytes)
{
  return parseStl (FileBytes (std::string_view (bytes))).positions ();
}

std::string
stlError (const std::string& bytes)
{
  try {
    pointsOf (bytes);
  }
  catch (const ReadError& error) {
    return error.what ();
  }
  return "none";
}

const Facets SQUARE{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                    {{{1, 0, -0.0F}, {1, 1, 0.5F}, {0, 1, 0}}}};
const std::vector<Eigen::Vector3d> CORNERS{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.5}};

TEST (Stl, EqualCornersAreOnePoint)
{
  EXPECT_EQ (pointsOf (stlBytes (SQUARE)), CORNERS);
  EXPECT_EQ (pointsOf (stlBytes (SQUARE, "solid, but binary")), CORNERS);
  EXPECT_EQ (pointsOf (stlText (SQUARE)), CORNERS);
  const std::string bytes = stlBytes (SQUARE), text = stlText (SQUARE);
  const Cloud binary = parseStl (FileBytes (std::string_view (bytes)));
  EXPECT_TRUE (binary.single_precision);
  EXPECT_THAT (binary.warnings,
               ElementsAre (HasSubstr ("2 faces of the input file were left out")));
  const Cloud ascii = parseStl (FileBytes (std::string_view (text)));
  EXPECT_TRUE (ascii.are_decimals);
  EXPECT_THAT (ascii.warnings, ElementsAre (HasSubstr ("2 faces of the input file were left out")));
}

TEST (Stl, ManyPointsStayInTheirOrder)
{
  Facets facets;
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 5000; ++i) {
    const auto at = [i] (int k) {
      return std::array<float, 3>{static_cast<float> (i % 70 + k % 2),
                                  static_cast<float> (i / 70 + k / 2), 0.0F};
    };
    facets.push_back ({at (0), at (1), at (2)});
  }
  std::set<std::array<float, 3>> seen;
  for (const auto& facet : facets)
    for (const auto& corner : facet)
      if (seen.insert (corner).second)
        points.emplace_back (corner[0], corner[1], corner[2]);
  EXPECT_EQ (pointsOf (stlBytes (facets)), points);
}

TEST (Stl, CornersThatAreNotFinite)
{
  const float nan = std::nanf ("");
  const Facets facets{{{{nan, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {{{nan, 0, 0}, {1, 0, 0}, {2, 2, 0}}}};
  EXPECT_EQ (pointsOf (stlBytes (facets)).size (), 4U); // the tool leaves one of them out
}

TEST (Stl, WhatCannotBeRead)
{
  const std::string good = stlBytes (SQUARE), text = stlText (SQUARE);
  std::string lying = good, more = good + std::string (120, 'x');
  putNumber (lying, 80, std::uint32_t{4294967295U});
  EXPECT_THAT (stlError ("hello"), HasSubstr ("too short for a binary STL file"));
  EXPECT_THAT (stlError (std::string (200, 'x')), HasSubstr ("promises"));
  EXPECT_THAT (stlError (lying), HasSubstr ("promises 4294967295 facets, but the file has only 2"));
  EXPECT_THAT (stlError (stlBytes ({})), HasSubstr ("no points"));
  EXPECT_THAT (stlError ("solid a\nendsolid a\n"), HasSubstr ("no points"));
  EXPECT_THAT (stlError ("solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 high 2\n"),
               HasSubstr ("line 4: 'high' is not a number"));
  EXPECT_THAT (stlError ("solid a\nvertex 1 2 3\nendsolid\n"), HasSubstr ("after a whole facet"));
  EXPECT_THAT (parseStl (FileBytes (std::string_view (more))).warnings,
               ElementsAre (HasSubstr ("2 faces"), HasSubstr ("more data than the 2 facets")));
  for (std::size_t length = 0; length < good.size (); ++length)
    EXPECT_NE (stlError (good.substr (0, length)), "none") << length;
  const std::size_t end = text.rfind ("endsolid") + std::string ("endsolid").size ();
  for (std::size_t length = 0; length < end; ++length)
    EXPECT_NE (stlError (text.substr (0, length)), "none") << length;
}

TEST_F (CommandLineTest, PointsOfAMeshInStl)
{
  ASSERT_EQ (run ({"in.pcd", "mesh.stl"}).code, 0);
  const Outcome outcome = run ({"mesh.stl", "out.ply"});
  ASSERT_EQ (outcome.code, 0) << outcome.err;
  EXPECT_NE (outcome.err.find ("faces of the input file were left out: only its points are used"),
             std::string::npos);
  const MeshContent mesh = readPly (path ("out.ply"));
  EXPECT_FALSE (mesh.is_double);
  const auto less = [] (const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::lexicographical_compare (a.data (), a.data () + 3, b.data (), b.data () + 3);
  };
  std::vector<Eigen::Vector3d> expected = sample_.points, points = mesh.points;
  std::sort (expected.begin (), expected.end (), less);
  std::sort (points.begin (), points.end (), less);
  EXPECT_EQ (points, expected);
}

} // namespace
} // namespace pcl::floater

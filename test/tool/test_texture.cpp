// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// --uv and --texture: what is in the files, and what is refused.
#include "mesh_files.h"
#include "sample.h"
#include "tool_runner.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>

#include <cmath>
#include <sstream>

namespace pcl::floater {
namespace {
using testing::HasSubstr;
using testing::Not;

// A closed body, so that there are seams: points of an ellipsoid, coloured by place.
Sample
colouredBody ()
{
  Sample sample;
  const int count = 900;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / count, angle = 2.399963 * i;
    const double radius = std::sqrt (1.0 - z * z);
    sample.points.emplace_back (radius * std::cos (angle), radius * std::sin (angle), 1.3 * z);
    const Eigen::Vector3d colour =
        127.5 * (sample.points.back ().cwiseQuotient (Eigen::Vector3d (1.0, 1.0, 1.3)) +
                 Eigen::Vector3d::Ones ());
    sample.colors.push_back ({static_cast<std::uint8_t> (colour.x ()),
                              static_cast<std::uint8_t> (colour.y ()),
                              static_cast<std::uint8_t> (colour.z ())});
    sample.normals.push_back (sample.points.back ().normalized ().cast<float> ());
    sample.intensities.push_back (static_cast<float> (i));
  }
  return sample;
}

struct ObjTexture
{
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> coordinates;
  std::vector<std::array<std::size_t, 3>> triangles, corners; // from 0
  std::string materials, material;
};

ObjTexture
parseObj (const std::string& text)
{
  ObjTexture obj;
  std::istringstream lines (text);
  std::string line;
  while (std::getline (lines, line)) {
    std::istringstream words (line);
    std::string key;
    words >> key;
    if (key == "v") {
      Eigen::Vector3d p;
      words >> p.x () >> p.y () >> p.z ();
      obj.points.push_back (p);
    }
    else if (key == "vt") {
      Eigen::Vector2d uv;
      words >> uv.x () >> uv.y ();
      obj.coordinates.push_back (uv);
    }
    else if (key == "mtllib")
      words >> obj.materials;
    else if (key == "usemtl")
      words >> obj.material;
    else if (key == "f") {
      std::array<std::size_t, 3> triangle{}, corners{};
      for (std::size_t i = 0; i < 3; ++i) {
        char slash = ' ';
        words >> triangle[i] >> slash >> corners[i];
        EXPECT_EQ (slash, '/');
        if (words.peek () == '/') { // a normal follows, that of the point
          std::size_t normal = 0;
          words >> slash >> normal;
          EXPECT_EQ (normal, triangle[i]);
        }
        --triangle[i];
        --corners[i];
      }
      obj.triangles.push_back (triangle);
      obj.corners.push_back (corners);
    }
  }
  return obj;
}

double
signedArea (const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
{
  return (b - a).x () * (c - a).y () - (b - a).y () * (c - a).x ();
}

class TextureFiles : public ToolTest
{
protected:
  TextureFiles () { writeFile ("in.ply", plyText (sample_, PlyKind::LITTLE)); }

  Sample sample_ = colouredBody ();
};

TEST_F (TextureFiles, Obj)
{
  const Outcome outcome = run ({"--uv", "in.ply", "out.obj"});
  EXPECT_EQ (outcome.code, 0) << outcome.err;
  EXPECT_THAT (outcome.out, HasSubstr ("\ntexture    "));
  EXPECT_EQ (names (), (std::set<std::string>{"in.ply", "out.mtl", "out.obj"}));
  const ObjTexture obj = parseObj (readFile ("out.obj"));
  EXPECT_EQ (obj.points.size (), sample_.size ()); // none is doubled
  EXPECT_GT (obj.coordinates.size (), obj.points.size ());
  EXPECT_EQ (obj.materials, "out.mtl");
  EXPECT_EQ (obj.material, "surface");
  EXPECT_THAT (readFile ("out.mtl"), HasSubstr ("newmtl surface\n"));
  EXPECT_THAT (readFile ("out.mtl"), Not (HasSubstr ("map_Kd")));
  ASSERT_FALSE (obj.corners.empty ());
  for (const auto& c : obj.corners)
    EXPECT_GT (signedArea (obj.coordinates.at (c[0]), obj.coordinates.at (c[1]),
                           obj.coordinates.at (c[2])),
               0.0);
  // The points have the same coordinates and triangles as without.
  EXPECT_EQ (run ({"in.ply", "plain.obj"}).code, 0);
  const MeshContent plain = readObj (path ("plain.obj"));
  EXPECT_EQ (plain.triangles, obj.triangles);
}

TEST_F (TextureFiles, PlyAndVtkHaveVerticesOnSeamsDoubled)
{
  ASSERT_EQ (run ({"--uv", "--report", "report.json", "in.ply", "out.ply"}).code, 0);
  ASSERT_EQ (run ({"--uv", "in.ply", "out.obj"}).code, 0);
  ASSERT_EQ (run ({"--uv", "in.ply", "out.vtk"}).code, 0);
  const ObjTexture obj = parseObj (readFile ("out.obj"));
  const MeshContent ply = readPly (path ("out.ply"));
  EXPECT_EQ (ply.points.size (), obj.coordinates.size ());
  const auto report = nlohmann::json::parse (readFile ("report.json"));
  EXPECT_EQ (report["output"]["vertices"], ply.points.size ());
  EXPECT_GT (report["texture"]["charts"], 1);
  EXPECT_EQ (report["texture"]["flipped"], 0);
  EXPECT_TRUE (report["texture"]["file"].is_null ());
  EXPECT_LT (report["texture"]["stretch"], 1.1);

  vtkNew<vtkPolyDataReader> reader;
  reader->SetFileName (path ("out.vtk").c_str ());
  reader->Update ();
  vtkPolyData* vtk = reader->GetOutput ();
  ASSERT_NE (vtk->GetPointData ()->GetTCoords (), nullptr);
  EXPECT_EQ (vtk->GetPointData ()->GetTCoords ()->GetNumberOfComponents (), 2);
  EXPECT_EQ (vtk->GetNumberOfPoints (), static_cast<vtkIdType> (ply.points.size ()));
  const MeshContent by_vtk = readVtk (path ("out.vtk"));
  EXPECT_EQ (by_vtk.triangles, ply.triangles);
  EXPECT_EQ (by_vtk.colors, ply.colors);

  ASSERT_EQ (ply.triangles.size (), obj.triangles.size ());
  for (std::size_t t = 0; t < ply.triangles.size (); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t vertex = ply.triangles[t][i], point = obj.triangles[t][i];
      EXPECT_EQ (ply.points[vertex], ply.points[point]);
      EXPECT_EQ (ply.colors[vertex], ply.colors[point]);
      const Eigen::Vector2d uv (ply.fields.at ("s")[vertex], ply.fields.at ("t")[vertex]);
      EXPECT_LT ((uv - obj.coordinates[obj.corners[t][i]]).norm (), 1e-7);
      double tcoords[2];
      vtk->GetPointData ()->GetTCoords ()->GetTuple (static_cast<vtkIdType> (vertex), tcoords);
      EXPECT_EQ (tcoords[0], uv.x ());
      EXPECT_EQ (tcoords[1], uv.y ());
    }
}

// Points that are left out of the file, and points without triangle.
TEST_F (TextureFiles, PointsThatAreLeftOut)
{
  Sample sample = sample_;
  sample.points[3].x () = std::nan ("");
  sample.points[40].z () = std::nan ("");
  sample.points[100] = Eigen::Vector3d (50.0, 0.0, 0.0);
  writeFile ("holes.ply", plyText (sample, PlyKind::LITTLE));
  ASSERT_EQ (run ({"--uv", "holes.ply", "out.ply"}).code, 0);
  const MeshContent ply = readPly (path ("out.ply"));
  for (const auto& t : ply.triangles) {
    std::array<Eigen::Vector2d, 3> uv;
    for (std::size_t i = 0; i < 3; ++i) {
      uv[i] = {ply.fields.at ("s")[t[i]], ply.fields.at ("t")[t[i]]};
      EXPECT_GE (uv[i].minCoeff (), 0.0);
    }
    EXPECT_GT (signedArea (uv[0], uv[1], uv[2]), 0.0);
    EXPECT_LT ((ply.points[t[0]] - ply.points[t[1]]).norm (), 0.5);
  }
  EXPECT_EQ (ply.fields.at ("s")[98], -1.0); // the point far away, two places on
}

TEST_F (TextureFiles, DiscIsOneChart)
{
  writeFile ("sheet.ply", plyText (makeSample (false), PlyKind::LITTLE));
  ASSERT_EQ (
      run ({"--uv", "--topology", "disc", "--report", "r.json", "sheet.ply", "out.obj"}).code, 0);
  EXPECT_EQ (nlohmann::json::parse (readFile ("r.json"))["texture"]["charts"], 1);
}

TEST_F (TextureFiles, ColoursAreBaked)
{
  std::filesystem::create_directories (path ("images"));
  ASSERT_EQ (run ({"--texture", "images/colours.png", "in.ply", "out.obj"}).code, 0);
  EXPECT_THAT (readFile ("out.mtl"), HasSubstr ("map_Kd images/colours.png\n"));
  const ObjTexture obj = parseObj (readFile ("out.obj"));
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName (path ("images/colours.png").c_str ());
  reader->Update ();
  vtkImageData* image = reader->GetOutput ();
  const int side = image->GetDimensions ()[0];
  EXPECT_EQ (image->GetDimensions ()[1], side);
  EXPECT_GE (side, 256);
  // In the middle of each triangle, the mean of the colours of its corners. VTK counts rows from
  // below, as v does.
  for (std::size_t t = 0; t < obj.triangles.size (); ++t) {
    Eigen::Vector2d uv = Eigen::Vector2d::Zero ();
    Eigen::Vector3d expected = Eigen::Vector3d::Zero ();
    for (std::size_t i = 0; i < 3; ++i) {
      uv += obj.coordinates[obj.corners[t][i]] / 3.0;
      for (std::size_t channel = 0; channel < 3; ++channel)
        expected[static_cast<Eigen::Index> (channel)] +=
            sample_.colors[obj.triangles[t][i]][channel] / 3.0;
    }
    const int x = static_cast<int> (uv.x () * side), y = static_cast<int> (uv.y () * side);
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_NEAR (image->GetScalarComponentAsDouble (x, y, 0, channel), expected[channel], 8.0);
  }
  // Its size can be chosen; the same command gives the same bytes.
  const std::string first = readFile ("images/colours.png");
  ASSERT_EQ (run ({"-j1", "--texture", "images/colours.png", "in.ply", "out.obj"}).code, 0);
  EXPECT_EQ (readFile ("images/colours.png"), first);
  ASSERT_EQ (run ({"--texture", "small.png", "--texture-size", "100", "in.ply", "out.vtk"}).code,
             0);
  reader->SetFileName (path ("small.png").c_str ());
  reader->Update ();
  EXPECT_EQ (reader->GetOutput ()->GetDimensions ()[0], 100);
}

TEST_F (TextureFiles, AllOrNothing)
{
  // The image does not fit: no file is new, and none is changed.
  writeFile ("out.mtl", "old");
  expectFailure ({"--texture", "big.png", "--texture-size", "2048", "in.ply", "out.obj"}, 4,
                 "cannot write", 100000);
  EXPECT_EQ (readFile ("out.mtl"), "old");
  EXPECT_EQ (run ({"--texture", "new.png", "in.ply", "out.obj"}).code, 0);
  EXPECT_NE (readFile ("out.mtl"), "old");
}

TEST_F (TextureFiles, SpacesInNamesAreTold)
{
  const Outcome outcome = run ({"--texture", "my colours.png", "in.ply", "out.obj"});
  EXPECT_EQ (outcome.code, 0);
  EXPECT_THAT (outcome.err, HasSubstr ("has a space in it"));
}

TEST_F (TextureFiles, PointsWithoutColoursAreRefused)
{
  Sample plain = sample_;
  plain.colors.clear ();
  writeFile ("plain.pcd", pcdText (plain.points));
  expectFailure ({"--texture", "c.png", "plain.pcd", "out.obj"}, 1, "have no colours");
}

TEST_F (TextureFiles, WhatCannotBeIsRefused)
{
  expectFailure ({"--uv", "in.ply", "out.stl"}, 1, "without texture coordinates");
  expectFailure ({"--texture", "c.jpg", "in.ply", "out.obj"}, 1, "no PNG file");
  expectFailure ({"--texture-size", "512", "in.ply", "out.obj"}, 1, "without --texture");
  expectFailure ({"--texture", "c.png", "--texture-size", "7", "in.ply", "out.obj"}, 1,
                 "--texture-size");
  expectFailure ({"--uv", "--max-memory", "2G", "in.ply", "out.obj"}, 1, "--max-memory");
  expectFailure ({"--uv", "--report", "out.mtl", "in.ply", "out.obj"}, 1, "are the same file");
  expectFailure ({"--texture", "in.png", "--report", "in.png", "in.ply", "out.obj"}, 1,
                 "are the same file");
  expectFailure ({"--texture", "nowhere/c.png", "in.ply", "out.obj"}, 4, "nowhere");
}

} // namespace
} // namespace pcl::floater

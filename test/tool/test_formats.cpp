// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Every input format gives the same mesh, and every output format holds it to the last bit, with
// normals and texture coordinates if these are asked for.
#include "tool_runner.h"

#include <Eigen/Geometry>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iomanip>
#include <random>
#include <sstream>

namespace pcl::floater {
namespace {
std::vector<double>
asDoubles (const std::vector<float>& values)
{
  return {values.begin (), values.end ()};
}

void
expectSameFloats (const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b)
{
  ASSERT_EQ (a.size (), b.size ());
  for (std::size_t i = 0; i < a.size (); ++i)
    EXPECT_EQ (a[i].cast<float> (), b[i].cast<float> ());
}

/// Checks that all points are used, no others, and that there are about two triangles per point.
void
expectDisc (const MeshContent& mesh, std::size_t size)
{
  EXPECT_GT (mesh.triangles.size (), size);
  EXPECT_LT (mesh.triangles.size (), 2 * size);
  std::set<std::size_t> used;
  for (const auto& triangle : mesh.triangles)
    used.insert (triangle.begin (), triangle.end ());
  EXPECT_EQ (used.size (), size);
  EXPECT_EQ (*used.rbegin (), size - 1);
}

using Formats = ToolTest;

/// Text with all fields in each line.
std::string
tableText (const Sample& sample)
{
  std::ostringstream text;
  text << std::setprecision (17) << "x,y,z,red,green,blue,nx,ny,nz,intensity\n";
  for (std::size_t i = 0; i < sample.size (); ++i) {
    for (const double coordinate : sample.points[i])
      text << coordinate << ',';
    for (const int channel : sample.colors[i])
      text << channel << ',';
    for (const float coordinate : sample.normals[i])
      text << coordinate << ',';
    text << sample.intensities[i] << '\n';
  }
  return text.str ();
}

TEST_F (Formats, PointsAndFieldsOfEveryInputComeBack)
{
  for (const bool is_double : {false, true}) {
    const Sample sample = makeSample (is_double);
    std::vector<std::pair<std::string, std::string>> inputs; // file and bytes
    for (const PcdKind kind : readPcdKinds ()) {
      writePcd (path ("in.pcd"), sample, kind);
      inputs.emplace_back ("in.pcd", readFile ("in.pcd"));
    }
    for (const PlyKind kind : {PlyKind::ASCII, PlyKind::LITTLE, PlyKind::BIG})
      inputs.emplace_back ("in.ply", plyText (sample, kind));
    inputs.emplace_back ("in.obj", objText (sample));
    for (const std::string name : {"in.xyz", "in.txt", "in.csv", "in.asc", "IN.XYZ"})
      inputs.emplace_back (name, tableText (sample));
    inputs.emplace_back ("in.pts", std::to_string (sample.size ()) + "\n" + tableText (sample));
    std::vector<std::array<std::size_t, 3>> triangles; // of the first
    for (const auto& [file, bytes] : inputs) {
      SCOPED_TRACE (bytes.substr (0, 60) + " in " + file);
      writeFile (file, bytes);
      const std::string warnings =
          succeed ({file, "out.ply", "--precision", is_double ? "double" : "auto"}).err;
      const MeshContent mesh = readMesh (path ("out.ply"));
      EXPECT_EQ (mesh.is_double, is_double);
      EXPECT_EQ (mesh.points, sample.points);
      EXPECT_EQ (mesh.colors, sample.colors);
      EXPECT_EQ (mesh.normals, sample.normals);
      if (file == "in.obj")
        EXPECT_THAT (mesh.fields, IsEmpty ());
      else
        EXPECT_EQ (mesh.fields.at ("intensity"), asDoubles (sample.intensities));
      expectDisc (mesh, sample.size ());
      triangles = triangles.empty () ? mesh.triangles : triangles;
      EXPECT_EQ (mesh.triangles, triangles);
      const bool has_list = file == "in.ply", has_face = has_list || file == "in.obj";
      const auto isTold = [&warnings] (const std::string& what) {
        return warnings.find (what) != std::string::npos;
      };
      EXPECT_EQ (isTold ("the list 'marks'"), has_list);
      EXPECT_EQ (isTold ("1 face of the input file was left out"), has_face);
      EXPECT_EQ (std::count (warnings.begin (), warnings.end (), '\n'),
                 (has_list ? 1 : 0) + (has_face ? 1 : 0));
    }
  }
}

TEST_F (Formats, MapCoordinatesOfLas)
{
  LasFile file;
  file.format = 7;
  file.minor = 4;
  file.scale = {0.001, 0.001, 0.001};
  file.offset = {654321.0, 5123456.0, 0.0};
  for (const Eigen::Vector3d& p : makeSample (false).points) {
    const Eigen::Vector3d steps = (1000.0 * p).array ().round ();
    file.points.push_back ({static_cast<std::int32_t> (steps.x ()),
                            static_cast<std::int32_t> (steps.y ()),
                            static_cast<std::int32_t> (steps.z ())});
    const auto red = static_cast<std::uint16_t> (256 * (file.points.size () % 200));
    file.colors.push_back ({red, 512, 65535});
  }
  writeFile ("in.las", lasBytes (file));
  succeed ({"in.las", "out.vtk", "--strict", "--precision", "double"});
  const MeshContent mesh = readMesh (path ("out.vtk"));
  EXPECT_TRUE (mesh.is_double);
  ASSERT_EQ (mesh.points.size (), file.points.size ());
  for (std::size_t p = 0; p < mesh.points.size (); ++p)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ (mesh.points[p][axis],
                 file.points[p][static_cast<std::size_t> (axis)] * 0.001 + file.offset[axis]);
  EXPECT_EQ (mesh.colors[4], (Color{5, 2, 255}));
  EXPECT_EQ (mesh.fields.at ("intensity")[2], 14.0);
  EXPECT_THAT (succeed ({"in.las", "out.ply", "--strict"}).out, HasSubstr ("shift      654330 "));
  EXPECT_FALSE (readMesh (path ("out.ply")).is_double);
  EXPECT_EQ (readMesh (path ("out.ply")).triangles, mesh.triangles);
}

class OutputFormats : public ToolTestWith<bool>
{
protected:
  OutputFormats () : sample_ (makeSample (GetParam ()))
  {
    writePcd (path ("in.pcd"), sample_, PcdKind::BINARY);
  }

  MeshContent reconstructTo (const std::string& name) const
  {
    succeed ({"in.pcd", name, "--precision", GetParam () ? "double" : "auto"});
    return readMesh (path (name));
  }

  Sample sample_;
};

TEST_P (OutputFormats, HoldTheCloudAndTheSameTriangles)
{
  const MeshContent vtk = reconstructTo ("out.vtk");
  expectDisc (vtk, sample_.size ());
  const std::map<std::string, std::string> begins{{"out.vtk", "# vtk"},
                                                  {"out.ply", "ply\n"},
                                                  {"out.obj", "# "},
                                                  {"out.off", "CNOFF\n# written by"},
                                                  {"out.glb", "glTF"}};
  for (const auto& [file, begin] : begins) {
    SCOPED_TRACE (file);
    if (file == "out.glb" && sample_.is_double)
      continue; // see FormatsOfFloatsAreRefused
    const MeshContent mesh = reconstructTo (file);
    EXPECT_THAT (readFile (file), StartsWith (begin));
    EXPECT_EQ (mesh.triangles, vtk.triangles);
    EXPECT_EQ (mesh.colors, sample_.colors);
    EXPECT_EQ (mesh.normals, sample_.normals);
    expectSameFloats (mesh.points, sample_.points);
    if (sample_.is_double) {
      EXPECT_EQ (mesh.points, sample_.points);
    }
    if (file == "out.vtk" || file == "out.ply") {
      EXPECT_EQ (mesh.is_double, sample_.is_double);
      EXPECT_EQ (mesh.fields,
                 (decltype (mesh.fields){{"intensity", asDoubles (sample_.intensities)}}));
    }
  }
}

TEST_P (OutputFormats, PclReadsPlyAndVtk)
{
  if (sample_.is_double)
    return; // PCL's reader of PLY takes doubles for 0 in points of floats
  for (const std::string file : {"out.ply", "out.vtk"}) {
    SCOPED_TRACE (file);
    const MeshContent mesh = reconstructTo (file), pcl_mesh = loadWithPcl (path (file));
    EXPECT_EQ (pcl_mesh.triangles, mesh.triangles);
    EXPECT_EQ (pcl_mesh.colors, sample_.colors);
    expectSameFloats (pcl_mesh.points, sample_.points);
    if (file == "out.ply") {
      EXPECT_EQ (pcl_mesh.normals, sample_.normals);
    }
  }
}

// The points of the sample in doubles are nearer to each other than 32-bit floats so far out.
TEST_P (OutputFormats, FormatsOfFloatsAreRefused)
{
  const MeshContent vtk = reconstructTo ("out.vtk");
  for (const auto& [file, name] :
       {std::pair<std::string, std::string>{"out.glb", "glTF"}, {"out.stl", "STL"}}) {
    SCOPED_TRACE (file);
    if (!sample_.is_double) {
      EXPECT_EQ (run ({"in.pcd", file}).err, "");
      continue;
    }
    expectFailure ({"in.pcd", file, "--precision", "double"}, OUTPUT_FAILED,
                   name + " holds 32-bit floats");
    EXPECT_EQ (succeed ({"in.pcd", file, "--shift", "600000,5000000,100"}).err, "");
    EXPECT_EQ (readMesh (path (file)).triangles.size (), vtk.triangles.size ());
    EXPECT_EQ (readFile (file).find ("\"shift\":\"600000 5000000 100\"") == std::string::npos,
               file == "out.stl");
    std::filesystem::remove (path (file));
  }
  if (sample_.is_double)
    return;
  const MeshContent stl = readMesh (path ("out.stl"));
  ASSERT_EQ (stl.triangles.size (), vtk.triangles.size ());
  for (std::size_t t = 0; t < vtk.triangles.size (); ++t)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ (stl.points.at (stl.triangles[t][c]).cast<float> (),
                 sample_.points[vtk.triangles[t][c]].cast<float> ());
  const std::string bytes = readFile ("out.glb");
  const auto numberAt = [&bytes] (std::size_t at) {
    std::uint32_t number = 0;
    std::memcpy (&number, bytes.data () + at, sizeof number);
    return number;
  };
  EXPECT_EQ (numberAt (8), bytes.size ());
  EXPECT_EQ (numberAt (12) % 4, 0U);
  EXPECT_EQ (20 + numberAt (12) + 8 + numberAt (20 + numberAt (12)), bytes.size ());
}

TEST_P (OutputFormats, ParameterizationIsTheMeshInThePlane)
{
  for (const std::string extension : {"vtk", "ply", "obj", "stl", "off"}) {
    const std::string flat_name = "flat." + extension;
    succeed ({"in.pcd", "out.vtk", "--quiet", "--parameterization", flat_name});
    const MeshContent flat = readMesh (path (flat_name)), mesh = readMesh (path ("out.vtk"));
    EXPECT_EQ (flat.triangles.size (), mesh.triangles.size ());
    for (const Eigen::Vector3d& p : flat.points) {
      EXPECT_EQ (p.z (), 0.0);
      EXPECT_LE (p.head<2> ().norm (), 1.0 + 1e-6);
    }
    if (extension != "stl") {
      EXPECT_EQ (flat.triangles, mesh.triangles);
      EXPECT_EQ (flat.colors, sample_.colors);
      EXPECT_TRUE (flat.normals.empty ());
    }
  }
}

// As vertexNormals () has them, by the simplest means.
std::vector<Eigen::Vector3d>
normalsOf (const MeshContent& mesh)
{
  std::vector<Eigen::Vector3d> normals (mesh.points.size (), Eigen::Vector3d::Zero ());
  for (const auto& triangle : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d& corner = mesh.points[triangle[i]];
      const Eigen::Vector3d u = (mesh.points[triangle[(i + 1) % 3]] - corner).normalized ();
      const Eigen::Vector3d v = (mesh.points[triangle[(i + 2) % 3]] - corner).normalized ();
      normals[triangle[i]] += std::acos (u.dot (v)) * u.cross (v).normalized ();
    }
  for (Eigen::Vector3d& normal : normals)
    normal.normalize (); // leaves zero as it is
  return normals;
}

TEST_P (OutputFormats, NormalsOfTheMeshAreInEveryFormatThatHasThem)
{
  sample_.points[5].x () = std::nan ("");           // is left out
  sample_.points[9] += Eigen::Vector3d (0, 0, 1e4); // is in no triangle
  sample_.normals.assign (sample_.size (), Eigen::Vector3f (0.0F, 1.0F, 0.0F));
  writePcd (path ("in.pcd"), sample_, PcdKind::BINARY);
  const MeshContent plain = reconstructTo ("plain.ply");
  EXPECT_THAT (plain.normals, testing::Each (sample_.normals[0])); // of the input
  const std::vector<Eigen::Vector3d> expected = normalsOf (plain);
  for (const std::string file : {"out.ply", "out.vtk", "out.obj", "out.off"}) {
    SCOPED_TRACE (file);
    succeed ({"in.pcd", file, "--normals", "--report", "r.json"});
    const MeshContent mesh = readMesh (path (file));
    EXPECT_EQ (mesh.triangles, plain.triangles);
    EXPECT_EQ (mesh.colors, plain.colors);
    if (file == "out.ply" || file == "out.vtk") {
      EXPECT_EQ (mesh.fields, plain.fields);
    }
    ASSERT_EQ (mesh.normals.size (), sample_.size () - 1);
    for (std::size_t p = 0; p < mesh.normals.size (); ++p)
      EXPECT_LT ((mesh.normals[p].cast<double> () - expected[p]).norm (), 1e-6);
    EXPECT_EQ (mesh.normals[8], Eigen::Vector3f (0.0F, 0.0F, 0.0F));
    EXPECT_TRUE (Json::parse (readFile ("r.json")).at ("output").at ("normals"));
  }
}

// The flat mesh has none: they are those of the surface in space.
TEST_F (CommandLineTest, NormalsOfPointsThatHadNone)
{
  succeed ({"in.pcd", "out.ply", "--normals", "--parameterization", "flat.ply"});
  EXPECT_EQ (readMesh (path ("out.ply")).normals.size (), sample_.size ());
  EXPECT_TRUE (readMesh (path ("flat.ply")).normals.empty ());
  EXPECT_THAT (succeed ({"in.pcd", "out.stl", "--normals"}).err,
               HasSubstr ("no effect: --normals; STL has normals of triangles only"));
}

INSTANTIATE_TEST_SUITE_P (All, OutputFormats, testing::Bool (), [] (const auto& instance) {
  return instance.param ? "Double" : "Float";
});

// Points in no triangle and equal points are vertices, too; normals are unit vectors.
TEST_F (Formats, GlbHoldsEveryPoint)
{
  Sample sample = makeSample (false);
  sample.points.push_back (sample.points[3]);
  sample.points.emplace_back (0, 0, 1e5);
  sample.colors.resize (sample.points.size ());
  sample.normals.resize (sample.points.size (), Eigen::Vector3f (0, 0, 2));
  sample.intensities.resize (sample.points.size ());
  sample.normals[0] = Eigen::Vector3f (0, 3, -4);
  sample.normals[1] = Eigen::Vector3f (0, 0, 0);
  sample.normals[2].x () = std::nanf ("");
  writePcd (path ("in.pcd"), sample, PcdKind::BINARY);
  succeed ({"in.pcd", "out.glb"});
  const MeshContent mesh = readMesh (path ("out.glb"));
  EXPECT_EQ (mesh.points, sample.points);
  EXPECT_LT ((mesh.normals.at (0) - Eigen::Vector3f (0.0F, 0.6F, -0.8F)).norm (), 1e-6F);
  for (const std::size_t p : {std::size_t{1}, std::size_t{2}, sample.points.size () - 1})
    EXPECT_EQ (mesh.normals.at (p), Eigen::Vector3f (0, 0, 1));
}

// Floats, of which the error is far below the spacing: most programs with PCL read these only.
TEST_F (Formats, DoublesAreWrittenOnDemand)
{
  Sample sample = makeSample (false);
  sample.is_double = true;
  for (Eigen::Vector3d& p : sample.points)
    p *= 1.0 + 1e-9; // no float
  writePcd (path ("in.pcd"), sample, PcdKind::BINARY);
  writeFile ("in.obj", objText (sample));
  for (const std::string input : {"in.pcd", "in.obj"}) {
    EXPECT_THAT (succeed ({input, "out.ply"}).err, Not (HasSubstr ("double")));
    expectSameFloats (loadWithPcl (path ("out.ply")).points, sample.points);
  }
  succeed ({"in.pcd", "wide.ply", "--precision", "double", "--strict"});
  EXPECT_TRUE (readMesh (path ("wide.ply")).is_double);
  EXPECT_EQ (readMesh (path ("wide.ply")).points, sample.points);
  const Sample map = makeSample (true);
  writePcd (path ("map.pcd"), map, PcdKind::BINARY);
  succeed ({"map.pcd", "map.ply", "--precision", "single"});
  const MeshContent rounded = readMesh (path ("map.ply"));
  EXPECT_FALSE (rounded.is_double);
  expectSameFloats (rounded.points, map.points);
}

// A small part of a large cloud, of which floats would merge points.
TEST_F (Formats, DoublesAreWrittenWhereFloatsMergePoints)
{
  Sample sample = makeSample (false);
  sample.is_double = true;
  Sample all = sample;
  for (const double size : {1.0, 1e-9}) {
    all.points.clear ();
    for (const Eigen::Vector3d& p : sample.points)
      all.points.emplace_back (100.0 * p);
    for (const Eigen::Vector3d& p : sample.points)
      all.points.emplace_back (Eigen::Vector3d (500, 400, 300) + size * p);
    all.colors.resize (all.size ());
    all.normals.resize (all.size ());
    all.intensities.resize (all.size ());
    writePcd (path ("in.pcd"), all, PcdKind::BINARY);
    EXPECT_EQ (succeed ({"in.pcd", "out.ply"}).err.find ("written as doubles") == std::string::npos,
               size == 1.0);
    EXPECT_EQ (readMesh (path ("out.ply")).is_double, size != 1.0);
  }
  // Also of points that no triangle has.
  writeFile ("in.obj", objText (makeSample (false)) + "v 1e300 0 0 0 0 0\n");
  succeed ({"in.obj", "out.ply"});
  EXPECT_TRUE (readMesh (path ("out.ply")).is_double);
}

// A room that two scanners see from inside: without them, a closed body would face outwards.
TEST_F (Formats, ScansOfPtxAreFacedFromTheirSensors)
{
  const Eigen::Vector3d low (-3, -2, 0), high (3, 2, 2.6);
  std::ostringstream text;
  for (const Eigen::Vector3d& sensor :
       {Eigen::Vector3d (-1, 0, 1.2), Eigen::Vector3d (1.5, -1, 1.5)}) {
    constexpr int COLUMNS = 60, ROWS = 30;
    text << COLUMNS << '\n'
         << ROWS << "\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
         << sensor.transpose () << " 1\n";
    for (int i = 0; i < COLUMNS * ROWS; ++i) {
      const double turn = 0.01 + 6.2831853 * (i / ROWS) / COLUMNS,
                   up = -1.19 + 2.4 * (i % ROWS) / ROWS;
      const Eigen::Vector3d ray (std::cos (turn) * std::cos (up), std::sin (turn) * std::cos (up),
                                 std::sin (up));
      const Eigen::Vector3d ranges =
          (ray.array () > 0.0).select ((high - sensor).array (), (low - sensor).array ()) /
          ray.array ();
      text << (i % 50 == 7 ? 0.0 : ranges.minCoeff ()) * ray.transpose () << " 1\n";
    }
  }
  writeFile ("room.ptx", text.str ());
  EXPECT_THAT (succeed ({"room.ptx", "out.ply"}).out,
               HasSubstr ("72 points without a return were left out"));
  const MeshContent mesh = readMesh (path ("out.ply"));
  EXPECT_EQ (mesh.points.size (), 3600U - 72U);
  double area = 0.0, inwards = 0.0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.points[t[0]];
    const Eigen::Vector3d across = (mesh.points[t[1]] - a).cross (mesh.points[t[2]] - a);
    area += across.norm ();
    inwards += across.dot (0.5 * (low + high) - a) > 0.0 ? across.norm () : 0.0;
  }
  EXPECT_GT (inwards, 0.99 * area);
}

TEST_F (Formats, NormalsThatAreAllZeroAreTold)
{
  Sample sample = makeSample (false);
  sample.normals.assign (sample.size (), Eigen::Vector3f (0.0F, 0.0F, 0.0F));
  writePcd (path ("in.pcd"), sample, PcdKind::BINARY);
  const std::string told = "all normals of the input file are zero";
  EXPECT_THAT (succeed ({"in.pcd", "out.ply", "--use-input-normals", "on"}).err, HasSubstr (told));
  EXPECT_THAT (succeed ({"in.pcd", "out.ply"}).err, Not (HasSubstr (told)));
}

TEST_F (Formats, OffNamesWhatItHolds)
{
  writeFile ("plain.pcd", pcdText (makeSample (false).points));
  succeed ({"plain.pcd", "plain.off"});
  EXPECT_EQ (readFile ("plain.off").rfind ("OFF\n", 0), 0U);
  succeed ({"plain.pcd", "plain.off", "--normals", "--shift", "1,2,3"});
  EXPECT_EQ (readFile ("plain.off")
                 .rfind ("NOFF\n# written by pcl_floater_reconstruct\n# shift 1 2 3\n", 0),
             0U);
}

TEST_F (Formats, FieldsOfEveryTypeAreKept)
{
  const Sample sample = makeSample (false);
  std::string text =
      "VERSION 0.7\r\nFIELDS a b x y z c d e f _ g h rgba\r\nSIZE 1 1 4 4 4 2 2 4 4 4 8 8 4\r\n"
      "TYPE I U F F F I U I U F I F U\r\nCOUNT 1 1 1 1 1 1 1 1 1 2 1 3 1\r\nWIDTH ";
  text += std::to_string (sample.size ()) + "\r\nHEIGHT 1\r\nDATA ascii\r\n";
  for (std::size_t i = 0; i < sample.size (); ++i) {
    text += "-128 255 ";
    for (const double coordinate : sample.points[i])
      text += testing::PrintToString (static_cast<float> (coordinate)) + " ";
    text += "-32768 65535 -2147483648 4294967295 nan nan 1234567890123 0.1 nan -1e400 " +
            std::to_string (0x07C86400U + i) + "\r\n";
  }
  writeFile ("in.pcd", text);
  const std::map<std::string, double> expected{
      {"a", -128},          {"b", 255},          {"c", -32768},          {"d", 65535},
      {"e", -2147483648.0}, {"f", 4294967295.0}, {"g", 1234567890123.0}, {"alpha", 7}};
  succeed ({"in.pcd", "out.vtk"});
  const MeshContent vtk = readMesh (path ("out.vtk"));
  for (const auto& [name, value] : expected)
    EXPECT_THAT (vtk.fields.at (name),
                 testing::AllOf (testing::SizeIs (sample.size ()), testing::Each (value)))
        << name;
  EXPECT_EQ (vtk.fields.at ("h").size (), 3 * sample.size ());
  EXPECT_EQ (vtk.fields.at ("h")[0], 0.1);
  EXPECT_TRUE (std::isnan (vtk.fields.at ("h")[1]));
  EXPECT_EQ (vtk.fields.at ("h")[2], -std::numeric_limits<double>::infinity ());
  EXPECT_EQ (vtk.colors.at (5), (Color{200, 100, 5}));

  EXPECT_THAT (succeed ({"in.pcd", "out.ply"}).err,
               HasSubstr ("the field 'g' was written as double"));
  const MeshContent ply = readMesh (path ("out.ply"));
  EXPECT_EQ (ply.fields.at ("g").at (7), 1234567890123.0);
  EXPECT_EQ (ply.fields.at ("h_0").at (7), 0.1);
  EXPECT_EQ (ply.fields.at ("d").at (7), 65535);
}

// A closed body, so that there are seams: points of an ellipsoid, coloured by place.
Sample
colouredBody ()
{
  Sample sample;
  const int count = 900;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / count, angle = 2.399963 * i;
    const double radius = std::sqrt (1.0 - z * z);
    const std::array<double, 3> unit{radius * std::cos (angle), radius * std::sin (angle), z};
    sample.points.emplace_back (unit[0], unit[1], 1.3 * z);
    sample.colors.emplace_back ();
    for (std::size_t c = 0; c < 3; ++c)
      sample.colors.back ()[c] = static_cast<std::uint8_t> (127.5 * (unit[c] + 1.0));
    sample.normals.push_back (sample.points.back ().normalized ().cast<float> ());
    sample.intensities.push_back (static_cast<float> (i));
  }
  return sample;
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

TEST_F (TextureFiles, ObjHasCoordinatesOfCorners)
{
  EXPECT_THAT (succeed ({"--uv", "in.ply", "out.obj"}).out, HasSubstr ("\ntexture    "));
  EXPECT_EQ (names (), (std::set<std::string>{"in.ply", "out.mtl", "out.obj"}));
  const MeshContent obj = readMesh (path ("out.obj"));
  EXPECT_EQ (obj.points.size (), sample_.size ()); // none is doubled
  EXPECT_GT (obj.coordinates.size (), obj.points.size ());
  EXPECT_EQ (obj.material_file, "out.mtl");
  EXPECT_EQ (obj.material, "surface");
  EXPECT_THAT (readFile ("out.mtl"), HasSubstr ("newmtl surface\n"));
  EXPECT_THAT (readFile ("out.mtl"), Not (HasSubstr ("map_Kd")));
  ASSERT_FALSE (obj.corners.empty ());
  for (const auto& c : obj.corners)
    EXPECT_GT (signedArea (obj.coordinates.at (c[0]), obj.coordinates.at (c[1]),
                           obj.coordinates.at (c[2])),
               0.0);
  succeed ({"in.ply", "plain.obj"});
  EXPECT_EQ (readMesh (path ("plain.obj")).triangles, obj.triangles);
}

TEST_F (TextureFiles, PlyAndVtkHaveVerticesOnSeamsDoubled)
{
  succeed ({"--uv", "in.ply", "out.obj"});
  succeed ({"--uv", "in.ply", "out.vtk"});
  const Json texture = report ({"--uv"}, "in.ply");
  const MeshContent obj = readMesh (path ("out.obj")), ply = readMesh (path ("out.ply")),
                    vtk = readMesh (path ("out.vtk"));
  EXPECT_EQ (ply.points.size (), obj.coordinates.size ());
  EXPECT_EQ (texture["output"]["vertices"], ply.points.size ());
  EXPECT_GT (texture["texture"]["charts"], 1);
  EXPECT_EQ (texture["texture"]["flipped"], 0);
  EXPECT_TRUE (texture["texture"]["file"].is_null ());
  EXPECT_LT (texture["texture"]["stretch"], 1.1);
  EXPECT_EQ (vtk.triangles, ply.triangles);
  EXPECT_EQ (vtk.colors, ply.colors);
  ASSERT_EQ (vtk.coordinates.size (), ply.points.size ());
  ASSERT_EQ (ply.triangles.size (), obj.triangles.size ());
  for (std::size_t t = 0; t < ply.triangles.size (); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t vertex = ply.triangles[t][i], point = obj.triangles[t][i];
      EXPECT_EQ (ply.points[vertex], ply.points[point]);
      EXPECT_EQ (ply.colors[vertex], ply.colors[point]);
      const Eigen::Vector2d uv (ply.fields.at ("s")[vertex], ply.fields.at ("t")[vertex]);
      EXPECT_LT ((uv - obj.coordinates[obj.corners[t][i]]).norm (), 1e-7);
      EXPECT_EQ (vtk.coordinates[vertex], uv);
    }
  // A disc is one chart.
  writeFile ("sheet.ply", plyText (makeSample (false), PlyKind::LITTLE));
  EXPECT_EQ (report ({"--uv", "--topology", "disc"}, "sheet.ply")["texture"]["charts"], 1);
}

// Points that are left out of the file, and points without triangle.
TEST_F (TextureFiles, PointsThatAreLeftOut)
{
  Sample sample = sample_;
  sample.points[3].x () = std::nan ("");
  sample.points[40].z () = std::nan ("");
  sample.points[100] = Eigen::Vector3d (50.0, 0.0, 0.0);
  writeFile ("holes.ply", plyText (sample, PlyKind::LITTLE));
  succeed ({"--uv", "holes.ply", "out.ply"});
  const MeshContent ply = readMesh (path ("out.ply"));
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

TEST_F (TextureFiles, ColoursAreBaked)
{
  std::filesystem::create_directories (path ("images"));
  succeed ({"--texture", "images/colours.png", "in.ply", "out.obj"});
  EXPECT_THAT (readFile ("out.mtl"), HasSubstr ("map_Kd images/colours.png\n"));
  const MeshContent obj = readMesh (path ("out.obj"));
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
  succeed ({"-j1", "--texture", "images/colours.png", "in.ply", "out.obj"});
  EXPECT_EQ (readFile ("images/colours.png"), first);
  succeed ({"--texture", "small.png", "--texture-size", "100", "in.ply", "out.vtk"});
  reader->SetFileName (path ("small.png").c_str ());
  reader->Update ();
  EXPECT_EQ (reader->GetOutput ()->GetDimensions ()[0], 100);
}

TEST_F (TextureFiles, AllOrNothing)
{
  // The image does not fit: no file is new, and none is changed.
  writeFile ("out.mtl", "old");
  expectFailure ({"--texture", "big.png", "--texture-size", "2048", "in.ply", "out.obj"},
                 OUTPUT_FAILED, "cannot write", {100000});
  EXPECT_EQ (readFile ("out.mtl"), "old");
  succeed ({"--texture", "new.png", "in.ply", "out.obj"});
  EXPECT_NE (readFile ("out.mtl"), "old");
}

TEST_F (TextureFiles, WhatIsToldAndRefused)
{
  EXPECT_THAT (succeed ({"--texture", "my colours.png", "in.ply", "out.obj"}).err,
               HasSubstr ("has a space in it"));
  expectFailure ({"--uv", "in.ply", "out.stl"}, USAGE, "without texture coordinates");
  expectFailure ({"--texture", "a\nmap_Kd b.png", "in.ply", "out.obj"}, USAGE, "line break");
}

// Sizes whose squares are no numbers, and that no texture can hold together: no triangle is upside
// down, and the stretch is a number.
TEST_F (CommandLineTest, TextureOfAnySize)
{
  writeFile ("large.xyz", "0 0 0\n1e154 0 0\n0 1e154 0\n1e154 1e154 1e153\n");
  std::mt19937 random (21);
  std::uniform_real_distribution<double> exponent (-16, 21);
  std::ostringstream text;
  text << std::setprecision (9);
  for (int i = 0; i < 300; ++i) {
    const double z = 1.0 - 1.5 * i / 300.0, r = std::sqrt (1.0 - z * z), angle = 2.399963 * i;
    const double size = std::pow (10.0, exponent (random));
    text << size * r * std::cos (angle) << ' ' << size * r * std::sin (angle) << ' ' << size * z
         << '\n';
  }
  writeFile ("mixed.xyz", text.str ());
  for (const std::string name : {"large", "mixed"}) {
    succeed ({"--uv", "--report", name + ".json", name + ".xyz", name + ".obj"});
    const Json texture = Json::parse (readFile (name + ".json")).at ("texture");
    EXPECT_EQ (texture.at ("flipped"), 0) << name;
    EXPECT_TRUE (texture.at ("stretch").is_number ()) << name; // infinite: null
  }
}

} // namespace
} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Every input format gives the same mesh, and every output format holds it to the last bit.
#include "mesh_files.h"
#include "sample.h"
#include "tool_runner.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iomanip>
#include <sstream>

namespace pcl::floater {
namespace {
struct InputCase
{
  std::string name;
  bool is_double;
  std::string file; ///< tells the format
  int kind;         ///< PcdKind or PlyKind
};

std::ostream&
operator<< (std::ostream& stream, const InputCase& value)
{
  return stream << value.name;
}

std::vector<InputCase>
inputCases ()
{
  std::vector<InputCase> cases;
  for (const bool is_double : {false, true}) {
    const std::string suffix = is_double ? "Double" : "Float";
    cases.push_back ({"PcdAscii" + suffix, is_double, "in.pcd", static_cast<int> (PcdKind::ASCII)});
    cases.push_back (
        {"PcdBinary" + suffix, is_double, "in.pcd", static_cast<int> (PcdKind::BINARY)});
    if (READS_COMPRESSED)
      cases.push_back (
          {"PcdCompressed" + suffix, is_double, "in.pcd", static_cast<int> (PcdKind::COMPRESSED)});
    cases.push_back ({"PlyAscii" + suffix, is_double, "in.ply", static_cast<int> (PlyKind::ASCII)});
    cases.push_back (
        {"PlyLittle" + suffix, is_double, "in.ply", static_cast<int> (PlyKind::LITTLE)});
    cases.push_back ({"PlyBig" + suffix, is_double, "in.ply", static_cast<int> (PlyKind::BIG)});
  }
  cases.push_back ({"Obj", true, "in.obj", 0});
  return cases;
}

std::vector<double>
asDoubles (const std::vector<float>& values)
{
  return {values.begin (), values.end ()};
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

class InputFormats : public ToolTestWith<InputCase>
{
};

TEST_P (InputFormats, PointsAndFieldsComeBack)
{
  const InputCase& input = GetParam ();
  const Sample sample = makeSample (input.is_double);
  if (input.file == "in.pcd")
    writePcd (path (input.file), sample, static_cast<PcdKind> (input.kind));
  else
    writeFile (input.file, input.file == "in.ply"
                               ? plyText (sample, static_cast<PlyKind> (input.kind))
                               : objText (sample));
  const Outcome outcome = run ({input.file, "out.ply"});
  ASSERT_EQ (outcome.code, 0) << outcome.err;
  const MeshContent mesh = readPly (path ("out.ply"));
  EXPECT_EQ (mesh.is_double, input.is_double);
  EXPECT_EQ (mesh.points, sample.points);
  EXPECT_EQ (mesh.colors, sample.colors);
  EXPECT_EQ (mesh.normals, sample.normals);
  if (input.file == "in.obj")
    EXPECT_THAT (mesh.fields, testing::IsEmpty ());
  else
    EXPECT_EQ (mesh.fields.at ("intensity"), asDoubles (sample.intensities));
  expectDisc (mesh, sample.size ());
  const bool has_list = input.file == "in.ply";
  EXPECT_EQ (outcome.err.find ("the list 'marks'") != std::string::npos, has_list);
  EXPECT_EQ (outcome.err.find ("written as doubles") != std::string::npos, input.is_double);
  const bool has_face = input.file != "in.pcd";
  EXPECT_EQ (outcome.err.find ("1 face of the input file was left out") != std::string::npos,
             has_face);
  EXPECT_EQ (std::count (outcome.err.begin (), outcome.err.end (), '\n'),
             (has_list ? 1 : 0) + (input.is_double ? 1 : 0) + (has_face ? 1 : 0));
}

INSTANTIATE_TEST_SUITE_P (All, InputFormats, testing::ValuesIn (inputCases ()),
                          [] (const auto& instance) { return instance.param.name; });

class OutputFormats : public ToolTestWith<bool>
{
protected:
  OutputFormats () : sample_ (makeSample (GetParam ()))
  {
    writePcd (path ("in.pcd"), sample_, PcdKind::BINARY);
  }

  MeshContent reconstructTo (const std::string& name) const
  {
    const Outcome outcome = run ({"in.pcd", name});
    EXPECT_EQ (outcome.code, 0) << outcome.err;
    return readMesh (path (name));
  }

  Sample sample_;
};

// What the formats hold.
struct Held
{
  std::string file;
  bool has_fields; ///< all of them; otherwise colours and normals
  std::string begin;
};

TEST_P (OutputFormats, HoldTheCloudAndTheSameTriangles)
{
  const MeshContent vtk = reconstructTo ("out.vtk");
  expectDisc (vtk, sample_.size ());
  for (const Held& held :
       {Held{"out.vtk", true, "# vtk"}, Held{"out.ply", true, "ply\n"},
        Held{"out.obj", false, "# "}, Held{"out.off", false, "CNOFF\n# written by"},
        Held{"out.glb", false, "glTF"}}) {
    SCOPED_TRACE (held.file);
    if (held.file == "out.glb" && sample_.is_double)
      continue; // see FormatsOfFloatsAreRefused
    const MeshContent mesh = reconstructTo (held.file);
    EXPECT_EQ (readFile (held.file).rfind (held.begin, 0), 0U);
    EXPECT_EQ (mesh.triangles, vtk.triangles);
    EXPECT_EQ (mesh.colors, sample_.colors);
    EXPECT_EQ (mesh.normals, sample_.normals);
    ASSERT_EQ (mesh.points.size (), sample_.size ());
    for (std::size_t i = 0; i < sample_.size (); ++i)
      if (sample_.is_double)
        EXPECT_EQ (mesh.points[i], sample_.points[i]);
      else
        EXPECT_EQ (mesh.points[i].cast<float> (), sample_.points[i].cast<float> ());
    if (held.has_fields) {
      EXPECT_EQ (mesh.is_double, sample_.is_double);
      EXPECT_EQ (mesh.fields,
                 (decltype (mesh.fields){{"intensity", asDoubles (sample_.intensities)}}));
    }
  }
}

TEST_P (OutputFormats, PclReadsVtkWithColors)
{
  const MeshContent mesh = reconstructTo ("out.vtk");
  const MeshContent pcl_mesh = readVtkWithPcl (path ("out.vtk"));
  EXPECT_EQ (pcl_mesh.triangles, mesh.triangles);
  EXPECT_EQ (pcl_mesh.colors, sample_.colors);
  ASSERT_EQ (pcl_mesh.points.size (), sample_.size ());
  for (std::size_t i = 0; i < sample_.size (); ++i)
    EXPECT_EQ (pcl_mesh.points[i].cast<float> (), sample_.points[i].cast<float> ());
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
    expectFailure ({"in.pcd", file}, 4, name + " holds 32-bit floats");
    const Outcome shifted = run ({"in.pcd", file, "--shift", "600000,5000000,100"});
    EXPECT_EQ (shifted.code, 0);
    EXPECT_NE (shifted.err.find (name + " holds single precision"), std::string::npos)
        << shifted.err;
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

// Points in no triangle and equal points are vertices, too; normals are unit vectors.
TEST_F (ToolTest, GlbHoldsEveryPoint)
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
  ASSERT_EQ (run ({"in.pcd", "out.glb"}).code, 0);
  const MeshContent mesh = readGlb (path ("out.glb"));
  EXPECT_EQ (mesh.points, sample.points);
  EXPECT_LT ((mesh.normals.at (0) - Eigen::Vector3f (0.0F, 0.6F, -0.8F)).norm (), 1e-6F);
  for (const std::size_t p : {std::size_t{1}, std::size_t{2}, sample.points.size () - 1})
    EXPECT_EQ (mesh.normals.at (p), Eigen::Vector3f (0, 0, 1));
}

TEST_P (OutputFormats, ParameterizationIsTheMeshInThePlane)
{
  for (const std::string extension : {"vtk", "ply", "obj", "stl", "off"}) {
    const std::string flat_name = "flat." + extension;
    ASSERT_EQ (run ({"in.pcd", "out.vtk", "--quiet", "--parameterization", flat_name}).code, 0);
    const MeshContent flat = readMesh (path (flat_name));
    EXPECT_EQ (flat.triangles.size (), readMesh (path ("out.vtk")).triangles.size ());
    for (const Eigen::Vector3d& p : flat.points) {
      EXPECT_EQ (p.z (), 0.0);
      EXPECT_LE (p.head<2> ().norm (), 1.0 + 1e-6);
    }
    if (extension != "stl") {
      EXPECT_EQ (flat.triangles, readMesh (path ("out.vtk")).triangles);
      EXPECT_EQ (flat.colors, sample_.colors);
      EXPECT_TRUE (flat.normals.empty ());
    }
  }
}

INSTANTIATE_TEST_SUITE_P (All, OutputFormats, testing::Bool (), [] (const auto& instance) {
  return instance.param ? "Double" : "Float";
});

using Formats = ToolTest;

/// A sample whose coordinates 32-bit floats hold, in a file that says double.
void
writeFloatsAsDoubles (const std::string& file, const Sample& sample)
{
  Sample wide = sample;
  wide.is_double = true;
  writePcd (file, wide, PcdKind::BINARY);
}

// PCL's reader of PLY takes doubles for 0 in points of floats.
TEST_F (Formats, PclReadsPlyIntoItsPoints)
{
  const Sample sample = makeSample (false);
  writeFloatsAsDoubles (path ("in.pcd"), sample);
  writeFile ("in.obj", objText (sample));
  for (const std::string input : {"in.pcd", "in.obj"}) {
    const Outcome outcome = run ({input, "out.ply"});
    EXPECT_EQ (outcome.err.find ("written as doubles"), std::string::npos) << outcome.err;
    const std::vector<Eigen::Vector3f> points = loadPlyIntoPoints (path ("out.ply"));
    ASSERT_EQ (points.size (), sample.size ());
    for (std::size_t i = 0; i < points.size (); ++i)
      EXPECT_EQ (points[i], sample.points[i].cast<float> ());
  }
}

// An OBJ file has no types: decimals that a float prints are floats.
TEST_F (Formats, ShortDecimalsOfObjAreFloats)
{
  const auto writeWith = [this] (double origin) {
    std::ostringstream text;
    text << std::fixed << std::setprecision (3);
    for (int i = 0; i < 200; ++i)
      text << "v " << origin + 0.1 * (i % 20) << ' ' << 0.1 * (i / 20) << ' ' << 0.007 * (i % 7)
           << '\n';
    writeFile ("in.obj", text.str ());
  };
  writeWith (0.0);
  ASSERT_EQ (run ({"in.obj", "out.ply"}).code, 0);
  EXPECT_EQ (loadPlyIntoPoints (path ("out.ply"))[21], Eigen::Vector3f (0.1F, 0.1F, 0.0F));
  writeWith (5'500'000.0); // of so many digits a float keeps the first ones only
  ASSERT_EQ (run ({"in.obj", "out.ply"}).code, 0);
  EXPECT_TRUE (readPly (path ("out.ply")).is_double);
  Sample tenths = makeSample (false); // which are doubles where a file says so
  tenths.is_double = true;
  for (Eigen::Vector3d& p : tenths.points)
    p = (10.0 * p).array ().round () / 10.0;
  writePcd (path ("tenths.pcd"), tenths, PcdKind::BINARY);
  ASSERT_EQ (run ({"tenths.pcd", "out.ply"}).code, 0);
  EXPECT_TRUE (readPly (path ("out.ply")).is_double);
}

TEST_F (Formats, PrecisionIsThatAskedFor)
{
  const Sample sample = makeSample (false);
  writeFloatsAsDoubles (path ("in.pcd"), sample);
  ASSERT_EQ (run ({"in.pcd", "wide.ply", "--precision", "double", "--strict"}).code, 0);
  EXPECT_TRUE (readPly (path ("wide.ply")).is_double);
  EXPECT_EQ (readPly (path ("wide.ply")).points, sample.points);
  const Sample map = makeSample (true);
  writePcd (path ("map.pcd"), map, PcdKind::BINARY);
  ASSERT_EQ (run ({"map.pcd", "map.ply", "--precision", "single"}).code, 0);
  const MeshContent rounded = readPly (path ("map.ply"));
  EXPECT_FALSE (rounded.is_double);
  for (std::size_t i = 0; i < map.size (); ++i)
    EXPECT_EQ (rounded.points[i].cast<float> (), map.points[i].cast<float> ());
  EXPECT_EQ (run ({"map.pcd", "map.ply", "--precision", "half"}).code, 1);
}

TEST_F (Formats, OffNamesWhatItHolds)
{
  writeFile ("plain.pcd", pcdText (makeSample (false).points));
  ASSERT_EQ (run ({"plain.pcd", "plain.off"}).code, 0);
  EXPECT_EQ (readFile ("plain.off").rfind ("OFF\n", 0), 0U);
  ASSERT_EQ (run ({"plain.pcd", "plain.off", "--normals", "--shift", "1,2,3"}).code, 0);
  EXPECT_EQ (readFile ("plain.off")
                 .rfind ("NOFF\n# written by pcl_floater_reconstruct\n# shift 1 2 3\n", 0),
             0U);
}

TEST_F (Formats, OutputCanBeInput)
{
  const Sample sample = makeSample (true);
  writePcd (path ("in.pcd"), sample, PcdKind::BINARY);
  ASSERT_EQ (run ({"in.pcd", "a.ply"}).code, 0);
  ASSERT_EQ (run ({"a.ply", "b.ply"}).code, 0);
  EXPECT_EQ (readFile ("a.ply"), readFile ("b.ply"));
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
  ASSERT_EQ (run ({"in.pcd", "out.vtk"}).code, 0);
  const MeshContent vtk = readVtk (path ("out.vtk"));
  for (const auto& [name, value] : expected)
    EXPECT_THAT (vtk.fields.at (name),
                 testing::AllOf (testing::SizeIs (sample.size ()), testing::Each (value)))
        << name;
  EXPECT_EQ (vtk.fields.at ("h").size (), 3 * sample.size ());
  EXPECT_EQ (vtk.fields.at ("h")[0], 0.1);
  EXPECT_TRUE (std::isnan (vtk.fields.at ("h")[1]));
  EXPECT_EQ (vtk.fields.at ("h")[2], -std::numeric_limits<double>::infinity ());
  EXPECT_EQ (vtk.colors.at (5), (std::array<std::uint8_t, 3>{200, 100, 5}));

  const Outcome outcome = run ({"in.pcd", "out.ply"});
  ASSERT_EQ (outcome.code, 0);
  EXPECT_NE (outcome.err.find ("the field 'g' was written as double"), std::string::npos)
      << outcome.err;
  const MeshContent ply = readPly (path ("out.ply"));
  EXPECT_EQ (ply.fields.at ("g").at (7), 1234567890123.0);
  EXPECT_EQ (ply.fields.at ("h_0").at (7), 0.1);
  EXPECT_EQ (ply.fields.at ("d").at (7), 65535);
}

} // namespace
} // namespace pcl::floater

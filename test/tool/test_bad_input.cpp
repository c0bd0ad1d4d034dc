// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Files and clouds that cannot be used: exit code, a message that names the cause, and no output.
#include "cloud_reader.h"
#include "sample.h"
#include "tool_runner.h"

#include <cmath>

namespace pcl::floater {
namespace {
constexpr int INPUT_FAILED = 2;
constexpr int RECONSTRUCTION_FAILED = 3;

const std::string XYZ = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";
const std::string VERTEX = "property float x\nproperty float y\nproperty float z\nend_header\n";

struct BadFile
{
  std::string name;
  std::string file;
  std::string bytes;
  std::string cause;
};

std::ostream&
operator<< (std::ostream& stream, const BadFile& value)
{
  return stream << value.name;
}

std::vector<BadFile>
badFiles ()
{
  const std::string two = "WIDTH 2\nHEIGHT 1\nPOINTS 2\n";
  const std::string many = "WIDTH 4000000000\nHEIGHT 4000000000\nPOINTS 16000000000000000000\n";
  const std::string zeros (12, '\0');
  const std::string compressed_sizes ("\x05\0\0\0\x18\0\0\0", 8);
  return {
      {"Empty", "in.pcd", "", "empty"},
      {"NotPcd", "in.pcd", "hello world\n", "line 1: this is not a line of a PCD header"},
      {"PcdBytes", "in.pcd", std::string (100, '\xfe'), "this is not a line of a PCD header"},
      {"PcdNoData", "in.pcd", XYZ + two, "truncated"},
      {"PcdFewPoints", "in.pcd", XYZ + two + "DATA ascii\n0.00000 0.00000 0.00000\n", "only 1"},
      {"PcdFewNumbers", "in.pcd", XYZ + two + "DATA ascii\n0 0 0\n0 1   \n    \n",
       "line 10: it has fewer values"},
      {"PcdManyNumbers", "in.pcd", XYZ + two + "DATA ascii\n0 0 0\n0 1 2 3\n",
       "line 10: it has more values"},
      {"PcdWord", "in.pcd", XYZ + two + "DATA ascii\n0 0 0\n0 1 high\n",
       "line 10: 'high' is not a number"},
      {"PcdHalfNumber", "in.pcd", XYZ + two + "DATA ascii\n0 0 0\n0 1 2x\n",
       "line 10: '2x' is not a number"},
      {"PcdShortBinary", "in.pcd", XYZ + two + "DATA binary\n" + zeros, "truncated"},
      {"PcdAbsurdBinary", "in.pcd", XYZ + many + "DATA binary\n" + zeros, "truncated"},
      {"PcdAbsurdAscii", "in.pcd", XYZ + many + "DATA ascii\n0 0 0\n", "truncated"},
      {"PcdAbsurdCompressed", "in.pcd",
       XYZ + many + "DATA binary_compressed\n" + compressed_sizes + "abcde", "truncated"},
      {"PcdOverflow", "in.pcd", XYZ + "WIDTH 18446744073709551615\nHEIGHT 2\nDATA ascii\n",
       "is too large"},
      {"PcdShortCompressed", "in.pcd",
       XYZ + two + "DATA binary_compressed\n" + compressed_sizes + "ab", "truncated"},
      {"PcdDamaged", "in.pcd",
       XYZ + two + "DATA binary_compressed\n" + compressed_sizes + "\xff\xff\xff\xff\xff",
       READS_COMPRESSED ? "damaged" : "liblzf"},
      {"PcdNoSizes", "in.pcd", XYZ + two + "DATA binary_compressed\n\x05", "truncated"},
      {"PcdOtherData", "in.pcd", XYZ + two + "DATA hex\n00\n", "'hex'"},
      {"PcdNoPoints", "in.pcd", XYZ + "WIDTH 0\nHEIGHT 1\nPOINTS 0\nDATA ascii\n", "no points"},
      {"PcdProduct", "in.pcd", XYZ + "WIDTH 3\nHEIGHT 2\nPOINTS 5\nDATA ascii\n", "POINTS is 5"},
      {"PcdNegative", "in.pcd", XYZ + "WIDTH -3\nHEIGHT 1\nDATA ascii\n", "'-3' is not a number"},
      {"PcdNoX", "in.pcd",
       "FIELDS a y z\nSIZE 4 4 4\nTYPE F F F\n" + two + "DATA ascii\n0 0 0\n1 1 1\n",
       "no coordinate 'x' (fields of the file: a, y, z)"},
      {"PcdType", "in.pcd",
       "FIELDS x y z\nSIZE 4 4 3\nTYPE F F Q\n" + two + "DATA ascii\n0 0 0\n1 1 1\n",
       "TYPE Q and SIZE 3"},
      {"PcdLengths", "in.pcd", "FIELDS x y z\nSIZE 4 4\nTYPE F F F\n" + two + "DATA ascii\n0 0 0\n",
       "differ in length"},
      {"PcdCount", "in.pcd",
       "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 -20\n" + two + "DATA ascii\n", "'-20'"},
      {"NotPly", "in.ply", "plywood\n", "not a PLY file"},
      {"PlyNoEnd", "in.ply", "ply\nformat ascii 1.0\nelement vertex 2\n", "truncated"},
      {"PlyNoFormat", "in.ply", "ply\nelement vertex 2\n" + VERTEX, "no format line"},
      {"PlyNoVertex", "in.ply", "ply\nformat ascii 1.0\nelement face 0\n" + VERTEX,
       "no element 'vertex'"},
      {"PlyType", "in.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty quad x\n" + VERTEX,
       "line 4: 'quad' is not a type of PLY"},
      {"PlyFormat", "in.ply", "ply\nformat binary 1.0\nelement vertex 2\n" + VERTEX,
       "'binary' is not a format"},
      {"PlyFewPoints", "in.ply",
       "ply\nformat ascii 1.0\nelement vertex 2\n" + VERTEX + "0.00000 0.00000 0.00000\n",
       "only 1"},
      {"PlyWord", "in.ply",
       "ply\nformat ascii 1.0\nelement vertex 2\n" + VERTEX + "0 0 0\n0 high 1\n",
       "line 9: 'high' is not a number"},
      {"PlyShort", "in.ply",
       "ply\nformat binary_big_endian 1.0\nelement vertex 2\n" + VERTEX + zeros, "truncated"},
      {"PlyAbsurd", "in.ply",
       "ply\nformat ascii 1.0\nelement vertex 18446744073709551615\n" + VERTEX + "0 0 0\n",
       "truncated"},
      {"PlyAbsurdList", "in.ply",
       "ply\nformat binary_little_endian 1.0\nelement vertex 1\n"
       "property list uint double marks\n" +
           VERTEX + std::string (16, '\xff'),
       "truncated"},
      {"PlyNoPoints", "in.ply", "ply\nformat ascii 1.0\nelement vertex 0\n" + VERTEX, "no points"},
      {"PlyNoZ", "in.ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 "
       "0\n",
       "no coordinate 'z'"},
      {"ObjNoPoints", "in.obj", "# nothing\nf 1 2 3\n", "no points"},
      {"ObjWord", "in.obj", "v 0 0 0\nv 1 2 high\n", "line 2: 'high' is not a number"},
      {"ObjFewNumbers", "in.obj", "v 0 0 0\nv 1 2\n", "line 2: a point has 3, 4 or 6 numbers"},
      {"ObjColor", "in.obj", "v 0 0 0 256 255 255\n", "a colour must be from 0 to 1"},
      {"Extension", "in.e57", "ASTM-E57", "extension '.e57' is unknown"},
      {"NotLas", "in.las", "PK", "not a LAS file"},
      {"ShortLas", "in.las", "LASF", "its header is truncated"},
      {"NotStl", "in.stl", "hello", "too short for a binary STL file"},
      {"StlAbsurd", "in.stl", std::string (84, '\xff'), "truncated"},
      {"NotXyz", "in.xyz", "hello\nworld\n", "no line has three numbers"},
      {"XyzWord", "in.xyz", "0 0 0\n0 1 high\n", "line 2: 'high' is not a number"},
      {"PtsAbsurd", "in.pts", "18446744073709551615\n0 0 0\n", "truncated"},
      {"CsvHalfLine", "in.csv", "x,y,z\n0,0,0\n0,1", "line 3: it does not have 3 columns"},
  };
}

class BadFiles : public ToolTestWith<BadFile>
{
};

TEST_P (BadFiles, AreRefused)
{
  const BadFile& bad = GetParam ();
  writeFile (bad.file, bad.bytes);
  expectFailure ({bad.file, "out.ply", "--report", "out.json"}, INPUT_FAILED, bad.cause);
  EXPECT_NE (run ({bad.file, "out.ply"}).err.find ("cannot read '" + bad.file + "'"),
             std::string::npos);
}

INSTANTIATE_TEST_SUITE_P (All, BadFiles, testing::ValuesIn (badFiles ()),
                          [] (const auto& instance) { return instance.param.name; });

using BadInput = ToolTest;

TEST_F (BadInput, MissingFile)
{
  expectFailure ({"in.pcd", "out.ply"}, INPUT_FAILED,
                 "cannot read 'in.pcd': there is no such file");
}

TEST_F (BadInput, Folder)
{
  std::filesystem::create_directory (path ("in.pcd"));
  expectFailure ({"in.pcd", "out.ply"}, INPUT_FAILED, "it is a folder");
}

/// Reads the first and the last byte of every point, so that a sanitizer sees invalid memory.
void
touchAll (const Field& field, std::size_t points)
{
  std::size_t sum = 0;
  for (std::size_t i = 0; i < points; ++i) {
    const char* const first = field.first.get () + i * field.stride;
    sum += static_cast<std::size_t> (first[0]) +
           static_cast<std::size_t> (first[field.pointBytes () - 1]);
  }
  testing::Test::RecordProperty (field.name, std::to_string (sum));
}

/// Every prefix of a file is either a valid cloud or refused with an error. With the sanitizers,
/// this also finds reads beyond its end.
TEST_F (BadInput, EveryPrefixIsRefusedOrWhole)
{
  const Sample sample = makeSample (true, 4);
  const auto check = [&sample] (const std::string& bytes, auto parse) {
    std::size_t read = 0;
    for (std::size_t length = 0; length <= bytes.size (); ++length) {
      // A copy, so that a sanitizer notices reads beyond the prefix.
      const std::vector<char> prefix (bytes.begin (),
                                      bytes.begin () + static_cast<std::ptrdiff_t> (length));
      try {
        const Cloud cloud = parse (FileBytes (std::string_view (prefix.data (), prefix.size ())));
        EXPECT_LE (cloud.size (), sample.size ());
        EXPECT_EQ (cloud.positions ().size (), cloud.size ());
        for (const Field& field : cloud.fields)
          touchAll (field, cloud.size ());
        ++read;
      }
      catch (const ReadError& error) {
        EXPECT_STRNE (error.what (), "");
      }
    }
    EXPECT_GE (read, 1U);
    EXPECT_LT (read, bytes.size ());
  };
  for (const PcdKind kind : readPcdKinds ()) {
    writePcd (path ("in.pcd"), sample, kind);
    check (readFile ("in.pcd"), [] (const FileBytes& file) { return parsePcd (file, true); });
  }
  for (const PlyKind kind : {PlyKind::ASCII, PlyKind::LITTLE, PlyKind::BIG})
    check (plyText (sample, kind), [] (const FileBytes& file) { return parsePly (file, true); });
  check (objText (sample), parseObj);
}

TEST_F (BadInput, MoreDataThanPromisedIsSaid)
{
  const Sample sample = makeSample (false);
  writeFile ("in.pcd", pcdText (sample.points) + "7 7 7\n");
  const Outcome outcome = run ({"in.pcd", "out.ply"});
  EXPECT_EQ (outcome.code, 0) << outcome.err;
  EXPECT_NE (outcome.err.find ("has more data than the 144 points"), std::string::npos)
      << outcome.err;
}

struct BadCloud
{
  std::string name;
  std::vector<Eigen::Vector3d> points;
  std::string status;
};

std::ostream&
operator<< (std::ostream& stream, const BadCloud& value)
{
  return stream << value.name;
}

std::vector<BadCloud>
badClouds ()
{
  const double nan = std::nan ("");
  std::vector<Eigen::Vector3d> line;
  line.reserve (50);
  for (int i = 0; i < 50; ++i)
    line.emplace_back (i, 2 * i, -i);
  return {{"OnePoint", {{1, 2, 3}}, "TOO_FEW_POINTS"},
          {"OnePlace", std::vector<Eigen::Vector3d> (50, {1, 2, 3}), "TOO_FEW_POINTS"},
          {"AllNan", std::vector<Eigen::Vector3d> (50, {nan, 2, 3}), "TOO_FEW_POINTS"},
          {"Line", line, "DEGENERATE"}};
}

class BadClouds : public ToolTestWith<BadCloud>
{
};

TEST_P (BadClouds, AreNamedInTheReport)
{
  const BadCloud& bad = GetParam ();
  writeFile ("in.pcd", pcdText (bad.points));
  writeFile ("out.ply", "what was there before");
  expectFailure ({"in.pcd", "out.ply"}, RECONSTRUCTION_FAILED, "(" + bad.status + ")");
  EXPECT_EQ (run ({"in.pcd", "out.ply", "--report", "out.json"}).code, RECONSTRUCTION_FAILED);
  EXPECT_NE (readFile ("out.json").find ("\"status\": \"" + bad.status + "\""), std::string::npos);
  EXPECT_EQ (readFile ("out.ply"), "what was there before");
}

INSTANTIATE_TEST_SUITE_P (All, BadClouds, testing::ValuesIn (badClouds ()),
                          [] (const auto& instance) { return instance.param.name; });

} // namespace
} // namespace pcl::floater

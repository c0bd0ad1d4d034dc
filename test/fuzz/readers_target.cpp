// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzz target: the bytes are a file of the format that FUZZED_FORMAT of the environment names;
// table: text with a point in each line. A file is either a cloud or a ReadError with a message.
#include "cloud_reader.h"

#include <cstdio>
#include <cstdlib>

namespace pcl::floater {
namespace {
[[noreturn]] void
fail (const char* fault)
{
  std::fprintf (stderr, "fault: %s\n", fault);
  std::abort ();
}

/// Reads every value of a cloud, as the tool does when it writes a mesh. Ends the program if the
/// cloud does not hold together.
void
useCloud (Cloud& cloud)
{
  if (cloud.size () == 0 || cloud.size () != cloud.rows)
    fail ("the cloud has no points, or not those of its rows");
  const std::vector<Eigen::Vector3d> positions = cloud.positions ();
  std::size_t values = 0, numbers = 0;
  for (const Field& field : cloud.fields)
    for (std::size_t row = 0; row < cloud.rows; ++row)
      visitType (field.type, [&] (auto tag) {
        for (std::size_t c = 0; c < field.count; ++c) {
          ++values;
          numbers +=
              std::isnan (static_cast<double> (field.value<decltype (tag)> (row, c))) ? 0 : 1;
        }
      });
  if (numbers > values) // each has been read
    fail ("there are more numbers than values");
  cloud.colors ();
  cloud.normals ();
  std::size_t finite = 0, left_out = 0;
  for (std::size_t row = 0; row < cloud.rows; ++row) {
    left_out += cloud.isLeftOut (row) ? 1 : 0;
    finite += !cloud.isLeftOut (row) && positions[row].allFinite () ? 1 : 0;
  }
  Triangles none;
  if (removeNonFinitePoints (cloud, none) + finite + left_out != positions.size ())
    fail ("the points that are not finite are not those that were left out");
  for (std::size_t point = 0; point < finite; ++point)
    if (!cloud.position (point).allFinite ())
      fail ("a point that is left is not finite");
}

std::vector<CloudFormat>
chosenFormats ()
{
  const char* const text = std::getenv ("FUZZED_FORMAT");
  const std::string name = text == nullptr ? "" : text;
  if (name == "table")
    return {parseXyz, parsePts};
  for (const auto& [known, format] : CLOUD_FORMATS)
    if (name == known)
      return {format};
  fail ("FUZZED_FORMAT names no format");
}

/// Reads a file as points, with all digits, and as a mesh. Ends the program if the mesh does not hold
/// together.
void
useFile (const FileBytes& file, CloudFormat format)
{
  Triangles triangles;
  ReadOptions digits, mesh;
  digits.all_digits = true;
  mesh.faces = &triangles;
  for (const ReadOptions& options : {ReadOptions{}, digits, mesh})
    try {
      Cloud cloud = format (file, options);
      for (const auto& triangle : triangles)
        for (const std::uint32_t corner : triangle)
          if (corner >= cloud.rows)
            fail ("a triangle has a corner that is no point");
      useCloud (cloud);
    }
    catch (const ReadError& error) {
      if (*error.what () == '\0')
        fail ("an error has no message");
    }
}

} // namespace
} // namespace pcl::floater

extern "C" int
LLVMFuzzerTestOneInput (const std::uint8_t* data, std::size_t size)
{
  using namespace pcl::floater;
  static const std::vector<CloudFormat> formats = chosenFormats ();
  if (size == 0)
    return 0; // readCloud refuses an empty file
  for (const CloudFormat format : formats)
    useFile (FileBytes (std::string_view (reinterpret_cast<const char*> (data), size)), format);
  return 0;
}

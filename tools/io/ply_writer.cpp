// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_writer.h"

#include <algorithm>

namespace pcl::floater {
namespace {
bool
isLong (ScalarType type)
{
  return type == ScalarType::INT64 || type == ScalarType::UINT64;
}

const char*
plyTypeName (ScalarType type)
{
  switch (type) {
  case ScalarType::INT8:
    return "char";
  case ScalarType::UINT8:
    return "uchar";
  case ScalarType::INT16:
    return "short";
  case ScalarType::UINT16:
    return "ushort";
  case ScalarType::INT32:
    return "int";
  case ScalarType::UINT32:
    return "uint";
  case ScalarType::FLOAT32:
    return "float";
  case ScalarType::INT64:
  case ScalarType::UINT64:
  case ScalarType::FLOAT64:
    break;
  }
  return "double";
}

void
writeHeader (AtomicFile& file, const Cloud& cloud, const Triangles& triangles)
{
  file.write ("ply\nformat binary_little_endian 1.0\ncomment written by "
              "pcl_floater_reconstruct\n");
  if (const std::string shift = shiftText (cloud); !shift.empty ())
    file.write ("comment shift " + shift + "\n");
  file.write ("element vertex " + std::to_string (cloud.size ()) + "\n");
  for (const char* axis : {"x", "y", "z"})
    file.write (std::string ("property ") + (cloud.single_precision ? "float " : "double ") + axis +
                "\n");
  for (const Field& field : cloud.fields)
    for (std::size_t c = 0; c < field.count; ++c)
      file.write (std::string ("property ") + plyTypeName (field.type) + " " + field.name +
                  (field.count > 1 ? "_" + std::to_string (c) : "") + "\n");
  file.write ("element face " + std::to_string (triangles.size ()) +
              "\nproperty list uchar int vertex_indices\nend_header\n");
}

/// Writes the coordinates of points `first` to `last` into three columns of rows, as Number.
/// \return width of the columns in bytes
template <typename Number>
std::size_t
fillCoordinates (const Cloud& cloud, std::size_t first, std::size_t last, char* to,
                 std::size_t row_bytes)
{
  for (std::size_t i = first; i < last; ++i, to += row_bytes) {
    const Eigen::Matrix<Number, 3, 1> position = cloud.position (i).cast<Number> ();
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      copyNumber<Number> (to + static_cast<std::size_t> (axis) * sizeof (Number), &position[axis],
                          ByteOrder::LITTLE);
  }
  return 3 * sizeof (Number);
}

/// Writes the values of points `first` to `last` into a column of rows.
/// \return width of the column in bytes
std::size_t
fillColumn (const Cloud& cloud, const Field& field, std::size_t first, std::size_t last, char* to,
            std::size_t row_bytes)
{
  const auto fill = [&] (auto tag, auto out_tag) {
    using T = decltype (tag);
    using Out = decltype (out_tag);
    for (std::size_t i = first; i < last; ++i, to += row_bytes)
      for (std::size_t c = 0; c < field.count; ++c) {
        const auto number = static_cast<Out> (field.value<T> (cloud.row (i), c));
        copyNumber<Out> (to + c * sizeof (Out), &number, ByteOrder::LITTLE);
      }
    return field.count * sizeof (Out);
  };
  return visitType (field.type, [&] (auto tag) {
    return isLong (field.type) ? fill (tag, double{}) : fill (tag, tag);
  });
}

/// Writes blocks of rows, so that the type of a field is looked up once per block.
void
writePoints (AtomicFile& file, const Cloud& cloud)
{
  constexpr std::size_t BLOCK_POINTS = 1024;
  std::size_t row_bytes = 3 * (cloud.single_precision ? sizeof (float) : sizeof (double));
  for (const Field& field : cloud.fields)
    row_bytes += isLong (field.type) ? field.count * sizeof (double) : field.pointBytes ();
  std::vector<char> block (BLOCK_POINTS * row_bytes);
  for (std::size_t first = 0; first < cloud.size (); first += BLOCK_POINTS) {
    const std::size_t last = std::min (cloud.size (), first + BLOCK_POINTS);
    char* to = block.data ();
    to += cloud.single_precision ? fillCoordinates<float> (cloud, first, last, to, row_bytes)
                                 : fillCoordinates<double> (cloud, first, last, to, row_bytes);
    for (const Field& field : cloud.fields)
      to += fillColumn (cloud, field, first, last, to, row_bytes);
    file.write (block.data (), (last - first) * row_bytes);
  }
}

void
writeTriangles (AtomicFile& file, const Triangles& triangles)
{
  constexpr std::size_t CORNER = sizeof (std::int32_t);
  std::array<char, 1 + 3 * CORNER> bytes{3};
  for (const auto& triangle : triangles) {
    for (std::size_t i = 0; i < 3; ++i)
      copyNumber<std::uint32_t> (bytes.data () + 1 + i * CORNER, &triangle[i], ByteOrder::LITTLE);
    file.write (bytes.data (), bytes.size ());
  }
}

} // namespace

std::vector<std::string>
writePly (AtomicFile& file, const Cloud& cloud, const Triangles& triangles)
{
  writeHeader (file, cloud, triangles);
  writePoints (file, cloud);
  writeTriangles (file, triangles);
  std::vector<std::string> widened;
  for (const Field& field : cloud.fields)
    if (isLong (field.type))
      widened.push_back (field.name);
  return widened;
}

} // namespace pcl::floater

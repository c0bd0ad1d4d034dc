// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_writer.h"

namespace pcl
{
namespace floater
{
namespace
{
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
              "pcl_floater_reconstruct\nelement vertex " +
              std::to_string (cloud.size ()) + "\n");
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

} // namespace

std::vector<std::string>
writePly (AtomicFile& file, const Cloud& cloud, const Triangles& triangles)
{
  writeHeader (file, cloud, triangles);
  for (std::size_t i = 0; i < cloud.size (); ++i) {
    for (const double coordinate : cloud.positions[i]) {
      if (cloud.single_precision)
        file.writeNumber (static_cast<float> (coordinate), ByteOrder::LITTLE);
      else
        file.writeNumber (coordinate, ByteOrder::LITTLE);
    }
    for (const Field& field : cloud.fields)
      visitType (field.type, [&] (auto tag) {
        using T = decltype (tag);
        for (std::size_t c = i * field.count; c < (i + 1) * field.count; ++c) {
          if constexpr (std::is_integral_v<T> && sizeof (T) == sizeof (std::int64_t))
            file.writeNumber (static_cast<double> (field.value<T> (c)), ByteOrder::LITTLE);
          else
            file.writeNumber (field.value<T> (c), ByteOrder::LITTLE);
        }
      });
  }
  for (const auto& triangle : triangles) {
    file.writeNumber (std::uint8_t{3}, ByteOrder::LITTLE);
    for (const std::uint32_t corner : triangle)
      file.writeNumber (static_cast<std::int32_t> (corner), ByteOrder::LITTLE);
  }
  std::vector<std::string> widened;
  for (const Field& field : cloud.fields)
    if (isLong (field.type))
      widened.push_back (field.name);
  return widened;
}

} // namespace floater
} // namespace pcl

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Binary glTF 2.0. The libraries for it in Debian 12 do not fit: assimp puts equal points together
// and leaves out those in no triangle, VTK writes what a window shows, and tinygltf takes the whole
// file in memory. The file is three numbers, a text in JSON and the arrays.
#include "mesh_writer.h"

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

namespace pcl::floater {
namespace {
using Json = nlohmann::json;

// Numbers of the specification.
constexpr int FLOAT = 5126, UNSIGNED_BYTE = 5121, UNSIGNED_INT = 5125;
constexpr int VERTICES = 34962, INDICES = 34963, TRIANGLES = 4;
constexpr std::uint32_t MAGIC = 0x46546C67, JSON_CHUNK = 0x4E4F534A, BINARY_CHUNK = 0x004E4942;
constexpr std::size_t ALIGNMENT = 4;

/// Normals must have length 1. Others are scaled, and those that are none point up.
Eigen::Vector3f
unitNormal (const FieldTriple& fields, std::size_t row)
{
  constexpr double ROUNDING = 1e-4; // of the square, of numbers of four digits
  Eigen::Vector3d normal = vectorOf (fields, row);
  if (std::abs (normal.squaredNorm () - 1.0) > ROUNDING)
    normal.stableNormalize ();
  if (!normal.allFinite () || normal.isZero (0.0))
    return Eigen::Vector3f::UnitZ ();
  return normal.cast<float> ();
}

} // namespace

/// Positions in single precision, colours, normals of length 1 (0 0 1 where there is none), and
/// triangles.
/// \throws WriteError also if it would have more than 4 GB
void
writeGlb (AtomicFile& file, const Cloud& cloud, const Triangles& triangles, MeshExtras& /*extras*/)
{
  const FieldTriple colors = cloud.colors ();
  const FieldTriple normals = cloud.normals ();
  const Field* const alpha = cloud.find ("alpha");
  const bool has_alpha = alpha != nullptr && alpha->type == ScalarType::UINT8 && alpha->count == 1;
  constexpr std::size_t VECTOR = 3 * sizeof (float);
  Json attributes, views = Json::array (), accessors = Json::array ();
  std::size_t bytes = 0; // of the arrays, which are one after the other
  const auto add = [&] (const char* type, int component, std::size_t count, std::size_t bytes_each,
                        int target) {
    const std::size_t number = views.size ();
    views.push_back ({{"buffer", 0},
                      {"byteOffset", bytes},
                      {"byteLength", count * bytes_each},
                      {"target", target}});
    accessors.push_back (
        {{"bufferView", number}, {"componentType", component}, {"count", count}, {"type", type}});
    bytes += count * bytes_each;
    return number;
  };
  attributes["POSITION"] = add ("VEC3", FLOAT, cloud.size (), VECTOR, VERTICES);
  Eigen::AlignedBox3f box;
  for (std::size_t i = 0; i < cloud.size (); ++i)
    box.extend (cloud.position (i).cast<float> ());
  accessors.back ()["min"] = box.min ();
  accessors.back ()["max"] = box.max ();
  if (normals[0])
    attributes["NORMAL"] = add ("VEC3", FLOAT, cloud.size (), VECTOR, VERTICES);
  if (colors[0]) {
    attributes["COLOR_0"] = add ("VEC4", UNSIGNED_BYTE, cloud.size (), ALIGNMENT, VERTICES);
    accessors.back ()["normalized"] = true;
  }
  const std::size_t indices =
      add ("SCALAR", UNSIGNED_INT, 3 * triangles.size (), sizeof (std::uint32_t), INDICES);

  // Up is +y for viewers, and +z in most clouds. The arrays have the coordinates of the cloud.
  Json all = Json::parse (R"({
    "asset": {"version": "2.0", "generator": "pcl_floater_reconstruct"},
    "scene": 0,
    "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0, "rotation": [-0.7071067811865476, 0.0, 0.0, 0.7071067811865476]}],
    "meshes": [{"primitives": [{"material": 0}]}],
    "materials": [{"doubleSided": true, "pbrMetallicRoughness": {"metallicFactor": 0.0}}]})");
  if (const std::string shift = cloud.shiftText (); !shift.empty ())
    all["asset"]["extras"]["shift"] = shift;
  all["meshes"][0]["primitives"][0].update (
      {{"attributes", attributes}, {"indices", indices}, {"mode", TRIANGLES}});
  all["buffers"][0]["byteLength"] = bytes;
  all["bufferViews"] = views;
  all["accessors"] = accessors;
  std::string text = all.dump ();
  text.resize ((text.size () + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT, ' ');

  constexpr std::size_t HEADER = 12, CHUNK_HEADER = 8;
  const std::size_t size = HEADER + 2 * CHUNK_HEADER + text.size () + bytes;
  if (size > std::numeric_limits<std::uint32_t>::max ())
    throw WriteError (
        "cannot write the mesh as .glb, which holds 4 GB at most; write .ply or .vtk");
  const auto write = [&file] (std::initializer_list<std::size_t> numbers) {
    for (const std::size_t number : numbers)
      file.writeNumber (static_cast<std::uint32_t> (number));
  };
  write ({MAGIC, 2, size, text.size (), JSON_CHUNK}); // 2 is the version
  file.write (text);
  write ({bytes, BINARY_CHUNK});
  for (std::size_t i = 0; i < cloud.size (); ++i)
    writeNumbers (file, cloud.position (i).cast<float> ().eval ());
  if (normals[0])
    for (std::size_t i = 0; i < cloud.size (); ++i)
      writeNumbers (file, unitNormal (normals, cloud.row (i)));
  if (colors[0])
    for (std::size_t i = 0; i < cloud.size (); ++i) {
      for (const Field* channel : colors)
        file.writeNumber (channel->value<std::uint8_t> (cloud.row (i)));
      constexpr std::uint8_t OPAQUE = 255;
      file.writeNumber (has_alpha ? alpha->value<std::uint8_t> (cloud.row (i)) : OPAQUE);
    }
  for (const auto& triangle : triangles)
    writeNumbers (file, triangle);
}

} // namespace pcl::floater

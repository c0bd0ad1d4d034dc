// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_writer.h"

#include "format.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pcl::floater {
namespace {
const std::string COMMENT = "written by pcl_floater_reconstruct";

void
writeTriple (AtomicFile& file, const FieldTriple& fields, std::size_t row)
{
  visitType (fields[0]->type, [&] (auto tag) {
    using T = decltype (tag);
    std::array<double, 3> values{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      values[axis] = static_cast<double> (fields[axis]->value<T> (row));
    const bool are_finite =
        std::isfinite (values[0]) && std::isfinite (values[1]) && std::isfinite (values[2]);
    for (const double value : values) {
      file.write (" ");
      if constexpr (std::is_same_v<T, float>)
        file.writeDecimal (are_finite ? static_cast<float> (value) : 0.0F);
      else
        file.writeDecimal (are_finite ? value : 0.0);
    }
  });
}

/// Each coordinate after a blank, with as many digits as tell it from its neighbours.
void
writePosition (AtomicFile& file, const Cloud& cloud, std::size_t point)
{
  for (const double coordinate : cloud.position (point)) {
    file.write (" ");
    if (cloud.single_precision)
      file.writeDecimal (static_cast<float> (coordinate));
    else
      file.writeDecimal (coordinate);
  }
}

/// \throws WriteError if 32-bit floats make two corners of a triangle one
void
requireTrianglesInSinglePrecision (const std::filesystem::path& path, const char* format,
                                   const Cloud& cloud, const Triangles& triangles)
{
  if (const std::size_t lost = countMergedInSinglePrecision (cloud, triangles))
    throw WriteError ("cannot write '" + path.string () + "': " + format +
                      " holds 32-bit floats, in which " + std::to_string (lost) + " of " +
                      std::to_string (triangles.size ()) +
                      " triangles have two equal corners; subtract an origin with --shift, or "
                      "write .vtk, .ply, .obj or .off");
}

/// Wavefront OBJ: points with colours, normals (0 0 0 where they are not finite), and faces.
void
writeObj (AtomicFile& file, const Cloud& cloud, const Triangles& triangles,
          const MeshTexture* texture)
{
  const FieldTriple colors = colorFields (cloud);
  const FieldTriple normals = normalFields (cloud);
  file.write ("# " + COMMENT + "\n");
  if (const std::string shift = shiftText (cloud); !shift.empty ())
    file.write ("# shift " + shift + "\n");
  if (texture != nullptr)
    file.write ("mtllib " + texture->materials + "\n");
  for (std::size_t i = 0; i < cloud.size (); ++i) {
    file.write ("v");
    writePosition (file, cloud, i);
    if (colors[0])
      for (const Field* channel : colors) {
        constexpr float WHITE = 255.0F;
        file.write (" ");
        file.writeDecimal (static_cast<float> (channel->value<std::uint8_t> (cloud.row (i))) /
                           WHITE);
      }
    file.write ("\n");
  }
  if (normals[0])
    for (std::size_t i = 0; i < cloud.size (); ++i) {
      file.write ("vn");
      writeTriple (file, normals, cloud.row (i));
      file.write ("\n");
    }
  if (texture != nullptr) {
    for (const Eigen::Vector2f& uv : texture->coordinates) {
      file.write ("vt ");
      file.writeDecimal (uv.x ());
      file.write (" ");
      file.writeDecimal (uv.y ());
      file.write ("\n");
    }
    file.write ("usemtl surface\n");
  }
  for (std::size_t t = 0; t < triangles.size (); ++t) {
    file.write ("f");
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint64_t number = triangles[t][i] + std::uint64_t{1};
      file.write (" ");
      file.writeDecimal (number);
      if (texture != nullptr) {
        file.write ("/");
        file.writeDecimal (texture->corners[t][i] + std::uint64_t{1});
      }
      if (normals[0]) {
        file.write (texture != nullptr ? "/" : "//");
        file.writeDecimal (number);
      }
    }
    file.write ("\n");
  }
}

/// Geomview OFF, text: points with colours from 0 to 255, normals (0 0 0 where they are not
/// finite), and faces. Its first word is OFF, COFF, NOFF or CNOFF.
void
writeOff (AtomicFile& file, const Cloud& cloud, const Triangles& triangles)
{
  const FieldTriple colors = colorFields (cloud);
  const FieldTriple normals = normalFields (cloud);
  file.write (std::string (colors[0] ? "C" : "") + (normals[0] ? "N" : "") + "OFF\n# " + COMMENT +
              "\n");
  if (const std::string shift = shiftText (cloud); !shift.empty ())
    file.write ("# shift " + shift + "\n");
  file.write (std::to_string (cloud.size ()) + " " + std::to_string (triangles.size ()) + " 0\n");
  for (std::size_t i = 0; i < cloud.size (); ++i) {
    writePosition (file, cloud, i);
    if (normals[0])
      writeTriple (file, normals, cloud.row (i));
    if (colors[0]) {
      for (const Field* channel : colors) {
        file.write (" ");
        file.writeDecimal (std::uint64_t{channel->value<std::uint8_t> (cloud.row (i))});
      }
      file.write (" 255"); // opaque
    }
    file.write ("\n");
  }
  for (const auto& triangle : triangles) {
    file.write ("3");
    for (const std::uint32_t corner : triangle) {
      file.write (" ");
      file.writeDecimal (std::uint64_t{corner});
    }
    file.write ("\n");
  }
}

/// Binary STL: triangles in single precision, nothing else.
void
writeStl (AtomicFile& file, const Cloud& cloud, const Triangles& triangles)
{
  constexpr std::size_t HEADER = 80; // bytes; must not begin with "solid"
  std::string header = COMMENT;
  header.resize (HEADER, ' ');
  file.write (header);
  file.writeNumber (static_cast<std::uint32_t> (triangles.size ()), ByteOrder::LITTLE);
  for (const auto& triangle : triangles) {
    const std::array<Eigen::Vector3d, 3> corners{
        cloud.position (triangle[0]), cloud.position (triangle[1]), cloud.position (triangle[2])};
    const Eigen::Vector3d normal =
        (corners[1] - corners[0]).cross (corners[2] - corners[0]).normalized ();
    for (const double value : normal)
      file.writeNumber (static_cast<float> (value), ByteOrder::LITTLE);
    for (const Eigen::Vector3d& corner : corners)
      for (const double value : corner)
        file.writeNumber (static_cast<float> (value), ByteOrder::LITTLE);
    file.writeNumber (std::uint16_t{0}, ByteOrder::LITTLE);
  }
}

// Does not use VTK, because loading its libraries takes longer than reconstructing most clouds. The
// tests read the files back with VTK and PCL.

/// VTK decodes %xx in the names of arrays.
std::string
encodeName (const std::string& name)
{
  std::string encoded;
  for (const char c : name) {
    if (c > ' ' && c <= '~' && c != '%' && c != '"')
      encoded += c;
    else {
      std::array<char, 4> code{};
      std::snprintf (code.data (), code.size (), "%%%02X", static_cast<unsigned char> (c));
      encoded += code.data ();
    }
  }
  return encoded;
}

void
writeTriple (AtomicFile& file, const FieldTriple& fields, const Cloud& cloud)
{
  visitType (fields[0]->type, [&] (auto tag) {
    using T = decltype (tag);
    for (std::size_t i = 0; i < cloud.size (); ++i)
      for (const Field* field : fields)
        file.writeNumber (field->value<T> (cloud.row (i)), ByteOrder::BIG);
  });
  file.write ("\n");
}

void
writeArray (AtomicFile& file, const Field& field, const Cloud& cloud)
{
  file.write (encodeName (field.name) + " " + std::to_string (field.count) + " " +
              std::to_string (cloud.size ()) + " " + std::string (namesOf (field.type).vtk) + "\n");
  visitType (field.type, [&] (auto tag) {
    for (std::size_t i = 0; i < cloud.size (); ++i)
      for (std::size_t c = 0; c < field.count; ++c)
        file.writeNumber (field.value<decltype (tag)> (cloud.row (i), c), ByteOrder::BIG);
  });
  file.write ("\n");
}

/// Legacy VTK 3.0, binary, polydata. Colours are unsigned char scalars named "RGB", which viewers
/// show unchanged and PCL reads by that name; normals are point normals; other fields are arrays.
/// \param with_texture the float fields s and t are texture coordinates
void
writeVtk (AtomicFile& file, const Cloud& cloud, const Triangles& triangles, bool with_texture)
{
  const std::string size = std::to_string (cloud.size ());
  const std::string shift = shiftText (cloud);
  file.write ("# vtk DataFile Version 3.0\nwritten by pcl_floater_reconstruct" +
              (shift.empty () ? "" : ", shift " + shift) + "\nBINARY\nDATASET POLYDATA\n");
  file.write ("POINTS " + size + (cloud.single_precision ? " float\n" : " double\n"));
  for (std::size_t i = 0; i < cloud.size (); ++i)
    for (const double coordinate : cloud.position (i)) {
      if (cloud.single_precision)
        file.writeNumber (static_cast<float> (coordinate), ByteOrder::BIG);
      else
        file.writeNumber (coordinate, ByteOrder::BIG);
    }
  file.write ("\nPOLYGONS " + std::to_string (triangles.size ()) + " " +
              std::to_string (4 * triangles.size ()) + "\n");
  for (const auto& triangle : triangles) {
    file.writeNumber (std::int32_t{3}, ByteOrder::BIG);
    for (const std::uint32_t corner : triangle)
      file.writeNumber (static_cast<std::int32_t> (corner), ByteOrder::BIG);
  }
  file.write ("\n");

  const FieldTriple colors = colorFields (cloud);
  const FieldTriple normals = normalFields (cloud);
  const std::array<const Field*, 2> texture{with_texture ? cloud.find ("s") : nullptr,
                                            with_texture ? cloud.find ("t") : nullptr};
  std::vector<const Field*> others;
  for (const Field& field : cloud.fields)
    if (std::find (texture.begin (), texture.end (), &field) == texture.end () &&
        std::find (colors.begin (), colors.end (), &field) == colors.end () &&
        std::find (normals.begin (), normals.end (), &field) == normals.end ())
      others.push_back (&field);
  if (!cloud.fields.empty ())
    file.write ("POINT_DATA " + size + "\n");
  if (colors[0]) {
    file.write ("COLOR_SCALARS RGB 3\n");
    writeTriple (file, colors, cloud);
  }
  if (normals[0]) {
    file.write ("NORMALS Normals " + std::string (namesOf (normals[0]->type).vtk) + "\n");
    writeTriple (file, normals, cloud);
  }
  if (with_texture) {
    file.write ("TEXTURE_COORDINATES TCoords 2 float\n");
    for (std::size_t i = 0; i < cloud.size (); ++i)
      for (const Field* field : texture)
        file.writeNumber (field->value<float> (cloud.row (i)), ByteOrder::BIG);
    file.write ("\n");
  }
  if (!others.empty ()) {
    file.write ("FIELD FieldData " + std::to_string (others.size ()) + "\n");
    for (const Field* field : others)
      writeArray (file, *field, cloud);
  }
}

bool
isLong (ScalarType type)
{
  return type == ScalarType::INT64 || type == ScalarType::UINT64;
}

void
writePlyHeader (AtomicFile& file, const Cloud& cloud, const Triangles& triangles)
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
      file.write ("property " +
                  std::string (isLong (field.type) ? "double" : namesOf (field.type).ply) + " " +
                  field.name + (field.count > 1 ? "_" + std::to_string (c) : "") + "\n");
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

/// PLY, binary little endian. A field of several values becomes several properties: name_0, name_1,
/// ...
/// \return losses of the format
std::vector<std::string>
writePly (AtomicFile& file, const Cloud& cloud, const Triangles& triangles)
{
  writePlyHeader (file, cloud, triangles);
  writePoints (file, cloud);
  writeTriangles (file, triangles);
  std::vector<std::string> losses;
  for (const Field& field : cloud.fields)
    if (isLong (field.type))
      losses.push_back ("PLY has no 64-bit integers: the field '" + field.name +
                        "' was written as double");
  return losses;
}

} // namespace

std::optional<MeshFormat>
meshFormatOf (const std::filesystem::path& path)
{
  static constexpr std::array<std::pair<const char*, MeshFormat>, 6> KNOWN{
      {{".vtk", MeshFormat::VTK},
       {".ply", MeshFormat::PLY},
       {".obj", MeshFormat::OBJ},
       {".stl", MeshFormat::STL},
       {".off", MeshFormat::OFF},
       {".glb", MeshFormat::GLB}}};
  const std::string extension = lowerExtension (path);
  for (const auto& [known, format] : KNOWN)
    if (extension == known)
      return format;
  return std::nullopt;
}

std::size_t
countMergedInSinglePrecision (const Cloud& cloud, const Triangles& triangles)
{
  const auto corner = [&cloud] (std::uint32_t point) -> Eigen::Vector3f {
    return cloud.position (point).cast<float> ();
  };
  return static_cast<std::size_t> (
      std::count_if (triangles.begin (), triangles.end (), [&] (const auto& triangle) {
        const Eigen::Vector3f a = corner (triangle[0]), b = corner (triangle[1]),
                              c = corner (triangle[2]);
        return a == b || b == c || c == a;
      }));
}

bool
canHaveTexture (MeshFormat format)
{
  return format == MeshFormat::VTK || format == MeshFormat::PLY || format == MeshFormat::OBJ;
}

std::vector<std::string>
writeMesh (AtomicFile& file, const std::filesystem::path& path, const Cloud& cloud,
           const Triangles& triangles, std::optional<MeshFormat> format, const MeshTexture* texture)
{
  if (!format)
    format = meshFormatOf (path);
  if (!format)
    throw WriteError ("cannot write '" + path.string () + "': its extension is unknown; use " +
                      MESH_EXTENSIONS);
  std::vector<std::string> losses;
  if (texture != nullptr && (*format == MeshFormat::VTK || *format == MeshFormat::PLY)) {
    Triangles renumbered = triangles;
    const Cloud doubled = doubleSeamPoints (cloud, *texture, renumbered);
    if (*format == MeshFormat::PLY)
      return writeMesh (file, path, doubled, renumbered, format);
    writeVtk (file, doubled, renumbered, true);
    return losses;
  }
  switch (*format) {
  case MeshFormat::VTK:
    writeVtk (file, cloud, triangles, false);
    break;
  case MeshFormat::PLY:
    losses = writePly (file, cloud, triangles);
    break;
  case MeshFormat::OBJ:
    writeObj (file, cloud, triangles, texture);
    break;
  case MeshFormat::OFF:
    writeOff (file, cloud, triangles);
    break;
  case MeshFormat::STL:
    requireTrianglesInSinglePrecision (path, "STL", cloud, triangles);
    writeStl (file, cloud, triangles);
    break;
  case MeshFormat::GLB:
    requireTrianglesInSinglePrecision (path, "glTF", cloud, triangles);
    writeGlb (file, cloud, triangles);
    break;
  }
  const bool is_single = *format == MeshFormat::STL || *format == MeshFormat::GLB;
  if (is_single && !cloud.single_precision)
    losses.push_back (std::string (*format == MeshFormat::STL ? "STL" : "glTF") +
                      " holds single precision only: the coordinates were rounded; write .vtk or "
                      ".ply to keep them");
  return losses;
}

} // namespace pcl::floater

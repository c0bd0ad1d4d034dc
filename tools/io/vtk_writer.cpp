// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Does not use VTK, because loading its libraries takes longer than reconstructing most clouds. The
// tests read the files back with VTK and PCL.
#include "mesh_writer.h"

#include <algorithm>
#include <cstdio>

namespace pcl::floater {
namespace {
const char*
vtkTypeName (ScalarType type)
{
  switch (type) {
  case ScalarType::INT8:
    return "signed_char";
  case ScalarType::UINT8:
    return "unsigned_char";
  case ScalarType::INT16:
    return "short";
  case ScalarType::UINT16:
    return "unsigned_short";
  case ScalarType::INT32:
    return "int";
  case ScalarType::UINT32:
    return "unsigned_int";
  case ScalarType::INT64:
    return "vtktypeint64";
  case ScalarType::UINT64:
    return "vtktypeuint64";
  case ScalarType::FLOAT32:
    return "float";
  case ScalarType::FLOAT64:
    break;
  }
  return "double";
}

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
              std::to_string (cloud.size ()) + " " + vtkTypeName (field.type) + "\n");
  visitType (field.type, [&] (auto tag) {
    for (std::size_t i = 0; i < cloud.size (); ++i)
      for (std::size_t c = 0; c < field.count; ++c)
        file.writeNumber (field.value<decltype (tag)> (cloud.row (i), c), ByteOrder::BIG);
  });
  file.write ("\n");
}

} // namespace

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
    file.write (std::string ("NORMALS Normals ") + vtkTypeName (normals[0]->type) + "\n");
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

} // namespace pcl::floater

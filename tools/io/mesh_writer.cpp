// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_writer.h"

#include <Eigen/Geometry>

namespace pcl::floater {
namespace {
constexpr const char* COMMENT = "written by pcl_floater_reconstruct";

/// The line of a comment that tells the shift; empty if there is none.
std::string
shiftLine (const char* begin, const Cloud& cloud)
{
  const std::string shift = cloud.shiftText ();
  return shift.empty () ? "" : begin + shift + "\n";
}

/// The numbers of a normal, each after a blank; 0 0 0 if it is not finite.
void
printNormal (AtomicFile& file, const FieldTriple& fields, std::size_t row)
{
  Eigen::Vector3d normal = vectorOf (fields, row);
  if (!normal.allFinite ())
    normal.setZero ();
  visitType (fields[0]->type, [&] (auto tag) {
    for (const double coordinate : normal)
      file.print (" ", static_cast<decltype (tag)> (coordinate));
  });
}

/// Calls write (coordinate) with the coordinates of a point as floats or doubles, as they are written.
template <typename Write>
void
forCoordinates (const Cloud& cloud, std::size_t point, const Write& write)
{
  for (const double coordinate : cloud.position (point))
    if (cloud.single_precision)
      write (static_cast<float> (coordinate));
    else
      write (coordinate);
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
      const auto code = static_cast<unsigned char> (c);
      encoded += {'%', "0123456789ABCDEF"[code >> 4U], "0123456789ABCDEF"[code & 15U]};
    }
  }
  return encoded;
}

template <std::size_t N>
void
writeValues (AtomicFile& file, const std::array<const Field*, N>& fields, const Cloud& cloud)
{
  visitType (fields[0]->type, [&] (auto tag) {
    for (std::size_t i = 0; i < cloud.size (); ++i)
      for (const Field* field : fields)
        for (std::size_t c = 0; c < field->count; ++c)
          file.writeNumber (field->value<decltype (tag)> (cloud.row (i), c), ByteOrder::big);
  });
  file.print ("\n");
}

bool
isLong (ScalarType type)
{
  return type == ScalarType::INT64 || type == ScalarType::UINT64;
}

/// The cloud with as many rows for each point as it has texture coordinates, and these as the
/// fields s and t, of 32 bits: the first of a point in its own row, the others after all points. A
/// point without one has -1. All fields are copied. Triangles are renumbered.
Cloud
doubleSeamPoints (const Cloud& cloud, const TextureCoordinates& texture, Triangles& triangles)
{
  const std::size_t points = cloud.size ();
  std::vector<std::size_t> rows (points);
  for (std::size_t p = 0; p < points; ++p)
    rows[p] = cloud.row (p);
  std::vector<Eigen::Vector2f> places (points, Eigen::Vector2f (-1.0F, -1.0F));
  std::vector<std::uint32_t> number (texture.coordinates.size ()); // of each coordinate
  for (std::size_t c = 0; c < number.size (); ++c) {
    const std::uint32_t point = texture.points[c];
    if (c == 0 || texture.points[c - 1] != point)
      number[c] = point;
    else {
      number[c] = static_cast<std::uint32_t> (rows.size ());
      rows.push_back (rows[point]);
      places.emplace_back ();
    }
    places[number[c]] = texture.coordinates[c];
  }
  for (std::size_t i = 0; i < triangles.size (); ++i)
    for (std::size_t corner = 0; corner < 3; ++corner)
      triangles[i][corner] = number[texture.corners[i][corner]];

  Cloud doubled = copyRows (cloud, rows);
  replaceColumns ({"s", "t"}, ScalarType::FLOAT32, std::move (places), doubled.fields);
  return doubled;
}

} // namespace

/// Wavefront OBJ: points with colours, normals (0 0 0 where they are not finite), and faces.
void
writeObj (AtomicFile& file, const Cloud& cloud, const Triangles& triangles, MeshExtras& extras)
{
  const TextureCoordinates* const texture = extras.texture;
  const FieldTriple colors = cloud.colors ();
  const FieldTriple normals = cloud.normals ();
  file.print ("# ", COMMENT, "\n", shiftLine ("# shift ", cloud));
  if (texture != nullptr)
    file.print ("mtllib ", materialsBeside (extras.path).filename ().string (), "\n");
  for (std::size_t i = 0; i < cloud.size (); ++i) {
    file.print ("v");
    forCoordinates (cloud, i, [&file] (auto number) { file.print (" ", number); });
    if (colors[0])
      for (const double channel : vectorOf (colors, cloud.row (i)))
        file.print (" ", static_cast<float> (channel) / 255.0F);
    file.print ("\n");
  }
  if (normals[0])
    for (std::size_t i = 0; i < cloud.size (); ++i) {
      file.print ("vn");
      printNormal (file, normals, cloud.row (i));
      file.print ("\n");
    }
  if (texture != nullptr) {
    for (const Eigen::Vector2f& uv : texture->coordinates)
      file.print ("vt ", uv.x (), " ", uv.y (), "\n");
    file.print ("usemtl surface\n");
  }
  for (std::size_t t = 0; t < triangles.size (); ++t) {
    file.print ("f");
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint64_t number = triangles[t][i] + std::uint64_t{1};
      file.print (" ", number);
      if (texture != nullptr)
        file.print ("/", texture->corners[t][i] + std::uint64_t{1});
      if (normals[0])
        file.print (texture != nullptr ? "/" : "//", number);
    }
    file.print ("\n");
  }
}

/// Geomview OFF, text: points with colours from 0 to 255, normals (0 0 0 where they are not
/// finite), and faces. Its first word is OFF, COFF, NOFF or CNOFF.
void
writeOff (AtomicFile& file, const Cloud& cloud, const Triangles& triangles, MeshExtras& /*extras*/)
{
  const FieldTriple colors = cloud.colors ();
  const FieldTriple normals = cloud.normals ();
  file.print (colors[0] ? "C" : "", normals[0] ? "N" : "", "OFF\n# ", COMMENT, "\n",
              shiftLine ("# shift ", cloud), cloud.size (), " ", triangles.size (), " 0\n");
  for (std::size_t i = 0; i < cloud.size (); ++i) {
    forCoordinates (cloud, i, [&file] (auto number) { file.print (" ", number); });
    if (normals[0])
      printNormal (file, normals, cloud.row (i));
    if (colors[0]) {
      for (const double channel : vectorOf (colors, cloud.row (i)))
        file.print (" ", channel);
      file.print (" 255"); // opaque
    }
    file.print ("\n");
  }
  for (const auto& [a, b, c] : triangles)
    file.print ("3 ", a, " ", b, " ", c, "\n");
}

/// Binary STL: triangles in single precision, nothing else.
void
writeStl (AtomicFile& file, const Cloud& cloud, const Triangles& triangles, MeshExtras& /*extras*/)
{
  constexpr std::size_t HEADER = 80; // bytes; must not begin with "solid"
  std::string header = COMMENT;
  header.resize (HEADER, ' ');
  file.write (header);
  file.writeNumber (static_cast<std::uint32_t> (triangles.size ()));
  for (const auto& [a, b, c] : triangles) {
    const Eigen::Vector3d p = cloud.position (a), q = cloud.position (b), r = cloud.position (c);
    for (const Eigen::Vector3d& vector : {(q - p).cross (r - p).normalized ().eval (), p, q, r})
      writeNumbers (file, vector.cast<float> ().eval ());
    file.writeNumber (std::uint16_t{0});
  }
}

/// Legacy VTK 3.0, binary, polydata. Colours are unsigned char scalars named "RGB", which viewers
/// show unchanged and PCL reads by that name; normals are point normals; other fields are arrays.
/// With a texture, its coordinates are the float fields s and t.
/// Does not use VTK, because loading its libraries takes longer than reconstructing most clouds. The
/// tests read the files back with VTK and PCL.
void
writeVtk (AtomicFile& file, const Cloud& cloud, const Triangles& triangles, MeshExtras& extras)
{
  const bool with_texture = extras.texture != nullptr;
  const std::string shift = cloud.shiftText ();
  file.print ("# vtk DataFile Version 3.0\n", COMMENT, shift.empty () ? "" : ", shift ", shift,
              "\nBINARY\nDATASET POLYDATA\nPOINTS ", cloud.size (),
              cloud.single_precision ? " float\n" : " double\n");
  for (std::size_t i = 0; i < cloud.size (); ++i)
    forCoordinates (cloud, i, [&file] (auto number) { file.writeNumber (number, ByteOrder::big); });
  file.print ("\nPOLYGONS ", triangles.size (), " ", 4 * triangles.size (), "\n");
  for (const auto& [a, b, c] : triangles)
    for (const std::uint32_t number : {std::uint32_t{3}, a, b, c})
      file.writeNumber (number, ByteOrder::big);
  file.print ("\n");

  const FieldTriple colors = cloud.colors ();
  const FieldTriple normals = cloud.normals ();
  const std::array<const Field*, 2> texture{with_texture ? cloud.find ("s") : nullptr,
                                            with_texture ? cloud.find ("t") : nullptr};
  std::vector<const Field*> others;
  for (const Field& field : cloud.fields)
    if (std::find (texture.begin (), texture.end (), &field) == texture.end () &&
        std::find (colors.begin (), colors.end (), &field) == colors.end () &&
        std::find (normals.begin (), normals.end (), &field) == normals.end ())
      others.push_back (&field);
  if (!cloud.fields.empty ())
    file.print ("POINT_DATA ", cloud.size (), "\n");
  if (colors[0]) {
    file.print ("COLOR_SCALARS RGB 3\n");
    writeValues (file, colors, cloud);
  }
  if (normals[0]) {
    file.print ("NORMALS Normals ", namesOf (normals[0]->type).vtk, "\n");
    writeValues (file, normals, cloud);
  }
  if (with_texture) {
    file.print ("TEXTURE_COORDINATES TCoords 2 float\n");
    writeValues (file, texture, cloud);
  }
  if (!others.empty ())
    file.print ("FIELD FieldData ", others.size (), "\n");
  for (const Field* field : others) {
    file.print (encodeName (field->name), " ", field->count, " ", cloud.size (), " ",
                namesOf (field->type).vtk, "\n");
    writeValues<1> (file, {field}, cloud);
  }
}

/// PLY, binary little endian. A field of several values becomes several properties: name_0, name_1,
/// ...
void
writePly (AtomicFile& file, const Cloud& cloud, const Triangles& triangles, MeshExtras& extras)
{
  file.print ("ply\nformat binary_little_endian 1.0\ncomment ", COMMENT, "\n",
              shiftLine ("comment shift ", cloud), "element vertex ", cloud.size (), "\n");
  for (const char* axis : {"x", "y", "z"})
    file.print ("property ", cloud.single_precision ? "float " : "double ", axis, "\n");
  for (const Field& field : cloud.fields) {
    for (std::size_t c = 0; c < field.count; ++c)
      file.print ("property ", isLong (field.type) ? "double" : namesOf (field.type).ply, " ",
                  field.name, field.count > 1 ? "_" + std::to_string (c) : "", "\n");
    if (isLong (field.type))
      extras.losses.push_back ("PLY has no 64-bit integers: the field '" + field.name +
                               "' was written as double");
  }
  file.print ("element face ", triangles.size (),
              "\nproperty list uchar int vertex_indices\nend_header\n");
  for (std::size_t i = 0; i < cloud.size (); ++i) {
    forCoordinates (cloud, i, [&file] (auto number) { file.writeNumber (number); });
    for (const Field& field : cloud.fields)
      visitType (field.type, [&] (auto value) {
        for (std::size_t c = 0; c < field.count; ++c) {
          value = field.value<decltype (value)> (cloud.row (i), c);
          if (isLong (field.type))
            file.writeNumber (static_cast<double> (value));
          else
            file.writeNumber (value);
        }
      });
  }
  for (const auto& triangle : triangles) {
    file.writeNumber (std::uint8_t{3});
    writeNumbers (file, triangle);
  }
}

std::vector<std::string>
writeMesh (const std::filesystem::path& path, const Cloud& cloud, const Triangles& triangles,
           MeshFormat format, OutputFiles& files, const TextureCoordinates* texture)
{
  const char* const single = format == writeStl ? "STL" : format == writeGlb ? "glTF" : nullptr;
  if (single != nullptr)
    if (const std::size_t lost = countMergedInSinglePrecision (cloud, triangles))
      throw WriteError ("cannot write '" + path.string () + "': " + single +
                        " holds 32-bit floats, in which " + std::to_string (lost) + " of " +
                        std::to_string (triangles.size ()) +
                        " triangles have two equal corners; subtract an origin with --shift, or "
                        "write .vtk, .ply, .obj or .off");
  AtomicFile& file = files.emplace_back (path);
  MeshExtras extras{path, texture};
  if (texture != nullptr && format != writeObj) {
    Triangles renumbered = triangles;
    format (file, doubleSeamPoints (cloud, *texture, renumbered), renumbered, extras);
  }
  else
    format (file, cloud, triangles, extras);
  if (single != nullptr && !cloud.single_precision)
    extras.losses.push_back (std::string (single) +
                             " holds single precision only: the coordinates were "
                             "rounded; write .vtk or .ply to keep them");
  file.close ();
  return std::move (extras.losses);
}

} // namespace pcl::floater

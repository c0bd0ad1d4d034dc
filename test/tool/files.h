// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A small cloud with colours, normals and intensities, and files of it; LAS files from the
// specification and from nothing of the reader. Reads meshes back, where it can be with the
// libraries that users would use, PCL and VTK.
#pragma once

#include "cloud.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace pcl::floater {
using Color = std::array<std::uint8_t, 3>;

/// Points of a wavy square in random order.
struct Sample
{
  bool is_double = false;
  std::vector<Eigen::Vector3d> points;
  std::vector<Color> colors;
  std::vector<Eigen::Vector3f> normals;
  std::vector<float> intensities;

  std::size_t size () const { return points.size (); }
};

/// Makes side * side points. In single precision every coordinate is a float. In double precision
/// the points are centimetres apart at map coordinates of a million metres, where floats could not
/// tell them apart.
Sample
makeSample (bool is_double, int side = 12);

enum class PcdKind
{
  ASCII,
  BINARY,
  COMPRESSED
};

/// The kinds that the tool reads: those that are compressed only where it was built with liblzf.
#ifdef PCL_FLOATER_HAS_LZF
constexpr bool READS_COMPRESSED = true;
#else
constexpr bool READS_COMPRESSED = false;
#endif
inline std::vector<PcdKind>
readPcdKinds ()
{
  std::vector<PcdKind> kinds{PcdKind::ASCII, PcdKind::BINARY};
  if (READS_COMPRESSED)
    kinds.push_back (PcdKind::COMPRESSED);
  return kinds;
}

/// The names of its fields.
inline std::vector<std::string>
namesOf (const Cloud& cloud)
{
  std::vector<std::string> names;
  for (const Field& field : cloud.fields)
    names.push_back (field.name);
  return names;
}

/// Writes a PCD file with PCL's own writer: x y z, rgb, normals, intensity.
void
writePcd (const std::string& path, const Sample& sample, PcdKind kind);

enum class PlyKind
{
  ASCII,
  LITTLE,
  BIG
};

/// A PLY file: x y z, intensity, and unless it is plain red green blue and nx ny nz, with an element
/// before the vertices, a list among their properties, and a face.
std::string
plyText (const Sample& sample, PlyKind kind, bool is_plain = false);

/// An OBJ file: points with colours, normals, a face.
std::string
objText (const Sample& sample);

/// A PCD file of ASCII numbers: x y z only.
std::string
pcdText (const std::vector<Eigen::Vector3d>& points);

/// What a LAS file is made of.
struct LasFile
{
  int minor = 2;  ///< version 1.minor
  int format = 0; ///< of the points
  Eigen::Vector3d scale{0.01, 0.01, 0.01};
  Eigen::Vector3d offset{0.0, 0.0, 0.0};
  std::vector<std::array<std::int32_t, 3>> points;  ///< before scale and offset
  std::vector<std::array<std::uint16_t, 3>> colors; ///< one for each point, or none
  std::size_t extra_bytes = 0;                      ///< after each point
  std::size_t variable_records = 0;                 ///< between the header and the points
};

/// The bytes of the file. The intensity of point i is 7 * i.
std::string
lasBytes (const LasFile& file);

/// Puts a little-endian number into bytes.
template <typename T>
void
putNumber (std::string& bytes, std::size_t at, T number)
{
  const auto* const from = reinterpret_cast<const char*> (&number);
  for (std::size_t i = 0; i < sizeof (T); ++i)
    bytes.at (at + i) = from[i]; // on the machines of the tests
}

/// What the file of a mesh holds.
struct MeshContent
{
  bool is_double = false;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::size_t, 3>> triangles;
  std::vector<Color> colors;
  std::vector<Eigen::Vector3f> normals;
  std::map<std::string, std::vector<double>> fields; ///< all others

  std::vector<Eigen::Vector2d> coordinates;        ///< of a texture, in VTK and OBJ files
  std::vector<std::array<std::size_t, 3>> corners; ///< their indices for each triangle of OBJ
  std::string material_file, material;             ///< of OBJ
};

/// Reads a file by the reader for its extension: VTK's for .vtk, .stl (no points are merged) and
/// .glb, the tool's for .ply, and readers of the tests for .obj and .off.
MeshContent
readMesh (const std::string& path);

/// A mesh of PLY or VTK as most programs with PCL read it: pcl::io::loadPLYFile or, as pcl_viewer,
/// loadPolygonFileVTK, then pcl::fromPCLPointCloud2 into points of floats.
MeshContent
loadWithPcl (const std::string& path);

} // namespace pcl::floater

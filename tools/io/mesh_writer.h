// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Writes triangle meshes whose vertices are the points of a cloud: VTK, PLY, OBJ, STL, OFF, GLB.
#pragma once

#include "atomic_file.h"
#include "mesh_texture.h"

namespace pcl::floater {
/// What some formats have beside the points and the triangles, and what they lose.
struct MeshExtras
{
  std::filesystem::path path;        ///< of the file
  const TextureCoordinates* texture; ///< nullptr: none are written
  std::vector<std::string> losses{}; ///< of the format, one sentence each
};

/// Writes a mesh in one format. Of STL and GLB, coordinates are in single precision.
/// \throws WriteError
using MeshWriter = void (AtomicFile& file, const Cloud& cloud, const Triangles& triangles,
                         MeshExtras& extras);

MeshWriter writeVtk, writePly, writeObj, writeStl, writeOff, writeGlb;

using MeshFormat = MeshWriter*;

/// Their names, which are their extensions as well.
constexpr std::pair<const char*, MeshFormat> MESH_FORMATS[] = {
    {"auto", nullptr}, {"vtk", writeVtk}, {"ply", writePly}, {"obj", writeObj},
    {"stl", writeStl}, {"off", writeOff}, {"glb", writeGlb}};

constexpr const char* MESH_EXTENSIONS = ".vtk, .ply, .obj, .stl, .off or .glb";

/// The format that the extension of a file tells, in upper or lower case; nullptr if it is unknown.
inline MeshFormat
meshFormatOf (const std::filesystem::path& path)
{
  return formatOf (path, MESH_FORMATS);
}

/// Writes the mesh under a temporary name. All coordinates must be finite. All formats but STL tell
/// the shift in a comment. As far as the format allows, vertex k is point k of the cloud with all
/// its fields, and every number reads back exactly.
/// \param texture not for STL, OFF and GLB; if it is not nullptr, the texture coordinates are written
///   as well: as vt of OBJ, s and t of PLY, TCoords of VTK. In PLY and VTK, points on seams are
///   doubled (doubleSeamPoints)
/// \return losses of the format, one sentence each
/// \throws WriteError
std::vector<std::string>
writeMesh (const std::filesystem::path& path, const Cloud& cloud, const Triangles& triangles,
           MeshFormat format, OutputFiles& files, const TextureCoordinates* texture = nullptr);

/// Numbers of a vector or of a triangle, little endian.
template <typename Numbers>
void
writeNumbers (AtomicFile& file, const Numbers& numbers)
{
  for (const auto number : numbers)
    file.writeNumber (number);
}

/// Number of triangles of which 32-bit floats make two corners one: readers may merge those.
inline std::size_t
countMergedInSinglePrecision (const Cloud& cloud, const Triangles& triangles)
{
  std::size_t count = 0;
  for (const auto& triangle : triangles) {
    std::array<Eigen::Vector3f, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = cloud.position (triangle[i]).cast<float> ();
    const auto& [a, b, c] = corners;
    count += a == b || b == c || c == a ? 1 : 0;
  }
  return count;
}

} // namespace pcl::floater

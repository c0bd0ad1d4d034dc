// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Writes triangle meshes whose vertices are the points of a cloud: VTK, PLY, OBJ, STL.
#pragma once

#include "atomic_file.h"
#include "cloud.h"
#include "mesh_texture.h"

namespace pcl
{
namespace floater
{
/// Whether meshes can be written to files with this extension: .vtk, .ply, .obj, .stl, in any case.
bool
isMeshFile (const std::filesystem::path& path);

/// Writes the mesh in the format given by the extension of `path`. All coordinates must be finite.
/// All formats but STL tell the shift in a comment. As far as the format allows, vertex k is point
/// k of the cloud with all its fields, and every number reads back exactly. \param path only its
/// extension is used; the bytes are written to `file` \return losses of the format, one sentence
/// each \throws WriteError
/// \param texture if it is not nullptr, the texture coordinates are written as well: as vt of OBJ,
/// s and t of PLY, TCoords of VTK. In PLY and VTK, points on seams are doubled (doubleSeamPoints)
std::vector<std::string>
writeMesh (AtomicFile& file, const std::filesystem::path& path, const Cloud& cloud,
           const Triangles& triangles, const MeshTexture* texture = nullptr);

/// Whether meshes with this extension can have texture coordinates: .vtk, .ply, .obj, in any case.
bool
canHaveTexture (const std::filesystem::path& path);

/// Legacy VTK 3.0, binary, polydata. Colours are unsigned char scalars named "RGB", which viewers
/// show unchanged and PCL reads by that name; normals are point normals; other fields are arrays.
/// \param with_texture the float fields s and t are texture coordinates
void
writeVtk (AtomicFile& file, const Cloud& cloud, const Triangles& triangles,
          bool with_texture = false);

/// PLY, binary little endian. A field of several values becomes several properties: name_0, name_1,
/// ... \return names of the 64-bit integer fields, which are written as double, because PLY has no
/// type for them
std::vector<std::string>
writePly (AtomicFile& file, const Cloud& cloud, const Triangles& triangles);

/// Wavefront OBJ: points with colours, normals (0 0 0 where they are not finite), and faces.
void
writeObj (AtomicFile& file, const Cloud& cloud, const Triangles& triangles,
          const MeshTexture* texture = nullptr);

/// Binary STL: triangles in single precision, nothing else.
void
writeStl (AtomicFile& file, const Cloud& cloud, const Triangles& triangles);

} // namespace floater
} // namespace pcl

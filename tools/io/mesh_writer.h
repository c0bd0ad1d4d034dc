// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Writes triangle meshes whose vertices are the points of a cloud: VTK, PLY, OBJ, STL.
#pragma once

#include "atomic_file.h"
#include "cloud.h"

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
std::vector<std::string>
writeMesh (AtomicFile& file, const std::filesystem::path& path, const Cloud& cloud,
           const Triangles& triangles);

/// Legacy VTK 3.0, binary, polydata. Colours are unsigned char scalars named "RGB", which viewers
/// show unchanged and PCL reads by that name; normals are point normals; other fields are arrays.
void
writeVtk (AtomicFile& file, const Cloud& cloud, const Triangles& triangles);

/// PLY, binary little endian. A field of several values becomes several properties: name_0, name_1,
/// ... \return names of the 64-bit integer fields, which are written as double, because PLY has no
/// type for them
std::vector<std::string>
writePly (AtomicFile& file, const Cloud& cloud, const Triangles& triangles);

/// Wavefront OBJ: points with colours, normals (0 0 0 where they are not finite), and faces.
void
writeObj (AtomicFile& file, const Cloud& cloud, const Triangles& triangles);

/// Binary STL: triangles in single precision, nothing else.
void
writeStl (AtomicFile& file, const Cloud& cloud, const Triangles& triangles);

} // namespace floater
} // namespace pcl

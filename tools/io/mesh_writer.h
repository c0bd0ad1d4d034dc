// SPDX-License-Identifier: GPL-3.0-or-later
// Writes triangle meshes whose vertices are the points of a cloud: VTK, PLY, OBJ, STL.
#pragma once

#include "atomic_file.h"
#include "cloud.h"

namespace pcl
{
namespace floater
{
/// True if meshes are written to files with this extension (.vtk, .ply, .obj, .stl; case does not
/// matter).
bool
isMeshFile (const std::filesystem::path& path);

/// Writes the mesh in the format that the extension of `path` tells. All coordinates must be
/// finite. Where the format can hold it, vertex k is point k of the cloud with all its fields, and
/// every number reads back as the same bits. \param path only its extension counts; the bytes go to
/// `file` \return what the format could not hold, one sentence each \throws WriteError
std::vector<std::string>
writeMesh (AtomicFile& file, const std::filesystem::path& path, const Cloud& cloud,
           const Triangles& triangles);

/// Legacy VTK 3.0, binary, polydata. Colours are the unsigned char scalars "RGB", which viewers
/// show as they are and PCL knows by that name; normals are point normals; other fields are arrays.
void
writeVtk (AtomicFile& file, const Cloud& cloud, const Triangles& triangles);

/// PLY, binary little endian. A field of several values becomes as many properties, name_0 and so
/// on. \return the names of 64-bit integer fields, which PLY has no type for: they are written as
/// double
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

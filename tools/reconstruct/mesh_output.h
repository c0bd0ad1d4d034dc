// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is written beside the triangles: normals, texture coordinates, the texture and its materials.
#pragma once

#include "command_line.h"

#include <pcl/surface/floater/reconstruct.h>
#include <pcl/surface/floater/texture_coordinates.h>

#include <vector>

namespace pcl::floater {
/// Gives the cloud the fields nx, ny and nz of 32-bit floats, with the normals of the vertices of
/// the mesh (see vertexNormals ()), in place of those that it has. All points must be left.
void
replaceNormals (Cloud& cloud, const Triangles& triangles, int threads);

/// Checks what the command line asks for.
/// \throws UsageError
void
checkTextureOptions (const CommandLine& line);

/// \throws UsageError if the points have no colours for the texture that is asked for
void
checkTextureColours (const CommandLine& line, const Cloud& cloud);

/// Computes the coordinates that are asked for. If that fails, the result has no mesh any more, and
/// says why.
TextureCoordinates
computeTexture (const CommandLine& line, const Cloud& cloud, Result& result);

/// Writes the file of materials of an OBJ file and the image, under temporary names.
/// \return what is odd about them, one sentence each
std::vector<std::string>
stageTexture (const CommandLine& line, const Cloud& cloud, const Triangles& triangles,
              const TextureCoordinates& texture, OutputFiles& files);

/// The file of materials of an OBJ file, beside it.
std::filesystem::path
materialsOf (const CommandLine& line);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads point clouds: PCD, PLY, OBJ.
//
// PCL's own readers would do for most files. But they read a word that is no number as 0 without an
// error, round the coordinates of OBJ to single precision, and need 2 s for a million points in
// ASCII PLY or OBJ, against 0.2 s here. And libpcl_io loads VTK, which costs every start 20 ms and
// 20 MB.
#pragma once

#include "cloud.h"

#include <filesystem>

namespace pcl
{
namespace floater
{
/// Whether clouds can be read from files with this extension: .pcd, .ply, .obj, in any case.
bool
isCloudFile (const std::filesystem::path& path);

/// Reads a cloud in the format given by the extension. The fields of uncompressed binary files stay
/// in the mapped file.
/// \param all_digits read the coordinates of text files as doubles, also where the file says float;
/// Cloud::single_precision is as the file says
/// \throws ReadError if the file is not a complete and valid cloud
Cloud
readCloud (const std::filesystem::path& path, bool all_digits = false);

/// PCD of version 0.7 and older: ascii, binary, binary_compressed. Padding fields ("_") are
/// skipped. The origin of the viewpoint is read; coordinates are not transformed.
Cloud
parsePcd (const FileBytes& file, bool all_digits = false);

/// PLY, ascii and binary in both byte orders: the element "vertex", without its list properties.
/// Elements after it are ignored.
Cloud
parsePly (const FileBytes& file, bool all_digits = false);

/// Wavefront OBJ: lines "v x y z", "v x y z w" or "v x y z r g b" (colours from 0 to 1). Normals
/// are read if there are as many "vn" as "v" lines. All other lines are ignored.
Cloud
parseObj (const FileBytes& file);

} // namespace floater
} // namespace pcl

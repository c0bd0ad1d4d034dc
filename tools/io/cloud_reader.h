// SPDX-License-Identifier: GPL-3.0-or-later
// Reads point clouds: PCD, PLY, OBJ.
//
// PCL's own readers would do for most files, but they take words for the number 0 without a word,
// round the coordinates of OBJ to single precision, need 2 s for a million points in ASCII PLY or
// OBJ (this one 0.2 s), and libpcl_io loads VTK, which makes every start 20 ms of CPU time and 20
// MB dearer.
#pragma once

#include "cloud.h"

#include <filesystem>

namespace pcl
{
namespace floater
{
/// True if clouds are read from files with this extension (.pcd, .ply, .obj; case does not matter).
bool
isCloudFile (const std::filesystem::path& path);

/// Reads a cloud; the extension tells the format. Of binary files that are not compressed the
/// fields stay where they are, in the mapped file.
/// \throws ReadError with the cause if the file is not a whole and valid cloud
Cloud
readCloud (const std::filesystem::path& path);

/// PCD of version 0.7 and older: ascii, binary, binary_compressed. Padding fields ("_") are
/// skipped. The viewpoint is ignored: coordinates are taken as they stand.
Cloud
parsePcd (const FileBytes& file);

/// PLY, ascii and binary of both byte orders: the element "vertex". What follows it is ignored;
/// lists among its properties are left out.
Cloud
parsePly (const FileBytes& file);

/// Wavefront OBJ: lines "v x y z", "v x y z w" or "v x y z r g b" (colours from 0 to 1). Normals
/// are taken if there are as many "vn" as "v" lines. All else is ignored.
Cloud
parseObj (const FileBytes& file);

} // namespace floater
} // namespace pcl

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud_reader.h"

#include "format.h"

namespace pcl
{
namespace floater
{
bool
isCloudFile (const std::filesystem::path& path)
{
  const std::string extension = lowerExtension (path);
  return extension == ".pcd" || extension == ".ply" || extension == ".obj";
}

Cloud
readCloud (const std::filesystem::path& path, bool all_digits)
{
  const FileBytes file (path);
  if (file.view ().empty ())
    throw ReadError ("the file is empty");
  const std::string extension = lowerExtension (path);
  if (extension == ".pcd")
    return parsePcd (file, all_digits);
  if (extension == ".ply")
    return parsePly (file, all_digits);
  if (extension == ".obj")
    return parseObj (file);
  throw ReadError ("its extension '" + extension + "' is unknown; use .pcd, .ply or .obj");
}

} // namespace floater
} // namespace pcl

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud_reader.h"

#include "format.h"

namespace pcl::floater {
std::optional<CloudFormat>
cloudFormatOf (const std::filesystem::path& path)
{
  static constexpr std::array<std::pair<const char*, CloudFormat>, 10> KNOWN{
      {{".pcd", CloudFormat::PCD},
       {".ply", CloudFormat::PLY},
       {".obj", CloudFormat::OBJ},
       {".stl", CloudFormat::STL},
       {".las", CloudFormat::LAS},
       {".xyz", CloudFormat::XYZ},
       {".txt", CloudFormat::XYZ},
       {".csv", CloudFormat::XYZ},
       {".asc", CloudFormat::XYZ},
       {".pts", CloudFormat::PTS}}};
  const std::string extension = lowerExtension (path);
  for (const auto& [known, format] : KNOWN)
    if (extension == known)
      return format;
  return std::nullopt;
}

Cloud
readCloud (const std::filesystem::path& path, bool all_digits)
{
  const std::optional<CloudFormat> format = cloudFormatOf (path);
  if (lowerExtension (path) == ".laz")
    throw ReadError (LAZ_ADVICE);
  if (!format)
    throw ReadError ("its extension '" + lowerExtension (path) + "' is unknown; use " +
                     CLOUD_EXTENSIONS);
  return readCloud (path, *format, all_digits);
}

Cloud
readCloud (const std::filesystem::path& path, CloudFormat format, bool all_digits)
{
  const FileBytes file = isStandardStream (path) ? FileBytes::standardInput () : FileBytes (path);
  if (file.view ().empty ())
    throw ReadError (isStandardStream (path) ? "nothing came from the standard input"
                                             : "the file is empty");
  switch (format) {
  case CloudFormat::PCD:
    return parsePcd (file, all_digits);
  case CloudFormat::PLY:
    return parsePly (file, all_digits);
  case CloudFormat::OBJ:
    return parseObj (file);
  case CloudFormat::STL:
    return parseStl (file);
  case CloudFormat::LAS:
    return parseLas (file);
  case CloudFormat::XYZ:
  case CloudFormat::PTS:
    break;
  }
  return parseTable (file, format == CloudFormat::PTS);
}

} // namespace pcl::floater

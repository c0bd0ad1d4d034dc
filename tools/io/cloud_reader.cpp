// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud_reader.h"

#include "format.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

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

std::string
readFile (const std::filesystem::path& path)
{
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status (path, error);
  if (status.type () == std::filesystem::file_type::not_found)
    throw ReadError ("there is no such file; check its name");
  if (std::filesystem::is_directory (status))
    throw ReadError ("it is a folder, not a file");
  const std::unique_ptr<std::FILE, int (*) (std::FILE*)> file (std::fopen (path.c_str (), "rb"),
                                                               &std::fclose);
  if (!file)
    throw ReadError (std::strerror (errno));
  // The size is only a hint: pipes have none.
  const std::uintmax_t hint = std::filesystem::file_size (path, error);
  std::string bytes;
  std::size_t used = 0;
  bytes.resize (error ? 0 : static_cast<std::size_t> (hint));
  for (;;) {
    used += std::fread (bytes.data () + used, 1, bytes.size () - used, file.get ());
    if (std::ferror (file.get ()) != 0)
      throw ReadError (std::strerror (errno));
    if (used < bytes.size ())
      break;
    const int next = std::fgetc (file.get ());
    if (next == EOF)
      break;
    constexpr std::size_t FEWEST = 65536;
    bytes.resize (std::max (FEWEST, 2 * used));
    bytes[used++] = static_cast<char> (next);
  }
  if (std::ferror (file.get ()) != 0)
    throw ReadError (std::strerror (errno));
  bytes.resize (used);
  return bytes;
}

Cloud
readCloud (const std::filesystem::path& path)
{
  const std::string bytes = readFile (path);
  if (bytes.empty ())
    throw ReadError ("the file is empty");
  const std::string extension = lowerExtension (path);
  if (extension == ".pcd")
    return parsePcd (bytes);
  if (extension == ".ply")
    return parsePly (bytes);
  if (extension == ".obj")
    return parseObj (bytes);
  throw ReadError ("its extension '" + extension + "' is unknown; use .pcd, .ply or .obj");
}

} // namespace floater
} // namespace pcl

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "check_paths.h"

#include "atomic_file.h"
#include "cloud_reader.h"
#include "format.h"
#include "mesh_writer.h"
#include "texture_output.h"

namespace pcl
{
namespace floater
{
namespace
{
/// Whether two paths name the same file, which need not exist.
bool
areSame (const std::filesystem::path& a, const std::filesystem::path& b)
{
  std::error_code error;
  if (std::filesystem::equivalent (a, b, error) && !error)
    return true;
  // weakly_canonical would leave a relative path as it is if no part of it exists.
  const auto full = [&error] (const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical (std::filesystem::absolute (path), error);
  };
  return full (a) == full (b);
}

} // namespace

void
checkPaths (const CommandLine& line)
{
  if (!isCloudFile (line.input))
    throw ReadError ("its extension '" + lowerExtension (line.input) +
                     "' is unknown; use .pcd, .ply or .obj");
  struct Named
  {
    const char* name;
    const std::filesystem::path* path;
    bool is_output;
  };
  const std::filesystem::path materials = materialsOf (line);
  const std::array<Named, 7> all{{{"INPUT", &line.input, false},
                                  {"--loop", &line.loop, false},
                                  {"OUTPUT", &line.output, true},
                                  {"--parameterization", &line.parameterization, true},
                                  {"--report", &line.report, true},
                                  {"the file of materials", &materials, true},
                                  {"--texture", &line.texture, true}}};
  for (std::size_t i = 0; i < all.size (); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (all[i].is_output && !all[i].path->empty () && !all[j].path->empty () &&
          areSame (*all[i].path, *all[j].path))
        throw UsageError (std::string (all[j].name) + " and " + all[i].name +
                          " are the same file, '" + all[i].path->string () +
                          "'; give different ones");
  for (const std::filesystem::path* path : {&line.output, &line.parameterization})
    if (!path->empty () && !isMeshFile (*path))
      throw WriteError ("cannot write '" + path->string () + "': its extension '" +
                        lowerExtension (*path) + "' is unknown; use .vtk, .ply, .obj or .stl");
  for (const Named& named : all)
    if (named.is_output && !named.path->empty ())
      requireWritable (*named.path);
}

} // namespace floater
} // namespace pcl

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "check_paths.h"

#include "atomic_file.h"
#include "cloud_reader.h"
#include "format.h"
#include "mesh_writer.h"
#include "texture_output.h"

#include <utility>

namespace pcl::floater {
namespace {
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

std::string
unknownExtension (const std::filesystem::path& path)
{
  const std::string extension = lowerExtension (path);
  return extension.empty () ? "it has no extension that tells its format"
                            : "its extension '" + extension + "' is unknown";
}

} // namespace

void
checkPaths (const CommandLine& line)
{
  if (!line.cloudFormat ()) {
    if (isStandardStream (line.input))
      throw UsageError ("INPUT is the standard input: give its format by --input-format, such as "
                        "--input-format pcd");
    if (lowerExtension (line.input) == ".laz")
      throw ReadError (LAZ_ADVICE);
    throw ReadError (unknownExtension (line.input) + "; use " + CLOUD_EXTENSIONS +
                     ", or give its format by --input-format");
  }
  for (const auto& [name, path] :
       {std::pair ("--report", &line.report), std::pair ("--loop", &line.loop),
        std::pair ("--parameterization", &line.parameterization)})
    if (isStandardStream (*path))
      throw UsageError (std::string (name) + " takes the name of a file, not -");
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
          !isStandardStream (*all[i].path) && !isStandardStream (*all[j].path) &&
          areSame (*all[i].path, *all[j].path))
        throw UsageError (std::string (all[j].name) + " and " + all[i].name +
                          " are the same file, '" + all[i].path->string () +
                          "'; give different ones");
  if (!line.meshFormat () && isStandardStream (line.output))
    throw UsageError ("OUTPUT is the standard output: give its format by --output-format, such as "
                      "--output-format ply");
  if (!line.meshFormat ())
    throw WriteError ("cannot write '" + line.output.string () +
                      "': " + unknownExtension (line.output) + "; use " + MESH_EXTENSIONS +
                      ", or give its format by --output-format");
  if (!line.parameterization.empty () && !meshFormatOf (line.parameterization))
    throw WriteError ("cannot write '" + line.parameterization.string () + "': " +
                      unknownExtension (line.parameterization) + "; use " + MESH_EXTENSIONS);
  for (const Named& named : all)
    if (named.is_output && !named.path->empty ())
      requireWritable (*named.path);
}

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "command_line.h"

#include "option_table.h"
#include "options/check_options.h"
#include "scratch_arrays.h"

#include <cstdio>
#include <new>

namespace pcl::floater {
int
guarded (const char* program, const char* if_no_memory, const std::function<int ()>& work,
         std::string* to)
{
  int code = EXIT_INTERNAL;
  std::string message;
  try {
    return work ();
  }
  catch (const ToolError& error) {
    code = error.code;
    message = std::string (error.what ()) + (code == EXIT_USAGE ? "\nTry --help." : "");
  }
  catch (const ReadError& error) {
    code = EXIT_INPUT;
    message = error.what ();
  }
  catch (const WriteError& error) {
    code = EXIT_OUTPUT;
    message = error.what ();
  }
  catch (const std::bad_alloc&) {
    message = scratchFailure ();
    if (message.empty ())
      message = std::string ("not enough memory; ") + if_no_memory;
  }
  catch (const std::exception& error) {
    message = std::string ("unexpected error: ") + error.what ();
  }
  if (to != nullptr)
    *to = message;
  else
    std::fprintf (stderr, "%s: %s\n", program, printable (message).c_str ());
  return code;
}

std::vector<std::uint32_t>
readLoop (const std::filesystem::path& path)
{
  std::string text (FileBytes (path).view ());
  std::replace (text.begin (), text.end (), ',', ' ');
  std::vector<std::uint32_t> loop;
  TextScanner scanner (text);
  while (scanner.nextLine ())
    for (std::string_view word = scanner.word (); !word.empty () && word.front () != '#';
         word = scanner.word ())
      if (!parseNumber (word, loop.emplace_back ()))
        scanner.fail ("'" + std::string (word) + "' is not the index of a point");
  if (loop.empty ())
    throw ReadError ("it has no indices of points");
  return loop;
}

namespace {
void
checkTextureOptions (const CommandLine& line)
{
  const std::optional<MeshFormat> format = line.meshFormat ();
  if (line.texture_coordinates &&
      (format == MeshFormat::STL || format == MeshFormat::OFF || format == MeshFormat::GLB))
    throw UsageError ("STL, OFF and GLB are written without texture coordinates; write .vtk, .ply "
                      "or .obj, or leave --uv and --texture out");
  if (line.texture_coordinates && format == MeshFormat::OBJ && isStandardStream (line.output))
    throw UsageError ("the file of materials beside an OBJ file has no place on the standard "
                      "output; write .ply or .vtk there, or leave --uv and --texture out");
  if (!line.texture.empty () && lowerExtension (line.texture) != ".png")
    throw UsageError ("--texture: '" + line.texture.string () +
                      "' is no PNG file; give a name that ends with .png");
  if (line.texture_size != 0 && line.texture.empty ())
    throw UsageError ("--texture-size is of no use without --texture");
  if (line.texture_coordinates && line.max_memory > 0)
    throw UsageError (
        "--max-memory cannot limit the memory of --uv and --texture; leave one of them out");
}

void
checkMemoryLimit (CommandLine& line)
{
  if (line.max_memory == 0) {
    if (!line.scratch.empty ())
      throw UsageError ("--scratch is of no use without --max-memory");
    return;
  }
  // The solver allocates the factors of the linear system itself, and they are the larger part.
  if (line.options.topology == Topology::DISC)
    throw UsageError (
        "--max-memory cannot limit the memory for the linear system of a disc; use it with "
        "--topology surface or auto, and without --loop and --parameterization");
  if (!line.html.empty ())
    throw UsageError ("--max-memory cannot limit the memory of --html; leave one of them out");
  if (line.scratch.empty ())
    line.scratch = line.output.has_parent_path () ? line.output.parent_path () : ".";
}

// Warns of options that were given, and that the method of TW 385 sets otherwise.
void
warnOfUnpublished (const CLI::App& app, const Options& given, const Options& effective,
                   std::vector<std::string>& warnings)
{
  std::string names;
  std::size_t count = 0;
  const OptionValues before (given), after (effective);
  for (std::size_t i = 0; i < before.rows.size (); ++i) {
    const std::string name = toolName (before.rows[i].name);
    if (before.values[i] != after.values[i] && app.count (name) > 0) {
      names += (count == 0 ? "" : ", ") + name;
      ++count;
    }
  }
  if (count > 0)
    warnings.push_back ((count == 1 ? "an option has no effect: " : "options have no effect: ") +
                        names + "; --method tw385 is that report and nothing else");
}

} // namespace

std::optional<int>
parseCommandLine (int argc, char** argv, CommandLine& command_line)
{
  CLI::App app ("", command_line.program);
  const std::vector<std::string> arguments (argv + (argc > 0 ? 1 : 0), argv + argc);
  addOptions (app, command_line);
  if (const std::optional<int> done = parseArguments (app, arguments))
    return done;
  if (command_line.compute_normals && command_line.meshFormat () == MeshFormat::STL)
    command_line.warnings.emplace_back ("an option has no effect: --normals; STL has normals of "
                                        "triangles only, write .ply, .vtk or .obj");
  if (command_line.options.disc.as_published) {
    choosePublished (command_line.options.disc, app.count ("--boundary") > 0,
                     app.count ("--ordering") > 0);
    const Options given = command_line.options;
    command_line.options = effectiveOptions (given); // the report lists these
    warnOfUnpublished (app, given, command_line.options, command_line.warnings);
  }
  if (command_line.input.empty () || command_line.output.empty ())
    throw UsageError ("INPUT and OUTPUT are names of files; one of them is empty");
  const bool needs_disc = !command_line.loop.empty () || !command_line.parameterization.empty ();
  Topology& topology = command_line.options.topology;
  if (needs_disc && topology == Topology::SURFACE)
    throw UsageError ("--loop and --parameterization are for a disc, not for --topology surface");
  if (needs_disc)
    topology = Topology::DISC;
  if (const Problem problem = checkOptions (command_line.options))
    throw UsageError (rangeMessage (app, problem));
  command_line.texture_coordinates =
      command_line.texture_coordinates || !command_line.texture.empty ();
  checkTextureOptions (command_line);
  checkMemoryLimit (command_line);
  return std::nullopt;
}

namespace {
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
  if (line.cloudFormat () == nullptr) {
    if (isStandardStream (line.input))
      throw UsageError ("INPUT is the standard input: give its format by --input-format, such as "
                        "--input-format pcd");
    requireReadable (line.input);
    throw ReadError (unknownExtension (line.input) + "; use " + CLOUD_EXTENSIONS +
                     ", or give its format by --input-format");
  }
  for (const auto& [name, path] :
       {std::pair ("--report", &line.report), std::pair ("--html", &line.html),
        std::pair ("--loop", &line.loop), std::pair ("--parameterization", &line.parameterization)})
    if (isStandardStream (*path))
      throw UsageError (std::string (name) + " takes the name of a file, not -");
  const std::filesystem::path materials = line.materials ();
  for (const std::filesystem::path* path : {&materials, &line.texture})
    if (path->filename ().string ().find_first_of ("\n\r") != std::string::npos)
      throw UsageError ("the name of the file of materials or of the texture has a line break in "
                        "it, which files in OBJ cannot hold; choose another one");
  // The first two are inputs.
  const std::array<std::pair<std::string, std::filesystem::path>, 8> all{
      {{"INPUT", line.input},
       {"--loop", line.loop},
       {"OUTPUT", line.output},
       {"--parameterization", line.parameterization},
       {"--report", line.report},
       {"--html", line.html},
       {"the file of materials", materials},
       {"--texture", line.texture}}};
  for (std::size_t i = 2; i < all.size (); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto& [name, path] = all[i];
      const auto& [other_name, other] = all[j];
      if (!path.empty () && !other.empty () && !isStandardStream (path) &&
          !isStandardStream (other) && areSame (path, other))
        throw UsageError (std::string (other_name)
                              .append (" and ")
                              .append (name)
                              .append (" are the same file, '")
                              .append (path.string ())
                              .append ("'; give different ones"));
    }
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
  for (std::size_t i = 2; i < all.size (); ++i)
    if (!all[i].second.empty ())
      requireWritable (all[i].second);
}

} // namespace pcl::floater

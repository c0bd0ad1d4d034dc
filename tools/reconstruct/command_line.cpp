// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "command_line.h"

#include "option_table.h"
#include "scratch_arrays.h"

#include <cstdio>
#include <new>

namespace pcl::floater {
namespace {
const char* const DESCRIPTION =
    R"(Reconstructs a surface from unorganized points. The vertices of the mesh are the points of
the cloud, in the same order and with all their fields. The surface may be open or closed,
with holes, handles or several components. It is put together from the triangles on which the
Delaunay stars of neighbouring points agree. A disc can also be laid out in the plane, by
Floater's meshless parameterization. The defaults need no tuning.
)";

const char* const FOOTER =
    R"(Examples:
  pcl_floater_reconstruct scan.pcd scan.vtk
  pcl_floater_reconstruct --report scan.json --parameterization flat.ply scan.ply mesh.ply
  pcl_floater_reconstruct --holes close-all --strict statue.pcd statue.stl
  pcl_floater_reconstruct --method tw385 scan.pcd paper.ply

Notes:
  With --shift, coordinates in the outputs and in messages are those after the origin was
  subtracted. The report has it, and all formats but .stl have it in a comment. Coordinates in text
  files are then read with all their digits, also where the file says float.
  Of a mesh, only the points are read. pcl_viewer opens .vtk. With - for OUTPUT, the summary goes to
  the standard error stream, and the mesh comes when it is complete.
  Points with a NaN or infinite coordinate, pixels without a return, cells without data, and what an
  airborne scan marks as withheld or noise are left out of the output, so that the vertices after
  them move up. All other points are vertices of the output, also those that are in no triangle:
  outliers, repeated points, and points that could not be connected. The report lists them all.
  With --uv, points on seams are several vertices in .ply and .vtk: the others follow after all
  points. An .obj has a file of materials beside it, with its name and .mtl.
  An output file appears when it is complete, and replaces an existing one. After a failure there is
  no new mesh, and existing files are unchanged.

Exit codes:
  0  success
  1  usage: an option is unknown, malformed, out of its range, or not for this input
  2  the input cannot be read: missing, truncated, damaged, without x y z
  3  the cloud cannot be reconstructed; the message and the report name the status
  4  an output cannot be written, or nothing can be printed; no file is changed
  5  out of memory, or an internal error
  6  with --strict: the mesh is poor, or points are in no triangle; the report
     is written, but no mesh
)";

/// Adds all options and the two positional arguments to \a app, which writes to \a line when it parses.
void
addOptions (CLI::App& app, CommandLine& line)
{
  prepareApp (app, DESCRIPTION, FOOTER);
  addTableOptions (app, line, [] (const OptionRow&) { return true; });
  addLimitAndCoordinates (app, line);
  app.add_flag ("--json", line.json, "print a summary as JSON, in the last line");
  app.add_flag ("-q,--quiet", line.quiet, "print errors only, and the line of --json");
  app.add_flag ("-v,--verbose", line.verbose,
                "print all warnings, and the decisions that are not sure")
      ->excludes ("--quiet");
  app.add_flag ("--strict", line.strict,
                "write no mesh if it is poor, or if points are in no triangle");
  beginGroup (app, option_group::BOUNDARY);
  addPath (app, "--loop", line.loop,
           "read the boundary loop from this text file: indices of points, from 0, in order; makes "
           "a disc");
  beginGroup (app, "Files");
  addPath (app, "INPUT", line.input,
           std::string ("point cloud: ") + CLOUD_EXTENSIONS + "; - is the standard input", " ")
      ->required ();
  addPath (app, "OUTPUT", line.output,
           std::string ("mesh to write: ") + MESH_EXTENSIONS + "; - is the standard output", " ")
      ->required ();
  addChoice (app, "--input-format", line.input_format, CLOUD_FORMATS,
             "format of INPUT; auto: that of its extension; xyz: text with a point in each line");
  addChoice (app, "--output-format", line.output_format, MESH_FORMATS,
             "format of OUTPUT; auto: that of its extension");
  addOutputs (app, line);
  addPath (app, "--html", line.html,
           "write the report as a page for a browser: figures, findings and the mesh, which turns");
  addNumber (app, "--page-triangles", line.shown_triangles,
             "most triangles that the page shows; in larger meshes, vertices are joined");
  addPath (app, "--parameterization", line.parameterization,
           "write the mesh laid out in the plane z = 0, in any of the mesh formats; makes a disc");
  app.add_flag (
      "--uv", line.texture_coordinates,
      "write texture coordinates with the mesh: vt of .obj, s and t of .ply, TCoords of .vtk");
  addPath (app, "--texture", line.texture,
           "write a texture of the colours of the points, as .png, and --uv; an .obj names it in "
           "its .mtl");
  app.add_option ("--texture-size", line.texture_size,
                  "side of the texture in pixels, 16 to 16384; by default a power of two, two "
                  "pixels for an edge")
      ->option_text ("N")
      ->check (CLI::Range (16, 16384));
}

void
checkTextureOptions (const CommandLine& line)
{
  const MeshFormat format = line.meshFormat ();
  if (line.texture_coordinates && (format == writeStl || format == writeOff || format == writeGlb))
    throw UsageError ("STL, OFF and GLB are written without texture coordinates; write .vtk, .ply "
                      "or .obj, or leave --uv and --texture out");
  if (line.texture_coordinates && format == writeObj && isStandardStream (line.output))
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

// Takes the options of TW 385. Warns of those that were given, and that it sets otherwise.
void
takePublished (const CLI::App& app, CommandLine& line)
{
  choosePublished (line.options.disc, app.count ("--boundary") > 0, app.count ("--ordering") > 0);
  const OptionValues given (line.options);
  line.options = effectiveOptions (line.options); // the report lists these
  const OptionValues effective (line.options);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < given.rows.size (); ++i)
    if (const std::string name = toolName (given.rows[i].name);
        given.values[i] != effective.values[i] && app.count (name) > 0)
      names.push_back (name);
  if (!names.empty ())
    line.warnings.push_back (
        (names.size () == 1 ? "an option has no effect: " : "options have no effect: ") +
        boost::join (names, ", ") + "; --method tw385 is that report and nothing else");
}

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

void
checkPaths (const CommandLine& line)
{
  if (line.input_format == nullptr && isStandardStream (line.input))
    throw UsageError ("INPUT is the standard input: give its format by --input-format, such as "
                      "--input-format pcd");
  if (line.input_format == nullptr)
    readNamed (line.input, [&line] {
      return requireCloudFormat (line.input, ", or give its format by --input-format");
    });
  // The first two are inputs.
  const std::array<std::pair<std::string, std::filesystem::path>, 8> all{
      {{"INPUT", line.input},
       {"--loop", line.loop},
       {"OUTPUT", line.output},
       {"--parameterization", line.parameterization},
       {"--report", line.report},
       {"--html", line.html},
       {"the file of materials", line.materials ()},
       {"--texture", line.texture}}};
  for (const auto& [name, path] : all)
    if (name.front () == '-' && isStandardStream (path))
      throw UsageError (name + " takes the name of a file, not -");
  for (const auto& [name, path] : {all[6], all[7]})
    if (path.filename ().string ().find_first_of ("\n\r") != std::string::npos)
      throw UsageError ("the name of the file of materials or of the texture has a line break in "
                        "it, which files in OBJ cannot hold; choose another one");
  const auto refuse = [] (const std::string& one, const std::string& other, const auto& path) {
    throw UsageError (one + " and " + other + " are the same file, '" + path.string () +
                      "'; give different ones");
  };
  for (std::size_t i = 2; i < all.size (); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto& [name, path] = all[i];
      const auto& [other_name, other] = all[j];
      if (!path.empty () && !other.empty () && !isStandardStream (path) &&
          !isStandardStream (other) && areSame (path, other))
        refuse (other_name, name, path);
    }
  if (line.meshFormat () == nullptr && isStandardStream (line.output))
    throw UsageError ("OUTPUT is the standard output: give its format by --output-format, such as "
                      "--output-format ply");
  if (line.meshFormat () == nullptr)
    throw WriteError ("cannot write '" + line.output.string () +
                      "': " + unknownExtension (line.output) + "; use " + MESH_EXTENSIONS +
                      ", or give its format by --output-format");
  if (!line.parameterization.empty () && meshFormatOf (line.parameterization) == nullptr)
    throw WriteError ("cannot write '" + line.parameterization.string () + "': " +
                      unknownExtension (line.parameterization) + "; use " + MESH_EXTENSIONS);
  for (std::size_t i = 2; i < all.size (); ++i)
    if (!all[i].second.empty ())
      requireWritable (all[i].second);
}

} // namespace

int
guarded (const char* program, const char* if_no_memory, const std::function<int ()>& work)
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
  catch (const std::bad_alloc&) {
    message = scratchFailure ();
    if (message.empty ())
      message = std::string ("not enough memory; ") + if_no_memory;
  }
  catch (const std::exception& error) {
    message = std::string ("unexpected error: ") + error.what ();
  }
  std::fprintf (stderr, "%s: %s\n", program, printable (message).c_str ());
  return code;
}

std::optional<int>
parseCommandLine (int argc, char** argv, CommandLine& line)
{
  CLI::App app ("", line.program);
  const std::vector<std::string> arguments (argv + (argc > 0 ? 1 : 0), argv + argc);
  addOptions (app, line);
  if (const std::optional<int> done = parseArguments (app, arguments))
    return done;
  if (line.compute_normals && line.meshFormat () == writeStl)
    line.warnings.emplace_back ("an option has no effect: --normals; STL has normals of "
                                "triangles only, write .ply, .vtk or .obj");
  if (line.options.disc.as_published)
    takePublished (app, line);
  if (line.input.empty () || line.output.empty ())
    throw UsageError ("INPUT and OUTPUT are names of files; one of them is empty");
  const bool needs_disc = !line.loop.empty () || !line.parameterization.empty ();
  Topology& topology = line.options.topology;
  if (needs_disc && topology == Topology::SURFACE)
    throw UsageError ("--loop and --parameterization are for a disc, not for --topology surface");
  if (needs_disc)
    topology = Topology::DISC;
  requireOptions (app, line.options);
  line.texture_coordinates |= !line.texture.empty ();
  checkTextureOptions (line);
  checkMemoryLimit (line);
  checkPaths (line);
  return std::nullopt;
}

} // namespace pcl::floater

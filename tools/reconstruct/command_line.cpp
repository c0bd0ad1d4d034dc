// SPDX-License-Identifier: GPL-3.0-or-later
#include "command_line.h"

#include "atomic_file.h"
#include "check_options.h"
#include "cloud_reader.h"
#include "format.h"
#include "memory_limit.h"
#include "mesh_writer.h"
#include "text_scanner.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <optional>

namespace pcl
{
namespace floater
{
namespace
{
const char* const GENERAL = "General";

const char* const DESCRIPTION =
    "Reconstructs a surface from unorganized points. The vertices of the mesh are the points of\n"
    "the cloud, in the same order and with all their fields. The surface may be open or closed,\n"
    "with holes, handles or several components. It is put together from the triangles on which "
    "the\n"
    "Delaunay stars of neighbouring points agree. A disc can also be laid out in the plane, by\n"
    "Floater's meshless parameterization. The defaults need no tuning.\n";

const char* const FOOTER =
    R"(Examples:
  pcl_floater_reconstruct scan.pcd scan.vtk
  pcl_floater_reconstruct --report scan.json --parameterization flat.ply scan.ply mesh.ply
  pcl_floater_reconstruct --holes close-all --strict statue.pcd statue.stl
  pcl_floater_reconstruct --topology disc --boundary two-segments --flips off --sheet-filter off \
                          scan.pcd paper.ply

Notes:
  With --shift, coordinates in the outputs and in messages are those after the origin was
  subtracted. The report has it, and all formats but .stl have it in a comment. Coordinates in text
  files are then read with all their digits, also where the file says float.
  Input formats: .pcd, .ply, .obj. Output formats: .vtk (pcl_viewer opens it), .ply, .obj, .stl.
  Points with a NaN or infinite coordinate are left out of the output, so that the vertices after
  them move up. All other points are vertices of the output, also those that are in no triangle:
  outliers, repeated points, and points that could not be connected. The report lists them all.
  An output file appears when it is complete, and replaces an existing one. After a failure there is
  no new mesh, and existing files are unchanged.

Exit codes:
  0  success
  1  usage: an option is unknown, malformed or out of its range
  2  the input cannot be read: missing, truncated, damaged, without x y z
  3  the cloud cannot be reconstructed; the message and the report name the status
  4  an output cannot be written
  5  out of memory, or an internal error
  6  with --strict: there are warnings; the report is written, but no mesh
)";

template <typename Enum, std::size_t N>
void
addChoice (CLI::App& app, const std::string& name, Enum& value, const Choices<Enum, N>& choices,
           const std::string& description, const std::string& group)
{
  std::string words;
  for (const auto& choice : choices)
    words += (words.empty () ? "" : ", ") + std::string (choice.first);
  const auto choose = [&value, choices, words, name] (const std::string& word) {
    for (const auto& choice : choices)
      if (word == choice.first) {
        value = choice.second;
        return;
      }
    throw CLI::ValidationError (name, "'" + word + "' is none of: " + words);
  };
  app.add_option_function<std::string> (name, choose, description + ":\n" + words)
      ->option_text (std::string ("NAME (") + choiceName (choices, value) + ")")
      ->group (group);
}

template <typename Number>
void
addNumber (CLI::App& app, const std::string& name, Number& value, const std::string& description,
           const std::string& group)
{
  const auto parse = [&value, name] (const std::string& word) {
    if (!parseNumber (word, value))
      throw CLI::ValidationError (name,
                                  "'" + word + "' is not a " +
                                      (std::is_integral_v<Number> ? "whole number" : "number"));
  };
  std::ostringstream text;
  text << (std::is_integral_v<Number> ? "N (" : "X (") << value << ")";
  app.add_option_function<std::string> (name, parse, description)
      ->option_text (text.str ())
      ->group (group);
}

void
addPath (CLI::App& app, const std::string& name, std::filesystem::path& path,
         const std::string& description, const std::string& group, const char* kind = "FILE")
{
  app.add_option_function<std::string> (
         name, [&path] (const std::string& word) { path = word; }, description)
      ->option_text (kind)
      ->group (group);
}

void
addMemoryLimit (CLI::App& app, CommandLine& line)
{
  const auto parse = [&line] (const std::string& word) {
    if (!parseSize (word, line.max_memory))
      throw CLI::ValidationError ("--max-memory",
                                  "'" + word + "' is not a size, such as 500M or 2G");
    if (line.max_memory < leastMemory (0))
      throw CLI::ValidationError ("--max-memory", "'" + word + "' is too small; it must be " +
                                                      formatSize (leastMemory (0)) + " or more");
  };
  app.add_option_function<std::string> ("--max-memory", parse,
                                        "limit on the memory in use, in bytes; arrays that "
                                        "are\nnot in use are kept on disk; not for discs")
      ->option_text ("SIZE (no limit)")
      ->group (GENERAL);
  addPath (
      app, "--scratch", line.scratch,
      "--max-memory: where the arrays are kept; these files\nhave no names and end with the run",
      GENERAL, "FOLDER (that of OUTPUT)");
}

/// "1,-2.5,3". \return nothing if these are not three finite numbers
std::optional<Eigen::Vector3d>
parsePlace (const std::string& word)
{
  Eigen::Vector3d place;
  std::size_t first = 0;
  bool is_good = std::count (word.begin (), word.end (), ',') == 2;
  for (int axis = 0; axis < 3 && is_good; ++axis) {
    const std::size_t comma = std::min (word.find (',', first), word.size ());
    is_good = parseNumber (std::string_view (word).substr (first, comma - first), place[axis]);
    first = comma + 1;
  }
  return is_good && place.allFinite () ? std::optional (place) : std::nullopt;
}

void
addShift (CLI::App& app, CommandLine& line)
{
  const auto parse = [&line] (const std::string& word) {
    line.auto_shift = word == "auto";
    line.shift = parsePlace (word);
    if (!line.auto_shift && !line.shift)
      throw CLI::ValidationError ("--shift", "'" + word +
                                                 "' is neither auto nor three numbers, such as "
                                                 "500000,5500000,0");
  };
  app.add_option_function<std::string> (
         "--shift", parse,
         "origin to subtract from all coordinates, for those\ntoo far from zero for 32 bits; auto: "
         "the rounded\ncentre of the points, if they are")
      ->option_text ("X,Y,Z or auto (none)")
      ->group (GENERAL);
}

void
addViewpoint (CLI::App& app, ViewOptions& options, const std::string& group)
{
  const auto parse = [&options] (const std::string& word) {
    const std::optional<Eigen::Vector3d> place = parsePlace (word);
    if (!place && word != "auto" && word != "none")
      throw CLI::ValidationError ("--viewpoint", "'" + word +
                                                     "' is neither auto, none, nor three numbers, "
                                                     "such as 0,0,1.5");
    options.use = place ? ViewUse::GIVEN : word == "auto" ? ViewUse::AUTO : ViewUse::NEVER;
    Eigen::Map<Eigen::Vector3d> (options.viewpoint.data ()) =
        place.value_or (Eigen::Vector3d::Zero ());
  };
  app.add_option_function<std::string> (
         "--viewpoint", parse,
         "one scan: where its sensor was, before any shift; its\npoints are connected as they were "
         "seen from there.\nauto: that of the file, or one that is found, if the\nspacing of the "
         "points tells so; none: the cloud is no\nsingle scan")
      ->option_text ("X,Y,Z, auto or none (auto)")
      ->group (group);
}

/// \throws UsageError
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
    throw UsageError ("--max-memory cannot limit the memory for the linear system of a disc; use "
                      "it with --topology surface or auto, and without --loop and "
                      "--parameterization");
  if (line.scratch.empty ())
    line.scratch = line.output.has_parent_path () ? line.output.parent_path () : ".";
}

void
addTopology (CLI::App& app, Options& options)
{
  const std::string surface = "Surface";
  addChoice (app, "--topology", options.topology, TOPOLOGY_CHOICES,
             "what the points are taken for: a disc (one component\nwith one boundary loop), any "
             "surface, or whichever\ngives the better mesh",
             surface);
  addChoice (
      app, "--holes", options.holes.policy, HOLE_CHOICES,
      "boundary loops that stay open: those beyond which\nthere are no points, none, the largest "
      "of each\ncomponent, a number of the largest, or those above a\nsize",
      surface);
  addNumber (app, "--kept-loops", options.holes.kept_loops,
             "keep-count: boundary loops that stay open, 0 or more", surface);
  addNumber (app, "--largest-hole", options.holes.largest_hole,
             "by-size: width of the widest hole to fill, in local\nspacings; 0: no limit", surface);
  addNumber (app, "--largest-hole-length", options.holes.largest_hole_length,
             "by-size: the same in units of the cloud", surface);
  addViewpoint (app, options.view, surface);
  addNumber (app, "--max-edge", options.trimming.maximum_edge_length,
             "cut off triangles with a longer edge, in units of the\ncloud; 0: no limit", surface);
  addNumber (app, "--max-edge-ratio", options.trimming.maximum_edge_ratio,
             "the same in local spacings", surface);
  addNumber (app, "--min-component", options.trimming.minimum_component_size,
             "cut off components of fewer points", surface);
  addChoice (app, "--remove-outliers", options.remove_outliers, SWITCH_CHOICES,
             "leave points that lie off any surface out of\nthe mesh", surface);
  addChoice (app, "--denoise", options.denoise, SWITCH_CHOICES,
             "where noise is strong, connect points as they lie\nwhen projected on local planes",
             surface);
  addChoice (app, "--flips", options.flip_edges, SWITCH_CHOICES,
             "flip edges in space and repair folds at the end", surface);
  addChoice (app, "--uncross", options.remove_self_intersections, SWITCH_CHOICES,
             "change the mesh where its triangles cross each other", surface);
}

void
addGeneral (CLI::App& app, CommandLine& line)
{
  Options& options = line.options;
  addNumber (app, "-j,--threads", options.threads,
             "threads, 0: one for each core; the result is the\nsame", GENERAL);
  addNumber (app, "--blocks", options.blocks,
             "blocks in which the nearest neighbours are searched,\n0: chosen by the number of "
             "points; the result is\nthe same",
             GENERAL);
  addMemoryLimit (app, line);
  addShift (app, line);
  app.add_flag ("--json", line.json, "print a summary as JSON, in the last line")->group (GENERAL);
  app.add_flag ("-q,--quiet", line.quiet, "print errors only, and the line of --json")
      ->group (GENERAL);
  app.add_flag ("--strict", line.strict, "treat warnings as a failure: write no mesh")
      ->group (GENERAL);
}

void
addFiles (CLI::App& app, CommandLine& line)
{
  const auto positional = [&app] (const std::string& name, std::filesystem::path& path,
                                  const std::string& text) {
    app.add_option_function<std::string> (
           name, [&path] (const std::string& word) { path = word; }, text)
        ->option_text (" ")
        ->required ();
  };
  positional ("INPUT", line.input, "point cloud: .pcd, .ply or .obj");
  positional ("OUTPUT", line.output, "mesh to write: .vtk, .ply, .obj or .stl");
  const std::string output = "More output";
  addPath (app, "--report", line.report, "write a report on the run as JSON", output);
  addPath (app, "--parameterization", line.parameterization,
           "write the mesh laid out in the plane z = 0, in any of\nthe mesh formats; makes a disc",
           output);
}

void
addNeighbors (CLI::App& app, Options& options)
{
  const std::string neighborhoods = "Neighbourhoods";
  addNumber (app, "-k,--neighbors", options.neighbors.k,
             "nearest neighbours of each point, 6 to 200", neighborhoods);
  addChoice (app, "--neighborhood", options.neighbors.kind, NEIGHBORHOOD_CHOICES,
             "points that a point of a disc is a mean of: the\nnearest, those in a ball, or the "
             "Delaunay star among\neither",
             neighborhoods);
  addNumber (app, "--ball-radius", options.neighbors.ball_radius,
             "ball, ball-delaunay: radius, in mean distances of a\npoint to its 6 nearest, 1 to 10",
             neighborhoods);
  addChoice (app, "--sheet-filter", options.filter_sheets, SWITCH_CHOICES,
             "drop neighbours on another sheet of the surface", neighborhoods);
}

void
addBoundary (CLI::App& app, CommandLine& line)
{
  Options& options = line.options;
  const std::string boundary = "Boundary of a disc";
  addChoice (app, "--boundary", options.boundary.method, BOUNDARY_CHOICES,
             "how the boundary loop is found: in a spanning tree of\nthe boundary points; as the "
             "largest boundary loop of\nthe consensus of the stars; or as in TW 385, section 3\n"
             "(two-segments)",
             boundary);
  addPath (app, "--loop", line.loop,
           "read the loop from this text file: indices of points,\nfrom 0, in order; makes a disc",
           boundary);
  addNumber (app, "--opening-angle", options.boundary.opening_angle,
             "two-segments: degrees; a boundary point has a wider\nsector without neighbours",
             boundary);
  addNumber (app, "--cluster-tolerance", options.boundary.cluster_tolerance,
             "two-segments: distance over which clusters grow, as\na fraction of the bounding box "
             "diagonal",
             boundary);
  addNumber (app, "--cluster-neighbors", options.boundary.cluster_k,
             "two-segments: boundary points that a cluster takes in\nat a time, 1 or more",
             boundary);
}

void
addParameterization (CLI::App& app, Options& options)
{
  const std::string parameterization = "Parameterization of a disc";
  addChoice (app, "--domain", options.domain.curve, DOMAIN_CHOICES,
             "convex curve on which the loop is laid", parameterization);
  addNumber (app, "--sides", options.domain.polygon_sides, "sides of the polygon, 3 or more",
             parameterization);
  addChoice (app, "--spacing", options.domain.loop_spacing, SPACING_CHOICES,
             "how the points of the loop are spaced on that curve", parameterization);
  addChoice (app, "--weights", options.weighting, WEIGHTING_CHOICES,
             "weights of the neighbours of a point", parameterization);
}

void
addSystem (CLI::App& app, Options& options)
{
  const std::string system = "Linear system";
  addChoice (app, "--solver", options.solver.method, SOLVER_CHOICES, "what solves the system",
             system);
  addChoice (app, "--ordering", options.solver.ordering, ORDERING_CHOICES, "order of the unknowns",
             system);
  addNumber (app, "--tolerance", options.solver.tolerance,
             "bicgstab-ilut, gauss-seidel: relative residual to\nreach, above 0 and below 1",
             system);
  addNumber (app, "--max-iterations", options.solver.max_iterations,
             "bicgstab-ilut, gauss-seidel: iterations after which\nthey give up, 1 or more",
             system);
  addNumber (app, "--ilut-fill", options.solver.ilut_fill,
             "bicgstab-ilut: entries kept in a row of each factor,\n1 to 10000", system);
  addNumber (
      app, "--ilut-drop", options.solver.ilut_drop,
      "bicgstab-ilut: entries of the factors below this\nfraction of their row are dropped, 0 "
      "to 1",
      system);
}

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

std::optional<int>
parseCommandLine (int argc, char** argv, CommandLine& command_line)
{
  CLI::App app (DESCRIPTION, "pcl_floater_reconstruct");
  constexpr std::size_t NAME_COLUMN = 34;
  app.get_formatter ()->column_width (NAME_COLUMN);
  app.footer (FOOTER);
  app.set_help_flag ("-h,--help", "print this and exit")->group (GENERAL);
  app.set_version_flag ("--version", "pcl_floater_reconstruct " PCL_FLOATER_VERSION,
                        "print the version and exit")
      ->group (GENERAL);
  addGeneral (app, command_line);
  addTopology (app, command_line.options);
  addNeighbors (app, command_line.options);
  addBoundary (app, command_line);
  addParameterization (app, command_line.options);
  addSystem (app, command_line.options);
  addFiles (app, command_line);
  try {
    app.parse (argc, argv);
  }
  catch (const CLI::ParseError& error) {
    if (error.get_exit_code () == static_cast<int> (CLI::ExitCodes::Success))
      return app.exit (error);
    throw UsageError (error.what ());
  }
  const bool needs_disc = !command_line.loop.empty () || !command_line.parameterization.empty ();
  Topology& topology = command_line.options.topology;
  if (needs_disc && topology == Topology::SURFACE)
    throw UsageError ("--loop and --parameterization are for a disc, not for --topology surface");
  if (needs_disc)
    topology = Topology::DISC;
  if (const Problem problem = checkOptions (command_line.options))
    throw UsageError (problem.message);
  checkMemoryLimit (command_line);
  return std::nullopt;
}

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
  const std::array<Named, 5> all{{{"INPUT", &line.input, false},
                                  {"--loop", &line.loop, false},
                                  {"OUTPUT", &line.output, true},
                                  {"--parameterization", &line.parameterization, true},
                                  {"--report", &line.report, true}}};
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

} // namespace floater
} // namespace pcl

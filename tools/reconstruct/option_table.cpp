// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "option_table.h"

#include "limit_settings.h"
#include "memory_limit.h"
#include "option_kinds.h"

namespace pcl::floater {
namespace {
const char* const GENERAL = "General";
const char* const NEIGHBORHOODS = "Neighbourhoods";

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
  pcl_floater_reconstruct --method tw385 scan.pcd paper.ply

Notes:
  With --shift, coordinates in the outputs and in messages are those after the origin was
  subtracted. The report has it, and all formats but .stl have it in a comment. Coordinates in text
  files are then read with all their digits, also where the file says float.
  Of a mesh, only the points are read. pcl_viewer opens .vtk. With - for OUTPUT, the summary goes to
  the standard error stream, and the mesh comes when it is complete.
  Points with a NaN or infinite coordinate are left out of the output, so that the vertices after
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
  6  with --strict: there are warnings; the report is written, but no mesh
)";

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
         "origin to subtract from all coordinates, where they are\ntoo far from zero for 32 bits; "
         "auto: the rounded centre\nof the points, if they are so far")
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

// The size of --largest-hole in another unit. CommandLine has one size: only one may be given.
void
addLargestHoleLength (CLI::App& app, HoleOptions& options, const std::string& group)
{
  const std::string name = "--largest-hole-length";
  const auto parse = [&options, name] (const std::string& word) {
    if (!parseNumber (word, options.largest_hole))
      throw CLI::ValidationError (name, "'" + word + "' is not a number");
    options.unit = LengthUnit::CLOUD;
  };
  app.add_option_function<std::string> (
         name, parse, "instead of --largest-hole: the same in units of the\ncloud")
      ->option_text ("X")
      ->group (group);
}

void
addTopology (CLI::App& app, CommandLine& line)
{
  Options& options = line.options;
  const std::string surface = "Surface";
  addChoice (
      app, "--method", line.as_published, METHOD_CHOICES,
      "tw385: a disc by the method of that report and nothing\nelse: no outliers, noise, sheet "
      "filter, flips or repair",
      surface);
  addChoice (app, "--topology", options.topology, TOPOLOGY_CHOICES,
             "what the points are taken for: a disc (one component\nwith one boundary loop) or any "
             "surface; auto: a disc\nif the boundary loop is given, else any surface",
             surface);
  addSurfaceOptions (app, line);
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
  addLimit (app, line);
  addCoordinates (app, line);
  app.add_flag ("--json", line.json, "print a summary as JSON, in the last line")->group (GENERAL);
  app.add_flag ("-q,--quiet", line.quiet, "print errors only, and the line of --json")
      ->group (GENERAL);
  app.add_flag ("--strict", line.strict, "treat warnings as a failure: write no mesh")
      ->group (GENERAL);
}

} // namespace

void
addSurfaceOptions (CLI::App& app, CommandLine& line)
{
  Options& options = line.options;
  const std::string surface = "Surface";
  addChoice (
      app, "--holes", options.holes.policy, HOLE_CHOICES,
      "boundary loops that stay open: those that look\nlike boundaries, not like gaps of the "
      "sampling; none;\nthe largest of each component; a number of the\nmost likely; or those "
      "above a size",
      surface);
  addNumber (app, "--kept-loops", options.holes.kept_loops,
             "keep-count: boundary loops that stay open, 0 or more", surface);
  addNumber (app, "--largest-hole", options.holes.largest_hole,
             "by-size: width of the widest hole to fill, in local\nspacings", surface);
  addLargestHoleLength (app, options.holes, surface);
  addViewpoint (app, options.view, surface);
  addChoice (app, "--facing", options.facing, FACING_CHOICES,
             "which side of each component is its front; auto: that\nwhich the evidence tells",
             surface);
  addNumber (app, "--max-edge", options.trimming.maximum_edge_length,
             "cut off triangles with a longer edge, in units of the\ncloud; 0: no limit", surface);
  addNumber (app, "--max-edge-ratio", options.trimming.maximum_edge_ratio,
             "the same in local spacings; 0: no limit", surface);
  addNumber (app, "--min-component", options.trimming.minimum_component_size,
             "cut off components of fewer points", surface);
  addChoice (app, "--remove-outliers", options.remove_outliers, SWITCH_CHOICES,
             "leave points that lie off any surface out of\nthe mesh", surface);
  addChoice (app, "--scatter", options.scatter, SCATTER_CHOICES,
             "what becomes of points that are on no surface at any\nscale, such as leaves",
             surface);
  addChoice (app, "--denoise", options.denoise, SWITCH_CHOICES,
             "where noise is strong, connect points as they lie\nwhen projected on local planes",
             surface);
  addChoice (app, "--flips", options.flip_edges, SWITCH_CHOICES,
             "flip edges in space and repair folds at the end", surface);
  addChoice (app, "--uncross", options.remove_self_intersections, SWITCH_CHOICES,
             "change the mesh where its triangles cross each other", surface);
  addChoice (app, "--open-crossings", options.trimming.open_self_intersections, SWITCH_CHOICES,
             "take triangles out until no two cross each other", surface);
}

namespace {
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
  positional (
      "INPUT", line.input,
      "point cloud: .pcd, .ply, .obj, .stl, .las, .xyz, .txt,\n.csv, .asc or .pts; - is the "
      "standard input");
  positional ("OUTPUT", line.output,
              "mesh to write: .vtk, .ply, .obj, .stl, .off or .glb; -\nis the standard output");
  const std::string files = "Files";
  addChoice (app, "--input-format", line.input_format, CLOUD_FORMAT_CHOICES,
             "format of INPUT; auto: that of its extension; xyz: text\nwith a point in each line",
             files);
  addChoice (app, "--output-format", line.output_format, MESH_FORMAT_CHOICES,
             "format of OUTPUT; auto: that of its extension", files);
  const std::string output = "More output";
  app.add_flag (
         "--normals", line.compute_normals,
         "give the vertices normals, made from the triangles; those\nof the input are replaced")
      ->group (output);
  addPath (app, "--report", line.report, "write a report on the run as JSON", output);
  addPath (app, "--parameterization", line.parameterization,
           "write the mesh laid out in the plane z = 0, in any of\nthe mesh formats; makes a disc",
           output);
  app.add_flag ("--uv", line.texture_coordinates,
                "write texture coordinates with the mesh: vt of .obj,\ns and t of .ply, TCoords of "
                ".vtk")
      ->group (output);
  addPath (app, "--texture", line.texture,
           "write a texture of the colours of the points, as .png,\nand --uv; an .obj names it in "
           "its .mtl",
           output);
  app.add_option ("--texture-size", line.texture_size,
                  "side of the texture in pixels, 16 to 16384; by default\na power of two, two "
                  "pixels for an edge")
      ->option_text ("N")
      ->check (CLI::Range (16, 16384))
      ->group (output);
}

void
addNeighbors (CLI::App& app, CommandLine& line)
{
  Options& options = line.options;
  addNeighborCount (app, line);
  addChoice (app, "--neighborhood", options.neighbors.kind, NEIGHBORHOOD_CHOICES,
             "points that a point of a disc is a mean of: the\nnearest, those in a ball, or the "
             "Delaunay star among\neither",
             NEIGHBORHOODS);
  addNumber (app, "--ball-radius", options.neighbors.ball_radius,
             "ball, ball-delaunay: radius, in mean distances of a\npoint to its 6 nearest, 1 to 10",
             NEIGHBORHOODS);
  addTangentPlaneOptions (app, line);
}

void
addBoundary (CLI::App& app, CommandLine& line)
{
  Options& options = line.options;
  const std::string boundary = "Boundary of a disc";
  addChoice (app, "--boundary", options.disc.boundary.method, BOUNDARY_CHOICES,
             "how the boundary loop is found: in a spanning tree of\nthe boundary points; as the "
             "largest boundary loop of\nthe consensus of the stars; or as in TW 385, section 3\n"
             "(two-segments)",
             boundary);
  addPath (app, "--loop", line.loop,
           "read the loop from this text file: indices of points,\nfrom 0, in order; makes a disc",
           boundary);
  addNumber (app, "--opening-angle", options.disc.boundary.opening_angle,
             "two-segments: degrees; a boundary point has a wider\nsector without neighbours",
             boundary);
  addNumber (app, "--cluster-tolerance", options.disc.boundary.cluster_tolerance,
             "two-segments: distance over which clusters grow, as\na fraction of the bounding box "
             "diagonal",
             boundary);
  addNumber (app, "--cluster-neighbors", options.disc.boundary.cluster_k,
             "two-segments: boundary points that a cluster takes in\nat a time, 1 or more",
             boundary);
}

void
addParameterization (CLI::App& app, Options& options)
{
  const std::string parameterization = "Parameterization of a disc";
  addChoice (app, "--domain", options.disc.domain.curve, DOMAIN_CHOICES,
             "convex curve on which the loop is laid", parameterization);
  addNumber (app, "--sides", options.disc.domain.polygon_sides, "sides of the polygon, 3 or more",
             parameterization);
  addChoice (app, "--spacing", options.disc.domain.loop_spacing, SPACING_CHOICES,
             "how the points of the loop are spaced on that curve", parameterization);
  addChoice (app, "--weights", options.disc.weighting, WEIGHTING_CHOICES,
             "weights of the neighbours of a point", parameterization);
}

void
addSystem (CLI::App& app, Options& options)
{
  const std::string system = "Linear system";
  addChoice (app, "--solver", options.disc.solver.method, SOLVER_CHOICES, "what solves the system",
             system);
  addChoice (app, "--ordering", options.disc.solver.ordering, ORDERING_CHOICES,
             "order of the unknowns", system);
  addNumber (app, "--tolerance", options.disc.solver.tolerance,
             "bicgstab-ilut, gauss-seidel: relative residual to\nreach, above 0 and below 1",
             system);
  addNumber (app, "--max-iterations", options.disc.solver.max_iterations,
             "bicgstab-ilut, gauss-seidel: iterations after which\nthey give up, 1 or more",
             system);
  addNumber (app, "--ilut-fill", options.disc.solver.ilut_fill,
             "bicgstab-ilut: entries kept in a row of each factor,\n1 to 10000", system);
  addNumber (
      app, "--ilut-drop", options.disc.solver.ilut_drop,
      "bicgstab-ilut: entries of the factors below this\nfraction of their row are dropped, 0 "
      "to 1",
      system);
}

} // namespace

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
  addPath (app, "--scratch", line.scratch,
           "--max-memory: folder where the arrays are kept; these\nfiles have no names and end "
           "with the run",
           GENERAL, "FOLDER (that of OUTPUT)");
}

void
addLimit (CLI::App& app, CommandLine& line)
{
  const auto change = [&line] (const std::string& setting) {
    if (const std::optional<std::string> problem = setLimit (setting, line.limits))
      throw CLI::ValidationError ("--limit", *problem);
  };
  app.add_option ("--limit", line.changed_limits)
      ->allow_extra_args (false)
      ->each (change)
      ->group ("");
}

void
addCoordinates (CLI::App& app, CommandLine& line)
{
  addShift (app, line);
  addChoice (
      app, "--precision", line.precision, PRECISION_CHOICES,
      "precision of coordinates in outputs; auto: single if\nthat of the input is, or if that "
      "is exact. PCL reads\ndoubles of a .ply as 0",
      GENERAL);
}

void
addNeighborCount (CLI::App& app, CommandLine& line)
{
  addNumber (app, "-k,--neighbors", line.options.neighbors.k,
             "nearest neighbours of each point, 6 to 200", NEIGHBORHOODS);
}

void
addTangentPlaneOptions (CLI::App& app, CommandLine& line)
{
  addChoice (app, "--use-input-normals", line.use_input_normals, SWITCH_CHOICES,
             "take the normals of the input for tangent planes, and,\nwith --facing auto, for the "
             "front",
             NEIGHBORHOODS);
  addChoice (app, "--sheet-filter", line.options.filter_sheets, SWITCH_CHOICES,
             "drop neighbours on another sheet of the surface", NEIGHBORHOODS);
}

void
addOptions (CLI::App& app, CommandLine& line)
{
  constexpr std::size_t NAME_COLUMN = 34;
  app.description (DESCRIPTION);
  app.get_formatter ()->column_width (NAME_COLUMN);
  app.get_formatter ()->label ("Positionals", "Arguments");
  app.footer (FOOTER);
  app.set_help_flag ("-h,--help", "print this and exit")->group (GENERAL);
  app.set_version_flag ("--version", "pcl_floater_reconstruct " PCL_FLOATER_VERSION,
                        "print the version and exit")
      ->group (GENERAL);
  addGeneral (app, line);
  addTopology (app, line);
  addNeighbors (app, line);
  addBoundary (app, line);
  addParameterization (app, line.options);
  addSystem (app, line.options);
  addFiles (app, line);
}

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "option_table.h"

#include "scratch_arrays.h"

namespace pcl::floater {
namespace {
/// Reads "1,-2.5,3".
/// \return nothing if these are not three finite numbers
std::optional<Eigen::Vector3d>
parsePlace (const std::string& word)
{
  std::vector<std::string> numbers;
  boost::split (numbers, word, boost::is_any_of (","));
  Eigen::Vector3d place;
  bool is_good = numbers.size () == 3;
  for (std::size_t axis = 0; axis < 3 && is_good; ++axis)
    is_good = parseNumber (numbers[axis], place[static_cast<Eigen::Index> (axis)]);
  return is_good && place.allFinite () ? std::optional (place) : std::nullopt;
}

using option_group::GENERAL;

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

// Adds options of the table.
struct TableOptions
{
  CLI::App& app;

  template <typename Number>
  void operator() (const OptionRow& row, Number& value, const NumberRange& range)
  {
    const bool is_plain = range.text () == NumberRange{0, NO_LIMIT}.text ();
    addNumber (app, nameOf (row), value, row.text + (is_plain ? "" : ", " + range.text ()));
  }
  template <typename Enum, std::size_t N>
  void operator() (const OptionRow& row, Enum& value, Choices<Enum, N>& choices)
  {
    addChoice (app, nameOf (row), value, choices, row.text);
  }
  void operator() (const OptionRow& row, bool& value) { (*this) (row, value, SWITCH_CHOICES); }
  void operator() (const OptionRow& row, HoleOptions& holes, LengthUnit unit)
  {
    const auto parse = [&holes, unit] (const std::string& word) {
      holes.unit = unit;
      return parseNumber (word, holes.largest_hole) ? "" : "is not a number";
    };
    addParsed (app, nameOf (row), parse, row.text, "X");
  }
  void operator() (const OptionRow& row, ViewOptions& view)
  {
    const auto parse = [&view] (const std::string& word) {
      const std::optional<Eigen::Vector3d> place = parsePlace (word);
      view.use = place ? ViewUse::GIVEN : word == "auto" ? ViewUse::AUTO : ViewUse::NEVER;
      Eigen::Map<Eigen::Vector3d> (view.viewpoint.data ()) =
          place.value_or (Eigen::Vector3d::Zero ());
      return place || word == "auto" || word == "none"
                 ? ""
                 : "is neither auto, none, nor three numbers, such as 0,0,1.5";
    };
    addParsed (app, nameOf (row), parse, row.text, "X,Y,Z, auto or none (auto)");
  }

  // "-k,--neighbors"
  static std::string nameOf (const OptionRow& row)
  {
    return (*row.letter == 0 ? "" : "-" + std::string (row.letter) + ",") + toolName (row.name);
  }
};

} // namespace

void
addTableOptions (CLI::App& app, CommandLine& line,
                 const std::function<bool (const OptionRow&)>& takes)
{
  visitOptions (line.options, [&] (const OptionRow& row, auto&&... value) {
    beginGroup (app, row.group);
    if (takes (row))
      TableOptions{app}(row, value...);
  });
  beginGroup (app, option_group::NEIGHBORHOODS);
  addChoice (
      app, "--use-input-normals", line.use_input_normals, SWITCH_CHOICES,
      "take the normals of the input for tangent planes, and, with --facing auto, for the front");
  app.get_option ("--largest-hole")->excludes (app.get_option ("--largest-hole-length"));
}

void
addLimitAndCoordinates (CLI::App& app, CommandLine& line)
{
  beginGroup (app, GENERAL);
  const auto parseLimit = [&line] (const std::string& word) -> std::string {
    if (!parseSize (word, line.max_memory))
      return "is not a size, such as 500M or 2G";
    return line.max_memory < leastMemory (0)
               ? "is too small; it must be " + formatSize (leastMemory (0)) + " or more"
               : "";
  };
  addParsed (app, "--max-memory", parseLimit,
             "keep the memory in use near this, in bytes; arrays that are not in use are kept on "
             "disk; not for discs",
             "SIZE (no limit)");
  addPath (app, "--scratch", line.scratch,
           "--max-memory: folder where the arrays are kept; these files have no names and end with "
           "the run",
           "FOLDER (that of OUTPUT)");
  const auto parseShift = [&line] (const std::string& word) {
    line.auto_shift = word == "auto";
    line.shift = parsePlace (word);
    return line.auto_shift || line.shift
               ? ""
               : "is neither auto nor three numbers, such as 500000,5500000,0";
  };
  addParsed (app, "--shift", parseShift,
             "origin to subtract from all coordinates, where they are too far from zero for 32 "
             "bits; auto: the rounded centre of the points, if they are so far",
             "X,Y,Z or auto (none)");
  const auto parseColumns = [&line] (const std::string& word) {
    const std::optional<Eigen::Vector3d> numbers = parsePlace (word);
    for (Eigen::Index axis = 0; numbers && axis < 3; ++axis)
      line.columns[static_cast<std::size_t> (axis)] =
          static_cast<std::size_t> (std::max (0.0, (*numbers)[axis]));
    const auto& [x, y, z] = line.columns;
    return !numbers || x == 0 || y == 0 || z == 0 || x == y || y == z || z == x
               ? "is no three different numbers of columns, such as 2,3,4"
               : "";
  };
  addParsed (app, "--columns", parseColumns,
             "columns of x, y and z in text with a point in each line, from 1; by default those "
             "that the first line names, or the first three",
             "X,Y,Z");
  const auto parseClasses = [&line] (const std::string& word) {
    std::stringstream words (word);
    for (std::string one; std::getline (words, one, ',');)
      if (!parseNumber (std::string_view (one), line.classes.emplace_back ()))
        return "are no numbers of classes, such as 2,6";
    return "";
  };
  addParsed (app, "--classes", parseClasses,
             "classes of an airborne scan that are taken, such as 2,6 for ground and buildings; by "
             "default all but those of noise, 7 and 18. Withheld points are never taken",
             "N,N,...");
  addChoice (app, "--precision", line.precision, PRECISION_CHOICES,
             "precision of coordinates in outputs; auto: single, with --shift auto for doubles. "
             "PCL reads doubles of a .ply as 0");
}

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

} // namespace pcl::floater

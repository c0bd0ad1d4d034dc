// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a cloud, reconstructs its surface and writes the mesh. Calls the core and not the PCL
// class, so that coordinates keep their double precision.
#include "report_json.h"
#include "run_report.h"
#include "text_scanner.h"

#include <cstdio>
#include <new>

#include <unistd.h>

namespace pcl::floater {
namespace {
/// Reads a boundary loop: cloud indices in order, separated by blanks, commas or newlines. A word
/// that begins with # begins a comment, up to the end of the line.
/// \throws ReadError
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

/// Shows the current step on the standard error stream if that is a terminal that can erase a line.
/// The line is erased at the end.
class Progress : private boost::noncopyable
{
public:
  explicit Progress (bool wanted)
  {
    const char* const terminal = std::getenv ("TERM");
    is_shown_ = wanted && ::isatty (STDERR_FILENO) == 1 && terminal != nullptr &&
                *terminal != '\0' && std::string (terminal) != "dumb";
  }
  ~Progress () { show (""); }

  void show (const std::string& step)
  {
    if (!is_shown_ || step == shown_)
      return;
    std::fputs (("\r\033[K" + step + (step.empty () ? "" : " ...")).c_str (), stderr);
    std::fflush (stderr);
    shown_ = step;
  }

private:
  bool is_shown_ = false;
  std::string shown_;
};

Result
reconstructInput (Input input, Options options, Progress& progress)
{
  const auto start = std::chrono::steady_clock::now ();
  std::string name;
  constexpr std::size_t LARGE = 1U << 19U; // memory is worth more than time from here on
  const bool is_large = input.positions.size () > LARGE;
  options.stage_callback = [&name, is_large] (Stage stage) {
    name = stageName (stage);
    if (is_large)
      giveFreedBack ();
  };
  options.progress_callback = [&] (double fraction) {
    const std::string text = remainingTime (secondsSince (start), fraction);
    progress.show (name + (text.empty () ? "" : ": " + text));
  };
  return reconstruct (std::move (input), options);
}

/// The mesh in the plane z = 0, without normals, because these are those of the surface in space.
std::pair<Cloud, Triangles>
flatMesh (const Cloud& cloud, const Result& result, Precision precision)
{
  std::vector<Eigen::Vector3d> places;
  for (const Eigen::Vector2d& place : result.report.parameters)
    places.emplace_back (place.x (), place.y (), 0.0);
  const std::size_t points = places.size ();
  std::vector<Field> fields;
  addColumns ({"x", "y", "z"}, ScalarType::FLOAT64, std::move (places), fields);
  const FieldTriple normals = cloud.normals ();
  for (const Field& field : cloud.fields)
    if (std::find (normals.begin (), normals.end (), &field) == normals.end ())
      fields.push_back (field);
  Cloud flat = makeCloud (std::move (fields), points);
  flat.single_precision = precision != Precision::DOUBLE;
  Triangles triangles = result.triangles;
  removeNonFinitePoints (flat, triangles);
  return {std::move (flat), std::move (triangles)};
}

/// Whether to write 32-bit floats: unless doubles are asked for, or floats would put corners of a
/// triangle together, of which a warning tells.
bool
writesSingle (const CommandLine& line, const Triangles& triangles, Cloud& cloud)
{
  if (line.precision != Precision::AUTO || cloud.single_precision)
    return line.precision != Precision::DOUBLE;
  constexpr double LARGEST = std::numeric_limits<float>::max ();
  bool are_floats = true; // others must not be converted
  for (std::size_t p = 0; p < cloud.size () && are_floats; ++p) {
    const Eigen::Vector3d position = cloud.position (p);
    are_floats = !position.allFinite () || position.lpNorm<Eigen::Infinity> () <= LARGEST;
  }
  if (are_floats && countMergedInSinglePrecision (cloud, triangles) == 0)
    return true;
  cloud.warnings.emplace_back (
      "the coordinates are written as doubles, since 32-bit numbers do not reach so far, or would "
      "put corners of a triangle together; PCL reads doubles of a .ply file into its points as 0: "
      "use --precision single or another format for PCL");
  return false;
}

/// Computes the coordinates that are asked for. If that fails, the result has no mesh any more, and
/// says why.
TextureCoordinates
computeTexture (const CommandLine& line, const Cloud& cloud, Result& result)
{
  if (!line.texture_coordinates || result.report.status != RunStatus::SUCCESS)
    return {};
  TextureOptions options;
  options.threads = line.options.threads;
  options.whole_discs = result.report.topology == Topology::DISC;
  TextureCoordinates texture =
      computeTextureCoordinates (cloud.positions (), result.triangles, options);
  if (texture.status != RunStatus::SUCCESS) {
    result.report.status = texture.status;
    result.report.message = "texture coordinates: " + texture.message;
    result.triangles.clear ();
  }
  else if (texture.flipped > 0)
    result.report.warnings.push_back (
        counted (texture.flipped, "triangle") + (texture.flipped == 1 ? " is" : " are") +
        " upside down in the texture: too small beside the mesh for 32 bits");
  return texture;
}

/// Writes the file of materials of an OBJ file and the image, under temporary names. Warnings tell
/// what is odd about them.
void
stageTexture (const CommandLine& line, const Cloud& cloud, Result& result,
              const TextureCoordinates& texture, OutputFiles& files)
{
  if (const std::filesystem::path materials = line.materials (); !materials.empty ()) {
    std::string image; // relative to the folder of the materials, as readers expect it
    if (!line.texture.empty ())
      image = std::filesystem::absolute (line.texture)
                  .lexically_normal ()
                  .lexically_proximate (
                      std::filesystem::absolute (line.output).parent_path ().lexically_normal ())
                  .generic_string ();
    stageFile (materials,
               "newmtl surface\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nd 1\nillum 1\n" +
                   (image.empty () ? "" : "map_Kd " + image + "\n"),
               files);
    if ((materials.filename ().string () + image).find (' ') != std::string::npos)
      result.report.warnings.emplace_back (
          "the name of the file of materials or of the texture has a space in it, which many "
          "readers of OBJ files do not take");
  }
  if (!line.texture.empty ())
    stageFile (line.texture,
               pngOf (bakeColours (cloud, result.triangles, texture,
                                   static_cast<std::size_t> (line.texture_size))),
               files);
}

/// Writes all outputs under temporary names, so that none is visible yet.
void
stageOutputs (const CommandLine& line, Cloud& cloud, Result& result, RunFigures& run,
              OutputFiles& files)
{
  std::vector<std::string>& warnings = result.report.warnings;
  const auto stage = [&] (const std::filesystem::path& path, const Cloud& vertices,
                          const Triangles& triangles, MeshFormat format,
                          const TextureCoordinates* texture = nullptr) {
    const std::vector<std::string> losses =
        writeMesh (path, vertices, triangles, format, files, texture);
    warnings.insert (warnings.end (), losses.begin (), losses.end ());
  };
  cloud.left_out.resize (cloud.rows, false);
  for (const std::uint32_t row : result.report.non_finite) // finite: pixels without a return
    cloud.left_out[row] = cloud.left_out[row] || cloud.positionOfRow (row).allFinite ();
  if (line.compute_normals)
    replaceNormals (cloud, result.triangles, line.options.threads);
  if (!line.parameterization.empty ()) {
    const auto [flat, triangles] = flatMesh (cloud, result, line.precision);
    stage (line.parameterization, flat, triangles, meshFormatOf (line.parameterization));
  }
  if (const std::size_t removed = removeNonFinitePoints (cloud, result.triangles))
    warnings.push_back (counted (removed, "point") + " without finite coordinates " +
                        (removed == 1 ? "was" : "were") +
                        " left out of the output; the vertices behind moved up");
  run.vertices = cloud.size ();
  if (line.texture_coordinates) {
    for (std::uint32_t& point : run.texture.points)
      point = cloud.pointOf (point);
    stageTexture (line, cloud, result, run.texture, files);
    const std::vector<std::uint32_t>& points = run.texture.points; // those on seams are doubled
    for (std::size_t i = 1; line.meshFormat () != writeObj && i < points.size (); ++i)
      run.vertices += points[i] == points[i - 1] ? 1 : 0;
  }
  stage (line.output, cloud, result.triangles, line.meshFormat (),
         line.texture_coordinates ? &run.texture : nullptr);
  if (cloud.file.hasChanged ())
    warnings.emplace_back (
        "the input file changed while it was in use, so that the mesh may mix old and new points; "
        "run again on a file that does not change");
}

int
run (CommandLine line)
{
  if (line.max_memory > 0)
    keepLargeArraysIn (line.scratch, line.max_memory);
  Progress progress (!line.quiet);
  progress.show ("reading");
  auto start = std::chrono::steady_clock::now ();
  if (!line.loop.empty ())
    line.options.disc.boundary.loop = readNamed (line.loop, [&] { return readLoop (line.loop); });
  Cloud cloud = readNamed (
      line.input, [&] { return readCloud (line.input, line.readOptions (), line.input_format); });
  if (!line.texture.empty () && !cloud.colors ()[0])
    throw UsageError ("--texture: the points of '" + line.input.string () +
                      "' have no colours (red, green, blue of 8 bits, or rgb); use --uv for "
                      "texture coordinates alone");
  RunFigures figures;
  Input input = prepareInput (line, cloud, figures);
  figures.read_seconds = secondsSince (start);

  start = std::chrono::steady_clock::now ();
  Result result = reconstructInput (std::move (input), line.options, progress);
  figures.reconstruct_seconds = secondsSince (start);
  cloud.single_precision = writesSingle (line, result.triangles, cloud);
  figures.writes_single = cloud.single_precision;
  Report& report = result.report;
  completeReport (line, cloud.warnings, report);
  if (report.status == RunStatus::SUCCESS && !cloud.projection.empty ())
    report.verdict = {Quality::POOR, DEGREES, cloud.projection};
  if (line.texture_coordinates) {
    progress.show ("texture");
    start = std::chrono::steady_clock::now ();
    figures.texture = computeTexture (line, cloud, result);
    figures.texture_seconds = secondsSince (start);
  }
  progress.show ("writing");
  start = std::chrono::steady_clock::now ();
  OutputFiles files;
  if (report.status == RunStatus::SUCCESS)
    stageOutputs (line, cloud, result, figures, files);
  if (const std::string objection = objectionTo (report); line.strict && !objection.empty ()) {
    figures.is_refused = true;
    files.clear (); // only the report is written
    report.message = objection + ", which --strict does not allow";
  }
  if (!line.report.empty ())
    stageFile (line.report, reportText (line, report, figures), files);
  if (!line.html.empty ())
    stageFile (line.html, htmlReport (line, cloud, result, figures), files);
  figures.write_seconds = secondsSince (start);
  progress.show ("");
  printOutcome (line, report, figures);
  publishAll (files);
  return exitCode (report, figures);
}

} // namespace
} // namespace pcl::floater

int
main (int argc, char** argv)
{
  using namespace pcl::floater;
  rlimit addresses{};
  const bool may_lack_memory =
      ::getrlimit (RLIMIT_AS, &addresses) == 0 && addresses.rlim_cur != RLIM_INFINITY;
  prepareHeap (!may_lack_memory);
  if (!may_lack_memory)
    endBlasThreads ();
  int code = EXIT_INTERNAL;
  try {
    code = guarded ("pcl_floater_reconstruct", "use fewer points, or a machine with more", [&] {
      handleSignals (EXIT_INPUT);
      CommandLine line;
      const std::optional<int> done = parseCommandLine (argc, argv, line);
      return done ? *done : run (std::move (line));
    });
  }
  catch (const std::bad_alloc&) { // while another failure was being told
    std::fputs ("pcl_floater_reconstruct: out of memory\n", stderr);
  }
  if (code != EXIT_INTERNAL && !may_lack_memory)
    return code;
  // A worker thread of OpenBLAS that finds no memory, already when it is started with the program,
  // waits for it for ever. A normal exit would wait for that thread.
  std::fflush (nullptr);
  std::_Exit (code);
}

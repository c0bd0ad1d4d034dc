// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of the whole cloud. A mesh may be written as tiles: one PLY file for each input file or block,
// and a manifest that tells how they belong together.
#include "job.h"

#include "input/input.h"
#include "reconstruct.h"
#include "report/report_cloud.h"
#include "report_json.h"
#include "stored_cloud.h"

#include <lodepng.h>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace pcl::floater {
namespace {
using Json = nlohmann::ordered_json;

constexpr const char* REPORT = "report.json";

template <typename Visit>
void
forBlockFiles (const Plan& plan, Visit&& visit)
{
  for (const Step& step : STEPS)
    for (std::size_t block = 0; step.of_block != nullptr && block < plan.blocks; ++block)
      visit (blockFile (step.name, block));
}

// What the blocks have found out, from the files of all, each when it is needed.
class StoredStages : public KnownStages
{
public:
  /// \param context must outlive this
  explicit StoredStages (const StepContext& context) : context_ (context) {}

  Points points (Report& report) override
  {
    std::vector<Index> gross_outliers;
    Points points = readPoints (context_.store, context_.plan, gross_outliers);
    report.statistics.cloud_points = context_.plan.cloudSize ();
    report.statistics.selected_points = context_.plan.selected_points;
    reportOutliers (gross_outliers, FindingId::GROSS_OUTLIERS, report);
    reportPoints (points, report);
    return points;
  }

  CsrLists neighborsOfStacks () override
  {
    return left_out_.are_stacked ? StoredCloud (context_, {}).nearestOfAll () : CsrLists{};
  }

  std::vector<Index> outliers () override { return left_out_.outliers; }

  LocalPlanes planes () override
  {
    StoredCloud cloud (context_, left_out_);
    const std::vector<Index> all = cloud.all ();
    LocalPlanes planes;
    planes.neighbors = cloud.nearest (all);
    appendRows (cloud.gatherLists ("planes", "beside", all), planes.neighbors);
    planes.spacing = cloud.gather<float> ("planes", "spacing", all);
    planes.normals = cloud.gather<Eigen::Vector3f> ("planes", "normals", all);
    return planes;
  }

  Stars begunStars () override
  {
    StoredCloud cloud (context_, left_out_);
    const std::vector<Index> all = cloud.all ();
    Stars stars;
    stars.neighbors = cloud.gatherLists ("stars", "stars", all);
    stars.far_neighbors = cloud.gatherLists ("stars", "far", all);
    stars.open = cloud.gather<std::uint8_t> ("stars", "open", all);
    stars.normals = cloud.gather<Eigen::Vector3f> ("stars", "normals", all);
    stars.reach = cloud.gather<float> ("stars", "reach", all);
    return stars;
  }

private:
  const StepContext& context_;
  LeftOut left_out_ = readLeftOut (context_);
};

/// The field that has the number of each vertex in the whole mesh. It is a double: PLY has no
/// 64-bit integers, and a double holds all whole numbers up to 2^53.
constexpr const char* VERTEX_NUMBER = "vertex_number";

std::string
tileName (std::size_t tile)
{
  return "tile." + std::to_string (tile) + ".ply";
}

std::vector<std::uint32_t>
findOwners (const Cloud& cloud, const std::vector<std::size_t>& firsts, const Store& store,
            const Plan& plan)
{
  std::vector<std::uint32_t> tile_of (cloud.size (), 0);
  if (plan.inputs.size () > 1) {
    std::uint32_t tile = 0;
    for (std::size_t v = 0; v < cloud.size (); ++v) {
      while (cloud.row (v) >= firsts[tile + 1])
        ++tile;
      tile_of[v] = tile;
    }
    return tile_of;
  }
  ArrayFile file = store.arrays (POINTS, plan);
  const std::vector<Index> cloud_index = file.read<Index> ("cloud_index");
  for (std::uint32_t block = 0; block < plan.blocks; ++block)
    for (Index p = BlockCutter::firstOf (block, plan.blocks, plan.points);
         p < BlockCutter::firstOf (block + 1, plan.blocks, plan.points); ++p)
      tile_of[cloud.pointOf (cloud_index[p])] = block;
  for (const auto& [repeated, standing] : file.read<std::array<Index, 2>> ("duplicates"))
    tile_of[cloud.pointOf (repeated)] = tile_of[cloud.pointOf (standing)];
  return tile_of;
}

// Writes the tiles and then the manifest, see doc/distributed.md. The manifest of an older run is removed
// first, and older tiles of higher numbers too. O(n log n), 16 bytes per vertex beside mesh and
// owners, and the largest tile twice.
// \param folder is made if it does not exist
// \param cloud of all files, without the points that are not finite
// \param firsts see readClouds
// \return losses of the format, one sentence each
std::vector<std::string>
writeTiles (const std::filesystem::path& folder, const Cloud& cloud, const Triangles& triangles,
            const std::vector<std::size_t>& firsts, const Store& store, const Plan& plan)
{
  std::error_code error;
  std::filesystem::create_directory (folder, error);
  requireWritable (folder / TILES); // tells what is wrong with the folder
  std::filesystem::remove (folder / TILES, error);
  if (error)
    throw WriteError ("cannot remove '" + (folder / TILES).string () + "': " + error.message ());
  const std::vector<std::uint32_t> tile_of = findOwners (cloud, firsts, store, plan);
  const bool are_files = plan.inputs.size () > 1; // else blocks
  const std::size_t tiles = are_files ? plan.inputs.size () : plan.blocks;
  // Those of each tile, ascending.
  const CsrLists own_vertices = makeCsrLists (tiles, [&] (const auto& emit) {
    for (Index v = 0; v < cloud.size (); ++v)
      emit (tile_of[v], v);
  });
  const CsrLists its_triangles = makeCsrLists (tiles, [&] (const auto& emit) {
    for (Index t = 0; t < triangles.size (); ++t)
      emit (tile_of[*std::min_element (triangles[t].begin (), triangles[t].end ())], t);
  });
  std::vector<Index> place_of (cloud.size ()); // of each vertex in the tile that is being written
  std::vector<std::string> losses;
  Json list = Json::array ();
  std::uint64_t points_before = 0, triangles_before = 0;
  for (std::size_t tile = 0; tile < tiles; ++tile) {
    const Row own = own_vertices.row (tile);
    std::vector<std::pair<std::size_t, Index>> border; // vertices of other tiles, after the tile
    for (const Index t : its_triangles.row (tile))
      for (const Index vertex : triangles[t])
        if (tile_of[vertex] != tile)
          border.emplace_back (tile_of[vertex], vertex);
    sortUnique (border);
    std::vector<std::size_t> vertices (own.begin (), own.end ()), rows;
    Json borders = Json::array (); // runs of them that one tile owns
    for (const auto& [owner, vertex] : border) {
      if (borders.empty () || borders.back ()["tile"] != owner)
        borders.push_back ({{"tile", owner}, {"first", vertices.size ()}, {"points", 0}});
      borders.back ()["points"] = borders.back ()["points"].get<std::size_t> () + 1;
      vertices.push_back (vertex);
    }
    for (const std::size_t vertex : vertices) {
      place_of[vertex] = static_cast<Index> (rows.size ());
      rows.push_back (cloud.row (vertex));
    }
    Triangles local = valuesAt (triangles, its_triangles.row (tile));
    for (Triangle& triangle : local)
      for (Index& corner : triangle)
        corner = place_of[corner];
    Cloud part = copyRows (cloud, rows);
    replaceColumns ({VERTEX_NUMBER}, ScalarType::FLOAT64,
                    std::vector<double> (vertices.begin (), vertices.end ()), part.fields);

    const std::filesystem::path path = folder / tileName (tile);
    OutputFiles files;
    losses = writeMesh (path, part, local, writePly, files);
    publishAll (files);
    const FileBytes written (path); // as it is read back
    std::array<char, 9> sum{};
    std::snprintf (sum.data (), sum.size (), "%08x",
                   lodepng_crc32 (reinterpret_cast<const unsigned char*> (written.view ().data ()),
                                  written.view ().size ()));
    list.push_back ({{"file", tileName (tile)},
                     {"input", plan.inputs[are_files ? tile : 0].file},
                     {"bytes", written.view ().size ()},
                     {"crc32", sum.data ()},
                     {"own_points", own.size ()},
                     {"points_before", points_before},
                     {"border_points", border.size ()},
                     {"triangles", local.size ()},
                     {"triangles_before", triangles_before},
                     {"borders", borders}});
    points_before += own.size ();
    triangles_before += local.size ();
  }
  for (std::size_t old = tiles; std::filesystem::remove (folder / tileName (old), error);)
    ++old;
  if (cloud.find (VERTEX_NUMBER) != nullptr)
    losses.push_back (std::string ("the field '") + VERTEX_NUMBER +
                      "' of the points was left out: in tiles it has the numbers of the vertices");
  const Json manifest{{"format", "pcl_floater tiles"},
                      {"version", 1},
                      {"points", cloud.size ()},
                      {"triangles", triangles.size ()},
                      {"vertex_number", VERTEX_NUMBER},
                      {"shift", {cloud.shift.x (), cloud.shift.y (), cloud.shift.z ()}},
                      {"tiles", list}};
  writeFile (folder / TILES, dump (manifest, 2) + "\n");
  return losses;
}

} // namespace

int
joinStep (const Job& job, const Store& store, const Plan& plan)
{
  const auto start = std::chrono::steady_clock::now ();
  const CommandLine& line = job.line;
  const StepContext context{store, plan, line, job.join_threads};
  checkMemory (line, plan.cloudSize ());
  StoredStages stages (context);
  forBlockFiles (plan, [&] (const std::string& name) { // missing ones are told before hours of work
    store.arrays (name, plan);
  });
  Input input;
  input.cloud_size = plan.cloudSize ();
  input.sensor_origin = plan.sensor_origin;
  input.shift = plan.figures.shift;
  Options options = line.options;
  options.threads = job.join_threads;
  Eigen::Map<Eigen::Vector3d> (options.view.viewpoint.data ()) -= plan.shift ();
  Result result = reconstruct (std::move (input), options, {}, &stages);
  Report& report = result.report;
  RunFigures figures = plan.figures;
  figures.reconstruct_seconds = secondsSince (start);
  figures.writes_single = line.precision != Precision::DOUBLE;
  completeReport (line, plan.warnings, report);
  writeFile (store.path (REPORT), reportText (line, report, figures), true);
  printOutcome (line, report, figures);
  if (report.status != RunStatus::SUCCESS)
    return exitCode (report, figures);
  store.put (TRIANGLES, {{"triangles", result.triangles}}, plan.id);
  if (job.frees_disk)
    forBlockFiles (plan, [&store] (const std::string& name) {
      std::error_code error; // a file that stays costs room only
      std::filesystem::remove (store.path (name), error);
    });
  return EXIT_OK;
}

int
writeStep (const Job& job, const Store& store, const Plan& plan)
{
  const CommandLine& line = job.line;
  ArrayFile file = store.arrays (TRIANGLES, plan);
  auto triangles = file.read<Triangle> ("triangles");
  file.requireBelow (triangles, plan.cloudSize ());
  std::vector<std::size_t> firsts;
  Cloud cloud = readClouds (job.inputs, line.readOptions (), firsts);
  cloud.shift = plan.shift ();
  cloud.single_precision = line.precision != Precision::DOUBLE;
  requirePlan (job, store, plan); // the bytes of now
  if (line.compute_normals)
    replaceNormals (cloud, triangles, job.join_threads);
  removeNonFinitePoints (cloud, triangles);
  OutputFiles files;
  if (!line.report.empty ())
    stageFile (line.report, store.open (REPORT).text (), files);
  const std::vector<std::string> losses =
      job.writes_tiles ? writeTiles (line.output, cloud, triangles, firsts, store, plan)
                       : writeMesh (line.output, cloud, triangles, line.meshFormat (), files);
  for (const std::string& loss : losses)
    std::fprintf (stderr, "warning: %s\n", printable (loss).c_str ());
  publishAll (files);
  return EXIT_OK;
}

} // namespace pcl::floater

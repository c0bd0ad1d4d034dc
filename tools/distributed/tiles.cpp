// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh as tiles: one PLY file for each input file or block, and a manifest that tells how they
// belong together.
#include "job.h"

#include "stored_cloud.h"

#include <nlohmann/json.hpp>
#include <zlib.h>

#include <algorithm>
#include <cstdio>

namespace pcl::floater {
namespace {
using Json = nlohmann::ordered_json;

constexpr const char* TILES_FORMAT = "pcl_floater tiles";
constexpr int VERSION = 1;

/// The field that has the number of each vertex in the whole mesh. It is a double: PLY has no
/// 64-bit integers, and a double holds all whole numbers up to 2^53.
constexpr const char* VERTEX_NUMBER = "vertex_number";

std::string
tileName (std::size_t tile)
{
  return "tile." + std::to_string (tile) + ".ply";
}

std::vector<std::uint32_t>
findOwners (const Cloud& cloud, const std::vector<std::size_t>& firsts, FolderStore& store,
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
  ArrayFile file = openArrays (store, POINTS, plan);
  const std::vector<Index> cloud_index = file.read<Index> ("cloud_index");
  for (std::uint32_t block = 0; block < plan.blocks; ++block)
    for (Index p = BlockCutter::firstOf (block, plan.blocks, plan.points);
         p < BlockCutter::firstOf (block + 1, plan.blocks, plan.points); ++p)
      tile_of[cloud.pointOf (cloud_index[p])] = block;
  for (const auto& [repeated, standing] : file.read<std::array<Index, 2>> ("duplicates"))
    tile_of[cloud.pointOf (repeated)] = tile_of[cloud.pointOf (standing)];
  return tile_of;
}

} // namespace

std::vector<std::string>
writeTiles (const std::filesystem::path& folder, const Cloud& cloud, const Triangles& triangles,
            const std::vector<std::size_t>& firsts, FolderStore& store, const Plan& plan)
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
    Triangles local;
    for (const Index t : its_triangles.row (tile)) {
      const auto& [a, b, c] = triangles[t];
      local.push_back ({place_of[a], place_of[b], place_of[c]});
    }
    Cloud part = copyRows (cloud, rows);
    replaceColumns ({VERTEX_NUMBER}, ScalarType::FLOAT64,
                    std::vector<double> (vertices.begin (), vertices.end ()), part.fields);

    const std::filesystem::path path = folder / tileName (tile);
    OutputFiles files;
    losses = writeMesh (path, part, local, MeshFormat::PLY, files);
    publishAll (files);
    const FileBytes written (path); // as it is read back
    std::array<char, 9> sum{};
    std::snprintf (sum.data (), sum.size (), "%08lx",
                   ::crc32_z (0, reinterpret_cast<const Bytef*> (written.view ().data ()),
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
  const Json manifest{{"format", TILES_FORMAT},
                      {"version", VERSION},
                      {"points", cloud.size ()},
                      {"triangles", triangles.size ()},
                      {"vertex_number", VERTEX_NUMBER},
                      {"shift", {cloud.shift.x (), cloud.shift.y (), cloud.shift.z ()}},
                      {"tiles", list}};
  writeFile (folder / TILES, manifest.dump (2, ' ', false, Json::error_handler_t::replace) + "\n");
  return losses;
}

} // namespace pcl::floater

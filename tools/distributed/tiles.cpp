// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles.h"

#include "atomic_file.h"
#include "block_steps.h"
#include "cloud.h"
#include "core/csr_lists.h"
#include "mesh_writer.h"
#include "stored_cloud.h"

#include <nlohmann/json.hpp>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <tuple>

namespace pcl::floater {
namespace {
using Json = nlohmann::ordered_json;

constexpr const char* TILES_FORMAT = "pcl_floater tiles";
constexpr int VERSION = 1;

std::string
tileName (std::size_t tile)
{
  return "tile." + std::to_string (tile) + ".ply";
}

// A vertex of a tile that another tile owns.
struct BorderVertex
{
  std::uint32_t owner, vertex;

  bool operator<(const BorderVertex& other) const
  {
    return std::tie (owner, vertex) < std::tie (other.owner, other.vertex);
  }
  bool operator== (const BorderVertex& other) const { return vertex == other.vertex; }
};

// What the tiles have that are written.
struct Counts
{
  std::uint64_t points = 0, triangles = 0;
};

// Size and CRC-32 of a file, as they are read back.
std::pair<std::uint64_t, std::string>
sumOf (const std::filesystem::path& path)
{
  uLong sum = 0;
  const std::uint64_t size =
      forAllBytes (*openFile (path, false), [&sum] (const char* bytes, std::size_t count) {
        sum = ::crc32 (sum, reinterpret_cast<const Bytef*> (bytes), static_cast<uInt> (count));
      });
  constexpr std::size_t DIGITS = 8;
  std::array<char, DIGITS + 1> text{};
  std::snprintf (text.data (), text.size (), "%08lx", sum);
  return {size, text.data ()};
}

// Runs of border vertices that one tile owns.
Json
bordersJson (const std::vector<BorderVertex>& border, std::size_t own)
{
  Json borders = Json::array ();
  for (std::size_t first = 0, last = 0; first < border.size (); first = last) {
    while (last < border.size () && border[last].owner == border[first].owner)
      ++last;
    borders.push_back (
        {{"tile", border[first].owner}, {"first", own + first}, {"points", last - first}});
  }
  return borders;
}

class TileWriter
{
public:
  TileWriter (const std::filesystem::path& folder, const Cloud& cloud, const Triangles& triangles,
              const TileOwners& owners)
      : folder_ (folder), cloud_ (cloud), triangles_ (triangles), owners_ (owners)
  {
    const std::size_t tiles = owners.inputs.size ();
    vertices_of_ = makeCsrLists (tiles, [&] (const auto& emit) {
      for (Index v = 0; v < cloud.size (); ++v)
        emit (owners.tile_of[v], v);
    });
    triangles_of_ = makeCsrLists (tiles, [&] (const auto& emit) {
      for (Index t = 0; t < triangles.size (); ++t)
        emit (owners.tile_of[*std::min_element (triangles[t].begin (), triangles[t].end ())], t);
    });
    place_of_.resize (cloud.size ());
    for (std::size_t tile = 0; tile < tiles; ++tile) {
      const Row own = vertices_of_.row (tile);
      for (std::size_t i = 0; i < own.size (); ++i)
        place_of_[own[i]] = static_cast<Index> (i);
    }
  }

  // Writes a tile. Returns what the manifest has of it.
  Json write (std::size_t tile, std::vector<std::string>& losses)
  {
    const Row own = vertices_of_.row (tile);
    const std::vector<BorderVertex> border = borderOf (tile);
    std::vector<std::size_t> rows;
    std::vector<double> numbers;
    const auto add = [&] (Index vertex) {
      rows.push_back (cloud_.row (vertex));
      numbers.push_back (static_cast<double> (vertex));
    };
    for (const Index vertex : own)
      add (vertex);
    for (const BorderVertex& other : border)
      add (other.vertex);
    Field number;
    number.name = VERTEX_NUMBER;
    number.type = ScalarType::FLOAT64;
    Cloud part = copyRows (cloud_, rows, {number});
    setValues (part, VERTEX_NUMBER, numbers);

    const std::filesystem::path path = folder_ / tileName (tile);
    AtomicFile file (path);
    losses = writeMesh (file, path, part, renumbered (tile, border), MeshFormat::PLY);
    file.close ();
    file.publish ();
    const auto [bytes, sum] = sumOf (path);
    const std::size_t triangles = triangles_of_.row (tile).size ();
    Json json{{"file", tileName (tile)},
              {"input", owners_.inputs[tile]},
              {"bytes", bytes},
              {"crc32", sum},
              {"own_points", own.size ()},
              {"points_before", before_.points},
              {"border_points", border.size ()},
              {"triangles", triangles},
              {"triangles_before", before_.triangles},
              {"borders", bordersJson (border, own.size ())}};
    before_.points += own.size ();
    before_.triangles += triangles;
    return json;
  }

private:
  std::vector<BorderVertex> borderOf (std::size_t tile) const
  {
    std::vector<BorderVertex> border;
    for (const Index t : triangles_of_.row (tile))
      for (const Index vertex : triangles_[t])
        if (const std::uint32_t owner = owners_.tile_of[vertex]; owner != tile)
          border.push_back ({owner, vertex});
    std::sort (border.begin (), border.end ());
    border.erase (std::unique (border.begin (), border.end ()), border.end ());
    return border;
  }

  Triangles renumbered (std::size_t tile, const std::vector<BorderVertex>& border) const
  {
    const std::size_t own = vertices_of_.row (tile).size ();
    const auto placeOf = [&] (Index vertex) {
      const BorderVertex wanted{owners_.tile_of[vertex], vertex};
      if (wanted.owner == tile)
        return place_of_[vertex];
      const auto place = std::lower_bound (border.begin (), border.end (), wanted);
      return static_cast<Index> (own + static_cast<std::size_t> (place - border.begin ()));
    };
    Triangles local;
    local.reserve (triangles_of_.row (tile).size ());
    for (const Index t : triangles_of_.row (tile))
      local.push_back (
          {placeOf (triangles_[t][0]), placeOf (triangles_[t][1]), placeOf (triangles_[t][2])});
    return local;
  }

  const std::filesystem::path& folder_;
  const Cloud& cloud_;
  const Triangles& triangles_;
  const TileOwners& owners_;
  CsrLists vertices_of_, triangles_of_; // of each tile, ascending
  std::vector<Index> place_of_;         // of each vertex, in the tile that owns it
  Counts before_;
};

} // namespace

TileOwners
ownersByFile (const Cloud& cloud, const std::vector<std::size_t>& firsts,
              const std::vector<std::filesystem::path>& inputs)
{
  TileOwners owners;
  owners.tile_of.resize (cloud.size ());
  const auto vertexOf = [&cloud] (std::size_t row) -> std::size_t {
    return row < cloud.rows ? cloud.kept.number (static_cast<std::uint32_t> (row)) : cloud.size ();
  };
  for (std::size_t tile = 0; tile < inputs.size (); ++tile) {
    owners.inputs.push_back (inputs[tile].string ());
    for (std::size_t v = vertexOf (firsts[tile]); v < vertexOf (firsts[tile + 1]); ++v)
      owners.tile_of[v] = static_cast<std::uint32_t> (tile);
  }
  return owners;
}

TileOwners
ownersByBlock (const Cloud& cloud, FolderStore& store, const Plan& plan)
{
  ArrayFile file = openArrays (store, POINTS, plan);
  const std::vector<Index> cloud_index = file.read<Index> ("cloud_index");
  const BlockRanges ranges = blockRanges (plan, plan.points);
  TileOwners owners;
  owners.tile_of.assign (cloud.size (), 0);
  for (std::size_t block = 0; block < ranges.blocks (); ++block) {
    owners.inputs.push_back (plan.inputs.front ().path.string ());
    for (Index p = ranges.first (block); p < ranges.last (block); ++p)
      owners.tile_of[cloud.kept.number (cloud_index[p])] = static_cast<std::uint32_t> (block);
  }
  for (const auto& [repeated, standing] : file.read<std::array<Index, 2>> ("duplicates"))
    owners.tile_of[cloud.kept.number (repeated)] = owners.tile_of[cloud.kept.number (standing)];
  return owners;
}

std::vector<std::string>
writeTiles (const std::filesystem::path& folder, const Cloud& cloud, const Triangles& triangles,
            const TileOwners& owners)
{
  std::error_code error;
  std::filesystem::create_directory (folder, error);
  requireWritable (folder / TILES); // tells what is wrong with the folder
  std::filesystem::remove (folder / TILES, error);
  if (error)
    throw WriteError ("cannot remove '" + (folder / TILES).string () + "': " + error.message ());
  const std::size_t tiles = owners.inputs.size ();
  std::vector<std::string> losses;
  Json list = Json::array ();
  TileWriter writer (folder, cloud, triangles, owners);
  for (std::size_t tile = 0; tile < tiles; ++tile)
    list.push_back (writer.write (tile, losses));
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
  AtomicFile file (folder / TILES);
  file.write (manifest.dump (2, ' ', false, Json::error_handler_t::replace) + "\n");
  file.close ();
  file.publish ();
  return losses;
}

} // namespace pcl::floater

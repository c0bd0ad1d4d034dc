// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh as tiles: one PLY file for each input file or block, and a manifest that tells how they
// belong together.
#pragma once

#include "cloud.h"
#include "store.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace pcl::floater {
/// The manifest, in the folder of the tiles. It is written last.
constexpr const char* TILES = "tiles.json";

/// The field that has the number of each vertex in the whole mesh. It is a double: PLY has no
/// 64-bit integers, and a double holds all whole numbers up to 2^53.
constexpr const char* VERTEX_NUMBER = "vertex_number";

/// Which vertices each tile has as its own.
struct TileOwners
{
  std::vector<std::uint32_t> tile_of; ///< of each vertex of the mesh
  std::vector<std::string> inputs;    ///< of each tile: its file of points
};

/// A tile for each input file, which owns its points.
/// \param cloud  of all files, without the points that are not finite
/// \param firsts see readClouds
TileOwners
ownersByFile (const Cloud& cloud, const std::vector<std::size_t>& firsts,
              const std::vector<std::filesystem::path>& inputs);

/// A tile for each block, which owns its points. A repeated point belongs to the tile of the one
/// that stands for it, and a gross outlier, which is in no block, to the first tile.
/// \param cloud of the plan's only file, without the points that are not finite
/// \throws WorkError
TileOwners
ownersByBlock (const Cloud& cloud, FolderStore& store, const Plan& plan);

/// Writes the tiles and then the manifest. A triangle goes to the tile that owns the one of its
/// corners with the smallest number. A tile has its own vertices, by their numbers, and then those
/// that its triangles have at the border, by the tile that owns them and their numbers. The
/// manifest of an older run is removed first, and older tiles of higher numbers too.
/// O(n log n), 16 bytes per vertex beside mesh and owners, and the largest tile twice.
/// \param folder is made if it does not exist
/// \return losses of the format, one sentence each
/// \throws WriteError
std::vector<std::string>
writeTiles (const std::filesystem::path& folder, const Cloud& cloud, const Triangles& triangles,
            const TileOwners& owners);

} // namespace pcl::floater

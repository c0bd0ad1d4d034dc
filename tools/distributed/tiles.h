// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh as tiles: one PLY file for each input file or block, and a manifest that tells how they
// belong together.
#pragma once

#include "cloud.h"
#include "store.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pcl::floater {
/// The manifest, in the folder of the tiles. It is written last.
constexpr const char* TILES = "tiles.json";

/// Writes the tiles and then the manifest. Of several files, each has a tile, which owns its points;
/// of one file, each block. A repeated point belongs to the tile of the one that stands for it then,
/// and a gross outlier, which is in no block, to the first tile. A triangle goes to the tile that owns the one of its
/// corners with the smallest number. A tile has its own vertices, by their numbers, and then those
/// that its triangles have at the border, by the tile that owns them and their numbers. The
/// manifest of an older run is removed first, and older tiles of higher numbers too.
/// O(n log n), 16 bytes per vertex beside mesh and owners, and the largest tile twice.
/// \param folder is made if it does not exist
/// \param cloud of all files, without the points that are not finite
/// \param firsts see readClouds
/// \return losses of the format, one sentence each
/// \throws WriteError, WorkError
std::vector<std::string>
writeTiles (const std::filesystem::path& folder, const Cloud& cloud, const Triangles& triangles,
            const std::vector<std::size_t>& firsts, FolderStore& store, const Plan& plan);

} // namespace pcl::floater

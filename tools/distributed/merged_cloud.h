// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// One cloud of several files.
#pragma once

#include "cloud.h"

#include <filesystem>
#include <vector>

namespace pcl::floater {
/// Reads all files, one after the other; a single one is mapped as it is. Of several, the fields
/// are those that all files have with one type, and coordinates of different types become double.
/// \param all_digits see readCloud
/// \param[out] firsts if it is not nullptr, the first row of each file, and the number of all rows
/// \throws ReadError, which names the file
Cloud
readClouds (const std::vector<std::filesystem::path>& files, bool all_digits,
            std::vector<std::size_t>* firsts = nullptr);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary loop of a disc, given in a text file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace pcl::floater {
/// Reads a boundary loop: cloud indices in order, separated by blanks, commas or newlines. A word
/// that begins with # begins a comment, up to the end of the line.
/// \throws ReadError
std::vector<std::uint32_t>
readLoop (const std::filesystem::path& path);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Images, and their files.
#pragma once

#include "file_bytes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl::floater {
/// An image of 8-bit colours, row by row from the top.
struct ColourImage
{
  using Pixel = std::array<std::uint8_t, 3>;

  std::size_t width = 0, height = 0;
  std::vector<Pixel> pixels;
};

/// The bytes of a PNG file. \throws std::bad_alloc
std::vector<unsigned char>
pngOf (const ColourImage& image);

/// Reads a PNG file, without its transparency.
/// \throws ReadError
ColourImage
parsePng (const FileBytes& file);

} // namespace pcl::floater

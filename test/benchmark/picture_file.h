// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures as PNG files.
#pragma once

#include <cstdint>
#include <vector>

namespace pcl
{
namespace floater
{
/// Grey values, row by row from the top.
struct GreyImage
{
  GreyImage (int columns, int rows, std::uint8_t grey)
      : width (columns), height (rows),
        pixels (static_cast<std::size_t> (columns) * static_cast<std::size_t> (rows), grey)
  {
  }

  std::uint8_t& at (int x, int y)
  {
    return pixels[static_cast<std::size_t> (y) * static_cast<std::size_t> (width) +
                  static_cast<std::size_t> (x)];
  }

  int width, height;
  std::vector<std::uint8_t> pixels;
};

/// \throw std::runtime_error if VTK fails
std::vector<unsigned char>
toPng (const GreyImage& image);

} // namespace floater
} // namespace pcl

// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures as PNG files.
#pragma once

#include <cstdint>
#include <vector>

class vtkImageData;

namespace pcl
{
namespace floater
{
/// \throw std::runtime_error if VTK fails
std::vector<unsigned char>
toPng (vtkImageData* image);

/// Grey values, row by row from the top.
struct GreyImage
{
  GreyImage (int width_, int height_, std::uint8_t grey)
      : width (width_), height (height_),
        pixels (static_cast<std::size_t> (width_) * static_cast<std::size_t> (height_), grey)
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

std::vector<unsigned char>
toPng (const GreyImage& image);

} // namespace floater
} // namespace pcl

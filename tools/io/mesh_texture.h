// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Texture coordinates of a mesh, and an image of the colours of its points.
#pragma once

#include "cloud.h"

#include <pcl/surface/floater/texture_coordinates.h>

namespace pcl::floater {
/// An image of 8-bit colours, row by row from the top.
struct ColourImage
{
  using Pixel = Eigen::Matrix<std::uint8_t, 3, 1>;

  std::size_t width = 0, height = 0;
  std::vector<Pixel> pixels;
};

/// Calls paint (x, y, shares of the corners) for each pixel whose middle is in a triangle.
/// \param corners in pixels, with a finite area that is not 0
/// \param side of the square image
template <typename Paint>
void
visitPixels (const std::array<Eigen::Vector2d, 3>& corners, std::size_t side, const Paint& paint)
{
  constexpr double SLACK = 1e-9; // so that no pixel between two triangles is missed
  const Eigen::Vector2d a = corners[1] - corners[0], b = corners[2] - corners[0];
  const double area = a.x () * b.y () - a.y () * b.x ();
  const Eigen::Vector2d low = corners[0].cwiseMin (corners[1]).cwiseMin (corners[2]);
  const Eigen::Vector2d high = corners[0].cwiseMax (corners[1]).cwiseMax (corners[2]);
  const auto pixelOf = [side] (double x) {
    return static_cast<std::size_t> (std::clamp (x, 0.0, static_cast<double> (side - 1)));
  };
  const std::size_t left = pixelOf (low.x () - 1.0), right = pixelOf (high.x () + 1.0);
  for (std::size_t y = pixelOf (low.y () - 1.0); y <= pixelOf (high.y () + 1.0); ++y)
    for (std::size_t x = left; x <= right; ++x) {
      const Eigen::Vector2d p =
          Eigen::Vector2d (static_cast<double> (x) + 0.5, static_cast<double> (y) + 0.5) -
          corners[0];
      const double v = (p.x () * b.y () - p.y () * b.x ()) / area;
      const double w = (a.x () * p.y () - a.y () * p.x ()) / area;
      if (v >= -SLACK && w >= -SLACK && v + w <= 1.0 + SLACK)
        paint (x, y, Eigen::Vector3d (1.0 - v - w, v, w));
    }
}

/// The bytes of a PNG file. \throws std::bad_alloc
std::string
pngOf (const ColourImage& image);

/// Reads a PNG file, without its transparency.
/// \throws ReadError
ColourImage
parsePng (const FileBytes& file);

/// Paints every triangle with the colours of its corners, which are averaged linearly in between.
/// Pixels that no triangle covers get the colour of the nearest that one does, so that nothing
/// shows at seams, at any level of a mipmap. O(pixels).
/// \param cloud with colours (see Cloud::colors)
/// \param side of the image, in pixels; 0: a power of two from 256 to 8192, at which an edge of the
///   mesh is about two pixels long
ColourImage
bakeColours (const Cloud& cloud, const Triangles& triangles, const TextureCoordinates& texture,
             std::size_t side);

/// The file of materials of an OBJ file.
inline std::filesystem::path
materialsBeside (std::filesystem::path obj)
{
  return obj.replace_extension (".mtl");
}

} // namespace pcl::floater

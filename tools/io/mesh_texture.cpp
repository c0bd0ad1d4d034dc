// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_texture.h"

#include <lodepng.h>

#include <new>

namespace pcl::floater {
std::string
pngOf (const ColourImage& image)
{
  lodepng::State state;
  state.info_raw.colortype = state.info_png.color.colortype = LCT_RGB;
  state.encoder.auto_convert = 0; // no palette: one kind of file, whatever is in it
  std::vector<unsigned char> png;
  if (lodepng::encode (png, image.pixels.data ()->data (), static_cast<unsigned> (image.width),
                       static_cast<unsigned> (image.height), state) != 0)
    throw std::bad_alloc (); // nothing else can fail
  return {png.begin (), png.end ()};
}

ColourImage
parsePng (const FileBytes& file)
{
  std::vector<unsigned char> bytes;
  unsigned width = 0, height = 0;
  const unsigned error = lodepng::decode (
      bytes, width, height, reinterpret_cast<const unsigned char*> (file.view ().data ()),
      file.view ().size (), LCT_RGB);
  if (error != 0)
    throw ReadError (std::string ("it is no PNG file that can be read: ") +
                     lodepng_error_text (error));
  ColourImage image{width, height, std::vector<ColourImage::Pixel> (bytes.size () / 3)};
  std::memcpy (image.pixels.data ()->data (), bytes.data (), bytes.size ());
  return image;
}

namespace {
using Colour = Eigen::Vector3d;

// Every pixel that has none gets the colour of the nearest that has, by steps to the side, up and
// down.
void
spread (ColourImage& image, std::vector<std::uint8_t>& is_painted)
{
  std::vector<std::size_t> reached;
  for (std::size_t i = 0; i < is_painted.size (); ++i)
    if (is_painted[i] != 0)
      reached.push_back (i);
  for (std::size_t next = 0; next < reached.size (); ++next) {
    const std::size_t side = image.width, i = reached[next], x = i % side, y = i / side;
    for (const std::size_t other : {x > 0 ? i - 1 : i, x + 1 < side ? i + 1 : i,
                                    y > 0 ? i - side : i, y + 1 < side ? i + side : i}) {
      if (is_painted[other] != 0)
        continue;
      is_painted[other] = 1;
      image.pixels[other] = image.pixels[i];
      reached.push_back (other);
    }
  }
}

} // namespace

ColourImage
bakeColours (const Cloud& cloud, const Triangles& triangles, const TextureCoordinates& texture,
             std::size_t side)
{
  constexpr std::size_t SMALLEST = 256, LARGEST = 8192;
  constexpr double PIXELS_PER_POINT = 4.0;
  const double wanted =
      std::sqrt (PIXELS_PER_POINT * static_cast<double> (texture.coordinates.size ()) /
                 std::max (texture.area_used, 0.01));
  if (side == 0)
    for (side = SMALLEST; side < LARGEST && static_cast<double> (side) < wanted;)
      side *= 2;
  constexpr std::uint8_t GREY = 128;
  ColourImage image{side, side, {side * side, ColourImage::Pixel::Constant (GREY)}};
  std::vector<std::uint8_t> is_painted (side * side, 0);
  const FieldTriple fields = cloud.colors ();
  const auto length = static_cast<double> (side);
  const auto put = [&] (std::size_t x, std::size_t y, const Colour& colour) {
    image.pixels[y * side + x] = colour.array ().round ().cast<std::uint8_t> ();
    is_painted[y * side + x] = 1;
  };
  for (std::size_t t = 0; t < triangles.size (); ++t) {
    std::array<Eigen::Vector2d, 3> corners;
    std::array<Colour, 3> colours;
    for (std::size_t i = 0; i < 3; ++i) {
      // The image has its first row at the top, and so the corners run clockwise in it.
      const Eigen::Vector2d uv = texture.coordinates[texture.corners[t][2 - i]].cast<double> ();
      corners[i] = length * Eigen::Vector2d (uv.x (), 1.0 - uv.y ());
      colours[i] = vectorOf (fields, cloud.row (triangles[t][2 - i]));
    }
    const Eigen::Vector2d a = corners[1] - corners[0], b = corners[2] - corners[0];
    if (a.x () * b.y () - a.y () * b.x () > 0.0)
      visitPixels (
          corners, side, [&] (std::size_t x, std::size_t y, const Eigen::Vector3d& shares) {
            put (x, y, shares[0] * colours[0] + shares[1] * colours[1] + shares[2] * colours[2]);
          });
    // Triangles between the middles of pixels leave their colours at their corners.
    for (std::size_t i = 0; i < 3; ++i) {
      const auto pixelOf = [side] (double at) {
        return std::min (static_cast<std::size_t> (std::max (at, 0.0)), side - 1);
      };
      const std::size_t x = pixelOf (corners[i].x ()), y = pixelOf (corners[i].y ());
      if (is_painted[y * side + x] == 0)
        put (x, y, colours[i]);
    }
  }
  spread (image, is_painted);
  return image;
}

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mipmap.h"

#include <Eigen/LU>

namespace pcl::floater {
namespace {
// Of the pixels x and x + 1 of `size`, where x is counted from the middle of the first.
std::array<std::size_t, 2>
neighbours (double x, std::size_t size)
{
  const double last = static_cast<double> (size - 1);
  return {static_cast<std::size_t> (std::clamp (x, 0.0, last)),
          static_cast<std::size_t> (std::clamp (x + 1.0, 0.0, last))};
}

Colour
colourIn (const ColourImage& image, const Eigen::Vector2d& at)
{
  const double x = at.x () * static_cast<double> (image.width) - 0.5;
  const double y = (1.0 - at.y ()) * static_cast<double> (image.height) - 0.5;
  const std::array<std::size_t, 2> columns = neighbours (std::floor (x), image.width),
                                   rows = neighbours (std::floor (y), image.height);
  const double right = x - std::floor (x), down = y - std::floor (y);
  Colour colour = Colour::Zero ();
  for (std::size_t i = 0; i < 4; ++i) {
    const ColourImage::Pixel& pixel = image.pixels[rows[i / 2] * image.width + columns[i % 2]];
    colour += (i % 2 == 0 ? 1.0 - right : right) * (i / 2 == 0 ? 1.0 - down : down) / 255.0 *
              Colour (pixel[0], pixel[1], pixel[2]);
  }
  return colour;
}

ColourImage
halved (const ColourImage& image)
{
  ColourImage half{
      std::max<std::size_t> (image.width / 2, 1), std::max<std::size_t> (image.height / 2, 1), {}};
  half.pixels.resize (half.width * half.height);
  for (std::size_t i = 0; i < half.pixels.size (); ++i) {
    const std::size_t left = 2 * (i % half.width), top = 2 * (i / half.width);
    const std::size_t right = std::min (left + 1, image.width - 1);
    const std::size_t bottom = std::min (top + 1, image.height - 1);
    for (std::size_t channel = 0; channel < 3; ++channel)
      half.pixels[i][channel] =
          static_cast<std::uint8_t> ((image.pixels[top * image.width + left][channel] +
                                      image.pixels[top * image.width + right][channel] +
                                      image.pixels[bottom * image.width + left][channel] +
                                      image.pixels[bottom * image.width + right][channel]) /
                                     4);
  }
  return half;
}

} // namespace

Mipmap::Mipmap (ColourImage image) : images_{std::move (image)}
{
  while (images_.back ().width > 1 || images_.back ().height > 1)
    images_.push_back (halved (images_.back ()));
}

double
Mipmap::level (const std::array<Eigen::Vector2d, 3>& at, const std::array<Spot, 3>& corners) const
{
  const auto& [a, b, c] = corners;
  Eigen::Matrix2d on_canvas, in_image;
  on_canvas << b.x - a.x, c.x - a.x, b.y - a.y, c.y - a.y;
  in_image << at[1] - at[0], at[2] - at[0];
  const Eigen::Vector2d size (images_[0].width, images_[0].height);
  const double steps =
      (size.asDiagonal () * in_image * on_canvas.inverse ()).colwise ().norm ().maxCoeff ();
  // No less than 1, also where the triangle is a line on the canvas.
  return std::log2 (std::max (1.0, steps));
}

Colour
Mipmap::colour (const Eigen::Vector2d& at, double level) const
{
  const auto last = static_cast<double> (images_.size () - 1);
  const double coarse = std::min (std::ceil (level), last),
               fine = std::min (std::floor (level), last);
  const double share = std::min (level, last) - fine;
  return (1.0 - share) * colourIn (images_[static_cast<std::size_t> (fine)], at) +
         share * colourIn (images_[static_cast<std::size_t> (coarse)], at);
}

} // namespace pcl::floater

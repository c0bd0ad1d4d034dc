// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// An image on a surface.
#pragma once

#include "canvas.h"

#include <Eigen/LU>

namespace pcl::floater {
/// An image in several sizes, each half of the one before, so that no pixel of it is passed over
/// where many are in one of the canvas.
class Mipmap
{
public:
  explicit Mipmap (const ColourImage& image) : images_{image}
  {
    while (std::min (images_.back ().width, images_.back ().height) > 1)
      images_.push_back (halved (images_.back ()));
  }

  /// The size whose pixels are as large as those of the canvas: 0 for the image itself, 1 for its
  /// half, and so on.
  /// \param at places of the corners of a triangle in the image, from 0 to 1, y upwards
  double level (const std::array<Eigen::Vector2d, 3>& at, const std::array<Spot, 3>& corners) const
  {
    const auto& [a, b, c] = corners;
    Eigen::Matrix2d on_canvas, in_image;
    on_canvas << b.x - a.x, c.x - a.x, b.y - a.y, c.y - a.y;
    in_image << at[1] - at[0], at[2] - at[0];
    const Eigen::Vector2d size (images_[0].width, images_[0].height);
    const double steps =
        (size.asDiagonal () * in_image * on_canvas.inverse ()).colwise ().norm ().maxCoeff ();
    const auto last = static_cast<double> (images_.size () - 1);
    return std::min (std::log2 (std::max (1.0, steps)), last); // 0 also if there is no inverse
  }

  /// The colour at a place, averaged linearly between pixels, and between sizes.
  Colour colour (const Eigen::Vector2d& at, double level) const
  {
    const double fine = std::floor (level);
    return mix (colourIn (images_[static_cast<std::size_t> (fine)], at),
                colourIn (images_[static_cast<std::size_t> (std::ceil (level))], at), level - fine);
  }

private:
  static ColourImage halved (const ColourImage& image)
  {
    ColourImage half{image.width / 2, image.height / 2, {}};
    for (std::size_t y = 0; y < half.height; ++y)
      for (std::size_t x = 0; x < half.width; ++x) {
        const auto* const above = &image.pixels[2 * y * image.width + 2 * x];
        const auto* const below = above + image.width;
        ColourImage::Pixel& mean = half.pixels.emplace_back ();
        for (std::size_t i = 0; i < mean.size (); ++i)
          mean[i] = static_cast<std::uint8_t> (
              (above[0][i] + above[1][i] + below[0][i] + below[1][i]) / 4);
      }
    return half;
  }

  static Colour mix (const Colour& a, const Colour& b, double share)
  {
    return (1.0 - share) * a + share * b;
  }

  static Colour colourIn (const ColourImage& image, const Eigen::Vector2d& at)
  {
    const auto columns = static_cast<double> (image.width),
               rows = static_cast<double> (image.height);
    const double x = std::clamp (at.x () * columns - 0.5, 0.0, columns - 1.0);
    const double y = std::clamp ((1.0 - at.y ()) * rows - 0.5, 0.0, rows - 1.0);
    const auto left = static_cast<std::size_t> (x), top = static_cast<std::size_t> (y);
    const std::size_t right = std::min (left + 1, image.width - 1);
    const auto inRow = [&] (std::size_t row) {
      const auto colourOf = [&] (std::size_t column) -> Colour {
        const ColourImage::Pixel& pixel = image.pixels[row * image.width + column];
        return Colour (pixel[0], pixel[1], pixel[2]) / 255.0;
      };
      return mix (colourOf (left), colourOf (right), x - std::floor (x));
    };
    return mix (inRow (top), inRow (std::min (top + 1, image.height - 1)), y - std::floor (y));
  }

  std::vector<ColourImage> images_;
};

} // namespace pcl::floater

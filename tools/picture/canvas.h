// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles and lines as pixels.
#pragma once

#include "mesh_texture.h"

namespace pcl::floater {
using Colour = Eigen::Vector3d; ///< red, green, blue from 0 to 1

/// A point of space on the canvas.
struct Spot
{
  double x, y;     ///< in pixels from the upper left corner
  double nearness; ///< what is nearer hides what is farther; linear on the canvas
  double weight;   ///< 1 over the distance from the viewer in perspective, else 1
};

/// The image with one pixel for each block of two by two, of their mean colour.
inline ColourImage
halved (const ColourImage& image)
{
  ColourImage half{image.width / 2, image.height / 2, {}};
  for (std::size_t y = 0; y < half.height; ++y)
    for (std::size_t x = 0; x < half.width; ++x) {
      const auto* const above = &image.pixels[2 * (y * image.width + x)];
      const auto* const below = above + image.width;
      ColourImage::Pixel& mean = half.pixels.emplace_back ();
      for (std::size_t c = 0; c < mean.size (); ++c)
        mean[c] =
            static_cast<std::uint8_t> ((above[0][c] + above[1][c] + below[0][c] + below[1][c]) / 4);
    }
  return half;
}

/// A white square on which triangles and lines hide each other.
class Canvas
{
public:
  /// \param side in pixels
  explicit Canvas (std::size_t side)
      : side_ (side), nearness_ (side * side, -std::numeric_limits<float>::infinity ()),
        image_{side, side, std::vector<ColourImage::Pixel> (side * side, {255, 255, 255})}
  {
  }

  double side () const { return static_cast<double> (side_); }

  /// \param shade gives the colour of a point of it from the shares of its corners, which sum to 1
  template <typename Shade>
  void fill (const std::array<Spot, 3>& corners, const Shade& shade, double opacity = 1.0)
  {
    constexpr double SMALLEST = 1e-6; // pixels; below, the shares would be noise
    const auto& [a, b, c] = corners;
    const double area = std::abs (signedArea (corners));
    if (!(area > SMALLEST && area < std::numeric_limits<double>::max ()))
      return;
    const Eigen::Vector3d weights (a.weight, b.weight, c.weight);
    const Eigen::Vector3d nearness (a.nearness, b.nearness, c.nearness);
    visitPixels ({{{a.x, a.y}, {b.x, b.y}, {c.x, c.y}}}, side_,
                 [&] (std::size_t x, std::size_t y, const Eigen::Vector3d& shares) {
                   const std::size_t pixel = y * side_ + x;
                   const auto its = static_cast<float> (shares.dot (nearness));
                   if (its < nearness_[pixel]) // it is hidden
                     return;
                   nearness_[pixel] = its;
                   const Eigen::Vector3d weighted = shares.cwiseProduct (weights);
                   const Colour wanted =
                       255.0 * shade (Eigen::Vector3d (weighted / weighted.sum ()));
                   for (std::size_t channel = 0; channel < 3; ++channel) {
                     std::uint8_t& value = image_.pixels[pixel][channel];
                     value = static_cast<std::uint8_t> (std::lround (
                         value + opacity * (wanted[static_cast<Eigen::Index> (channel)] - value)));
                   }
                 });
  }

  /// Twice the area of a triangle in pixels; negative if its corners run anticlockwise on the
  /// canvas.
  static double signedArea (const std::array<Spot, 3>& corners)
  {
    const auto& [a, b, c] = corners;
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  }

  /// \param width in pixels
  void drawLine (const Spot& from, const Spot& to, int width, const Colour& colour, double opacity)
  {
    const Eigen::Vector2d along = Eigen::Vector2d (to.x - from.x, to.y - from.y).normalized ();
    const auto beside = [&along, width] (Spot spot, double side) {
      spot.x -= 0.5 * side * width * along.y ();
      spot.y += 0.5 * side * width * along.x ();
      return spot;
    };
    const auto shade = [&colour] (const Eigen::Vector3d& /*shares*/) { return colour; };
    fill ({beside (from, 1.0), beside (from, -1.0), beside (to, 1.0)}, shade, opacity);
    fill ({beside (to, -1.0), beside (from, -1.0), beside (to, 1.0)}, shade, opacity);
  }

  const ColourImage& image () const { return image_; }

private:
  std::size_t side_;
  std::vector<float> nearness_;
  ColourImage image_;
};

/// An image on a mesh, in a size in which its pixels are about as large as those of the canvas, so that
/// none is passed over.
class Texture
{
public:
  /// \param pixels of the image in one of the canvas, along a side
  Texture (ColourImage image, double pixels) : image_ (std::move (image))
  {
    constexpr double MOST = 1.5;
    for (; pixels > MOST && std::min (image_.width, image_.height) > 1; pixels /= 2.0)
      image_ = halved (image_);
  }

  /// The colour at a place from 0 to 1, y upwards, averaged linearly between pixels.
  Colour operator() (const Eigen::Vector2d& at) const
  {
    const auto columns = static_cast<double> (image_.width),
               rows = static_cast<double> (image_.height);
    const double x = std::clamp (at.x () * columns - 0.5, 0.0, columns - 1.0);
    const double y = std::clamp ((1.0 - at.y ()) * rows - 0.5, 0.0, rows - 1.0);
    const auto left = static_cast<std::size_t> (x), top = static_cast<std::size_t> (y);
    Colour colour = Colour::Zero ();
    for (const std::size_t down : {0, 1})
      for (const std::size_t right : {0, 1}) {
        const auto& pixel = image_.pixels[std::min (top + down, image_.height - 1) * image_.width +
                                          std::min (left + right, image_.width - 1)];
        const double share = (right == 1 ? x - std::floor (x) : 1.0 - x + std::floor (x)) *
                             (down == 1 ? y - std::floor (y) : 1.0 - y + std::floor (y));
        colour += share / 255.0 * Colour (pixel[0], pixel[1], pixel[2]);
      }
    return colour;
  }

private:
  ColourImage image_;
};

} // namespace pcl::floater

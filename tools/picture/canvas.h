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
  Eigen::Vector2d at; ///< in pixels from the upper left corner
  double nearness;    ///< what is nearer hides what is farther; linear on the canvas
  double weight;      ///< 1 over the distance from the viewer in perspective, else 1
};

/// The image with one pixel for each block of two by two, of their mean colour.
inline ColourImage
halved (const ColourImage& image)
{
  ColourImage half{image.width / 2, image.height / 2, {}};
  for (std::size_t y = 0; y < half.height; ++y)
    for (std::size_t x = 0; x < half.width; ++x) {
      const auto pixel = [&, above = 2 * (y * image.width + x)] (std::size_t i) {
        return image.pixels[above + i].cast<int> ();
      };
      const Eigen::Vector3i sum =
          pixel (0) + pixel (1) + pixel (image.width) + pixel (image.width + 1);
      half.pixels.emplace_back ((sum / 4).cast<std::uint8_t> ());
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
        image_{side, side, std::vector (side * side, ColourImage::Pixel (255, 255, 255))}
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
    visitPixels ({a.at, b.at, c.at}, side_,
                 [&] (std::size_t x, std::size_t y, const Eigen::Vector3d& shares) {
                   const std::size_t pixel = y * side_ + x;
                   const auto its = static_cast<float> (shares.dot (nearness));
                   if (its < nearness_[pixel]) // it is hidden
                     return;
                   nearness_[pixel] = its;
                   const Eigen::Vector3d weighted = shares.cwiseProduct (weights);
                   const Colour wanted =
                       255.0 * shade (Eigen::Vector3d (weighted / weighted.sum ()));
                   const Colour before = image_.pixels[pixel].cast<double> ();
                   const Colour mixed = before + opacity * (wanted - before);
                   image_.pixels[pixel] = mixed.array ().round ().cast<std::uint8_t> ();
                 });
  }

  /// Twice the area of a triangle in pixels; negative if its corners run anticlockwise on the
  /// canvas.
  static double signedArea (const std::array<Spot, 3>& corners)
  {
    const auto& [a, b, c] = corners;
    const Eigen::Vector2d u = b.at - a.at, v = c.at - a.at;
    return u.x () * v.y () - u.y () * v.x ();
  }

  /// \param width in pixels
  void drawLine (const Spot& from, const Spot& to, int width, const Colour& colour, double opacity)
  {
    const Eigen::Vector2d along = (to.at - from.at).normalized ();
    const auto beside = [&along, width] (Spot spot, double side) {
      spot.at += 0.5 * side * width * Eigen::Vector2d (-along.y (), along.x ());
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

/// The colour of an image at a place from 0 to 1, y upwards, averaged linearly between pixels.
inline Colour
colourAt (const ColourImage& image, const Eigen::Vector2d& at)
{
  const auto columns = static_cast<double> (image.width), rows = static_cast<double> (image.height);
  const double x = std::clamp (at.x () * columns - 0.5, 0.0, columns - 1.0);
  const double y = std::clamp ((1.0 - at.y ()) * rows - 0.5, 0.0, rows - 1.0);
  const auto left = static_cast<std::size_t> (x), top = static_cast<std::size_t> (y);
  Colour colour = Colour::Zero ();
  for (const std::size_t down : {0, 1})
    for (const std::size_t right : {0, 1}) {
      const std::size_t pixel = std::min (top + down, image.height - 1) * image.width +
                                std::min (left + right, image.width - 1);
      const double share = (right == 1 ? x - std::floor (x) : 1.0 - x + std::floor (x)) *
                           (down == 1 ? y - std::floor (y) : 1.0 - y + std::floor (y));
      colour += share / 255.0 * image.pixels[pixel].cast<double> ();
    }
  return colour;
}

} // namespace pcl::floater

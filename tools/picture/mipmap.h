// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// An image on a surface.
#pragma once

#include "canvas.h"

namespace pcl::floater {
/// An image and smaller ones of it, each half as large as the one before, by which it does not
/// flicker where several of its pixels are on one of the canvas.
class Mipmap
{
public:
  explicit Mipmap (ColourImage image);

  /// The size at which a pixel of the image is one of the canvas: 0 for the image itself, 1 for the
  /// half, and so on.
  /// \param at the coordinates of the corners in the image, 0 to 1
  double level (const std::array<Eigen::Vector2d, 3>& at, const std::array<Spot, 3>& corners) const;

  /// The colour at a place, between those of pixels and sizes.
  Colour colour (const Eigen::Vector2d& at, double level) const;

private:
  std::vector<ColourImage> images_;
};

} // namespace pcl::floater

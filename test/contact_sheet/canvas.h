// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A white picture on which pictures and text are put. Pixels count from the upper left corner.
#pragma once

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <string>
#include <vector>

namespace pcl
{
namespace floater
{
using Rgb = std::array<unsigned char, 3>;

class Canvas
{
public:
  Canvas (int width, int height);

  /// Puts a picture of three colours with its upper left corner at (x, y).
  void put (vtkImageData* picture, int x, int y);

  /// One line of text whose upper left corner is at (x, y). \param size of the font, in pixels
  void write (const std::string& text, int x, int y, int size, bool bold, const Rgb& colour);

  vtkImageData* image () const { return image_; }

private:
  unsigned char* pixel (int x, int y);

  int width_, height_;
  vtkSmartPointer<vtkImageData> image_;
};

/// Breaks a text between words into lines of at most `length` characters. The last of at most
/// `most` lines ends in "..." if there is more.
std::vector<std::string>
wrap (const std::string& text, std::size_t length, std::size_t most);

} // namespace floater
} // namespace pcl

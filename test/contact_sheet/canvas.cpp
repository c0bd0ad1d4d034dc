// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "canvas.h"

#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace pcl
{
namespace floater
{
namespace
{
constexpr int CHANNELS = 3;
constexpr int DOTS_PER_INCH = 72; // a point of the font is a pixel
constexpr unsigned char WHITE = 255;

} // namespace

Canvas::Canvas (int width, int height)
    : width_ (width), height_ (height), image_ (vtkSmartPointer<vtkImageData>::New ())
{
  image_->SetDimensions (width, height, 1);
  image_->AllocateScalars (VTK_UNSIGNED_CHAR, CHANNELS);
  auto* first = static_cast<unsigned char*> (image_->GetScalarPointer ());
  std::fill_n (first, static_cast<std::size_t> (CHANNELS) * width * height, WHITE);
}

// VTK's rows begin at the bottom.
unsigned char*
Canvas::pixel (int x, int y)
{
  return static_cast<unsigned char*> (image_->GetScalarPointer (x, height_ - 1 - y, 0));
}

void
Canvas::put (vtkImageData* picture, int x, int y)
{
  const std::array<int, 3> size{picture->GetDimensions ()[0], picture->GetDimensions ()[1], 1};
  for (int row = 0; row < size[1] && y + row < height_; ++row) {
    const auto* from =
        static_cast<unsigned char*> (picture->GetScalarPointer (0, size[1] - 1 - row, 0));
    std::copy_n (from, CHANNELS * std::min (size[0], width_ - x), pixel (x, y + row));
  }
}

void
Canvas::write (const std::string& text, int x, int y, int size, bool bold, const Rgb& colour)
{
  vtkNew<vtkTextProperty> font;
  font->SetFontFamilyToArial ();
  font->SetFontSize (size);
  font->SetBold (bold ? 1 : 0);
  vtkNew<vtkImageData> ink;
  std::array<int, 2> used{};
  if (!vtkTextRenderer::GetInstance ()->RenderString (font, vtkStdString (text), ink, used.data (),
                                                      DOTS_PER_INCH))
    throw std::runtime_error ("VTK could not write '" + text + "'");
  const std::array<int, 6> extent{
      ink->GetExtent ()[0], ink->GetExtent ()[1], ink->GetExtent ()[2], ink->GetExtent ()[3], 0, 0};
  for (int row = 0; row < used[1] && y + row < height_; ++row)
    for (int column = 0; column < used[0] && x + column < width_; ++column) {
      const auto* rgba = static_cast<unsigned char*> (
          ink->GetScalarPointer (extent[0] + column, extent[2] + used[1] - 1 - row, 0));
      unsigned char* to = pixel (x + column, y + row);
      for (std::size_t c = 0; c < CHANNELS; ++c)
        to[c] = static_cast<unsigned char> (
            (rgba[CHANNELS] * colour[c] + (WHITE - rgba[CHANNELS]) * to[c]) / WHITE);
    }
}

std::vector<std::string>
wrap (const std::string& text, std::size_t length, std::size_t most)
{
  std::vector<std::string> lines;
  std::istringstream words (text);
  for (std::string word; words >> word;) {
    if (lines.empty () || lines.back ().size () + 1 + word.size () > length) {
      if (lines.size () == most) {
        lines.back ().resize (std::min (lines.back ().size (), length - 4));
        lines.back () += " ...";
        return lines;
      }
      lines.push_back (word);
    }
    else
      lines.back () += " " + word;
  }
  return lines;
}

} // namespace floater
} // namespace pcl

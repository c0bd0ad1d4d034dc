// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "colour_image.h"

#include "read_error.h"

#include <lodepng.h>

#include <cstring>
#include <new>
#include <string>

namespace pcl::floater {
std::vector<unsigned char>
pngOf (const ColourImage& image)
{
  lodepng::State state;
  state.info_raw.colortype = state.info_png.color.colortype = LCT_RGB;
  state.encoder.auto_convert = 0; // no palette: one kind of file, whatever is in it
  std::vector<unsigned char> png;
  if (lodepng::encode (png, image.pixels.data ()->data (), static_cast<unsigned> (image.width),
                       static_cast<unsigned> (image.height), state) != 0)
    throw std::bad_alloc (); // nothing else can fail
  return png;
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
  std::memcpy (image.pixels.data (), bytes.data (), bytes.size ());
  return image;
}

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// PNG (ISO/IEC 15948) of one kind only: 8-bit colours, one stream of data.
#include "mesh_texture.h"

#include <stdexcept>
#ifdef PCL_FLOATER_HAS_ZLIB
#include <zlib.h>

#include <new>
#endif

namespace pcl::floater {
bool
canWritePng ()
{
#ifdef PCL_FLOATER_HAS_ZLIB
  return true;
#else
  return false;
#endif
}

#ifdef PCL_FLOATER_HAS_ZLIB
namespace {
using Bytes = std::vector<unsigned char>;

void
appendNumber (Bytes& bytes, std::size_t number)
{
  for (const unsigned shift : {24U, 16U, 8U, 0U})
    bytes.push_back (static_cast<unsigned char> (number >> shift & 0xFFU));
}

// Length, name, content, and the checksum of the two last.
void
appendChunk (Bytes& bytes, const char* name, const Bytes& content)
{
  appendNumber (bytes, content.size ());
  const std::size_t begin = bytes.size ();
  bytes.insert (bytes.end (), name, name + 4);
  bytes.insert (bytes.end (), content.begin (), content.end ());
  appendNumber (bytes, crc32_z (0, bytes.data () + begin, bytes.size () - begin));
}

// Each row after the number of its filter: 1, differences from the pixel to the left.
Bytes
filteredRows (const ColourImage& image)
{
  constexpr unsigned char DIFFERENCES = 1;
  Bytes rows;
  rows.reserve (image.side * (3 * image.side + 1));
  for (std::size_t y = 0; y < image.side; ++y) {
    rows.push_back (DIFFERENCES);
    std::array<std::uint8_t, 3> left{};
    for (std::size_t x = 0; x < image.side; ++x) {
      const std::array<std::uint8_t, 3>& pixel = image.pixels[y * image.side + x];
      for (std::size_t channel = 0; channel < 3; ++channel)
        rows.push_back (static_cast<unsigned char> (pixel[channel] - left[channel]));
      left = pixel;
    }
  }
  return rows;
}

} // namespace
#endif

std::vector<unsigned char>
pngOf (const ColourImage& image)
{
#ifdef PCL_FLOATER_HAS_ZLIB
  Bytes header;
  appendNumber (header, image.side);
  appendNumber (header, image.side);
  header.insert (header.end (), {8, 2, 0, 0, 0}); // bits, colours, and the only methods there are
  const Bytes rows = filteredRows (image);
  uLongf size = compressBound (static_cast<uLong> (rows.size ()));
  Bytes data (size);
  if (compress2 (data.data (), &size, rows.data (), static_cast<uLong> (rows.size ()),
                 Z_DEFAULT_COMPRESSION) != Z_OK)
    throw std::bad_alloc (); // no other failure is possible with a buffer of that size
  data.resize (size);
  Bytes png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  appendChunk (png, "IHDR", header);
  appendChunk (png, "IDAT", data);
  appendChunk (png, "IEND", {});
  return png;
#else
  static_cast<void> (image);
  throw std::runtime_error ("this build cannot write PNG files: it was built without zlib");
#endif
}

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "las_file.h"

namespace pcl::floater {
std::string
lasBytes (const LasFile& file)
{
  // Tables of the specification, LAS 1.4 - R15: 3 (header), 7 to 17 (points).
  constexpr std::array<std::size_t, 11> SIZES{20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
  constexpr std::array<std::size_t, 11> COLORS{0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30};
  constexpr std::size_t VARIABLE_RECORD = 54;
  const std::size_t header_size = file.minor >= 4 ? 375 : file.minor == 3 ? 235 : 227;
  const auto format = static_cast<std::size_t> (file.format);
  const std::size_t record = SIZES[format] + file.extra_bytes;
  const std::size_t points_at = header_size + file.variable_records * VARIABLE_RECORD;
  std::string bytes (points_at + file.points.size () * record, '\0');
  bytes.replace (0, 4, "LASF");
  putNumber (bytes, 24, std::uint8_t{1});
  putNumber (bytes, 25, static_cast<std::uint8_t> (file.minor));
  putNumber (bytes, 94, static_cast<std::uint16_t> (header_size));
  putNumber (bytes, 96, static_cast<std::uint32_t> (points_at));
  putNumber (bytes, 100, static_cast<std::uint32_t> (file.variable_records));
  putNumber (bytes, 104, static_cast<std::uint8_t> (format));
  putNumber (bytes, 105, static_cast<std::uint16_t> (record));
  const bool has_new_count = file.minor >= 4;
  if (!has_new_count || format < 6)
    putNumber (bytes, 107, static_cast<std::uint32_t> (file.points.size ()));
  if (has_new_count)
    putNumber (bytes, 247, static_cast<std::uint64_t> (file.points.size ()));
  for (int axis = 0; axis < 3; ++axis) {
    putNumber (bytes, 131 + 8 * static_cast<std::size_t> (axis), file.scale[axis]);
    putNumber (bytes, 155 + 8 * static_cast<std::size_t> (axis), file.offset[axis]);
  }
  for (std::size_t p = 0; p < file.points.size (); ++p) {
    const std::size_t at = points_at + p * record;
    for (std::size_t axis = 0; axis < 3; ++axis)
      putNumber (bytes, at + 4 * axis, file.points[p][axis]);
    putNumber (bytes, at + 12, static_cast<std::uint16_t> (7 * p));
    if (COLORS[format] > 0 && !file.colors.empty ())
      for (std::size_t channel = 0; channel < 3; ++channel)
        putNumber (bytes, at + COLORS[format] + 2 * channel, file.colors[p][channel]);
  }
  return bytes;
}

} // namespace pcl::floater

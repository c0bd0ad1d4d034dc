// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// LAS files for the tests, from the specification and from nothing of the reader.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl::floater {
/// What a LAS file is made of.
struct LasFile
{
  int minor = 2;  ///< version 1.minor
  int format = 0; ///< of the points
  Eigen::Vector3d scale{0.01, 0.01, 0.01};
  Eigen::Vector3d offset{0.0, 0.0, 0.0};
  std::vector<std::array<std::int32_t, 3>> points;  ///< before scale and offset
  std::vector<std::array<std::uint16_t, 3>> colors; ///< one for each point, or none
  std::size_t extra_bytes = 0;                      ///< after each point
  std::size_t variable_records = 0;                 ///< between the header and the points
};

/// The bytes of the file. The intensity of point i is 7 * i.
std::string
lasBytes (const LasFile& file);

/// Puts a little-endian number into bytes.
template <typename T>
void
putNumber (std::string& bytes, std::size_t at, T number)
{
  const auto* const from = reinterpret_cast<const char*> (&number);
  for (std::size_t i = 0; i < sizeof (T); ++i)
    bytes.at (at + i) = from[i]; // on the machines of the tests
}

} // namespace pcl::floater

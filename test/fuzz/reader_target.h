// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the fuzz targets of all readers of clouds have in common.
#pragma once

#include "cloud_reader.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace pcl::floater::fuzz {
[[noreturn]] inline void
fail (const char* fault)
{
  std::fprintf (stderr, "fault: %s\n", fault);
  std::abort ();
}

/// Reads every value of a cloud, as the tool does when it writes a mesh. Ends the program if the
/// cloud does not hold together.
inline void
useCloud (Cloud& cloud)
{
  if (cloud.size () == 0 || cloud.size () != cloud.rows)
    fail ("the cloud has no points, or not those of its rows");
  const std::vector<Eigen::Vector3d> positions = cloud.positions ();
  std::size_t values = 0, numbers = 0;
  for (const Field& field : cloud.fields)
    for (std::size_t row = 0; row < cloud.rows; ++row)
      visitType (field.type, [&] (auto tag) {
        for (std::size_t c = 0; c < field.count; ++c) {
          ++values;
          numbers +=
              std::isnan (static_cast<double> (field.value<decltype (tag)> (row, c))) ? 0 : 1;
        }
      });
  if (numbers > values) // each has been read
    fail ("there are more numbers than values");
  colorFields (cloud);
  normalFields (cloud);
  std::size_t finite = 0;
  for (const Eigen::Vector3d& position : positions)
    finite += position.allFinite () ? 1 : 0;
  Triangles none;
  if (removeNonFinitePoints (cloud, none) + finite != positions.size ())
    fail ("the points that are not finite are not those that were left out");
  for (std::size_t point = 0; point < finite; ++point)
    if (!cloud.position (point).allFinite ())
      fail ("a point that is left is not finite");
}

/// Parses bytes as a file. It is either a cloud or a ReadError with a message.
template <typename Parse>
void
readBytes (const std::uint8_t* data, std::size_t size, Parse&& parse)
{
  if (size == 0)
    return; // readCloud refuses an empty file
  const FileBytes file (std::string_view (reinterpret_cast<const char*> (data), size));
  try {
    Cloud cloud = parse (file);
    useCloud (cloud);
  }
  catch (const ReadError& error) {
    if (std::string_view (error.what ()).empty ())
      fail ("an error has no message");
  }
}

} // namespace pcl::floater::fuzz

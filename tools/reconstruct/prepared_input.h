// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// From a cloud of a file to the input of the core; and from its outcome to an exit code.
#pragma once

#include "cloud.h"
#include "command_line.h"
#include "format.h"
#include "run_report.h"
#include "scratch_arrays.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl::floater {
/// What is wrong with degrees beside metres.
constexpr const char* DEGREES =
    "x and y seem to be degrees of longitude and latitude, and z metres: "
    "distances make no sense so";

/// Calls read (), and adds the name of the file to a ReadError.
template <typename Read>
auto
readNamed (const std::filesystem::path& path, Read&& read)
{
  try {
    return read ();
  }
  catch (const ReadError& error) {
    throw ReadError ("cannot read " + inputName (path) + ": " + error.what ());
  }
}

/// \param kept_per_point see leastMemory
/// \throws UsageError if so many points cannot be kept below the limit
void
checkMemory (const CommandLine& line, std::size_t points, double kept_per_point = KEPT_PER_POINT);

/// How the command line wants the input read: all digits of a text count if it is shifted.
inline ReadOptions
readOptionsOf (const CommandLine& line)
{
  return {line.auto_shift || line.shift, line.columns, line.classes};
}

/// Copies the positions of the points that are not left out. The other fields of the cloud stay in its file until they are written.
Input
makeInput (const Cloud& cloud);

/// The normals of all points, for what the command line uses them; of several scans,
/// those towards the sensors, for the facing.
/// \throws UsageError if the cloud has none
void
takeNormals (const CommandLine& line, Cloud& cloud, Input& input);

/// Warns if x and y seem to be degrees of longitude and latitude beside heights in metres, with the
/// command that projects them. They are in their range, and names or scales say so; or they are a
/// small area away from the origin, and their extents far below that of z. O(n).
/// \param positions of the cloud, before any shift
void
warnOfDegrees (const std::vector<Eigen::Vector3d>& positions, Cloud& cloud);

/// Where to move the origin so that 32-bit floats hold the coordinates well: the centre of the
/// bounding box of all finite points that are no gross outliers, rounded to the power of ten below
/// its diagonal. (0, 0, 0) if floats hold them well as they are: if the distance of two floats of
/// the size of the coordinates is below a hundredth of the spacing that the points would have on a
/// flat sheet as large as the box. O(n).
Eigen::Vector3d
chooseShift (const std::vector<Eigen::Vector3d>& positions, int threads);

/// Subtracts the origin that was asked for, from the viewpoints as well; without one, that of
/// chooseShift, unless the file has 32-bit numbers or a precision is asked for.
void
shiftOrigin (CommandLine& line, Cloud& cloud, Input& input);

/// Whether to write 32-bit floats: unless doubles are asked for, or floats would put corners of a
/// triangle together, of which a warning tells.
bool
writesSingle (const CommandLine& line, const Triangles& triangles, Cloud& cloud);

/// The exit code of a run.
int
exitCode (const Report& report, const RunFigures& run);

} // namespace pcl::floater

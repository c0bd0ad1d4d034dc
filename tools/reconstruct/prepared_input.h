// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// From a cloud of a file to the input of the core; and from its outcome to an exit code.
#pragma once

#include "cloud.h"
#include "command_line.h"
#include "format.h"
#include "memory_limit.h"
#include "run_report.h"

#include <pcl/surface/floater/reconstruct.h>

#include <functional>

namespace pcl::floater {
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

/// Copies the positions. The other fields of the cloud stay in its file until they are written.
Input
makeInput (const Cloud& cloud);

/// The normals of all points, for what the command line uses them.
/// \throws UsageError if the cloud has none
void
takeNormals (const CommandLine& line, const Cloud& cloud, Input& input);

/// Where to move the origin so that 32-bit floats hold the coordinates well: the centre of the
/// bounding box of all finite points that are no gross outliers, rounded to the power of ten below
/// its diagonal. (0, 0, 0) if floats hold them well as they are: if the distance of two floats of
/// the size of the coordinates is below a hundredth of the spacing that the points would have on a
/// flat sheet as large as the box. O(n).
Eigen::Vector3d
chooseShift (const std::vector<Eigen::Vector3d>& positions, int threads);

/// Subtracts the origin that was asked for, from the viewpoints as well.
void
shiftOrigin (CommandLine& line, Cloud& cloud, Input& input);

/// Whether 32-bit floats hold all finite coordinates. O(n).
/// \param are_decimals the coordinates come from a text without types: a float holds one if its
/// shortest decimal is that number; otherwise, if it is equal
bool
fitSinglePrecision (const std::vector<Eigen::Vector3d>& positions, bool are_decimals);

/// Whether to write 32-bit floats, and a warning if readers may not expect what is written.
/// \param fits_single whether they hold all coordinates; asked only if that decides
/// \param is_shift_asked so that the warning does not advise it
bool
choosePrecision (Precision wanted, MeshFormat output, const std::function<bool ()>& fits_single,
                 bool is_shift_asked, std::vector<std::string>& warnings);

/// The same for a cloud.
/// \param positions of the cloud, after the shift
bool
choosePrecision (Precision wanted, MeshFormat output, const std::vector<Eigen::Vector3d>& positions,
                 bool is_shift_asked, Cloud& cloud);

/// The exit code of a run.
int
exitCode (const Report& report, const RunFigures& run);

} // namespace pcl::floater

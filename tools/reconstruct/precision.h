// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// In which precision, and from which origin, coordinates are written.
#pragma once

#include "cloud.h"
#include "mesh_writer.h"

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

namespace pcl::floater {
/// Where to move the origin so that 32-bit floats hold the coordinates well: the centre of the
/// bounding box of all finite points that are no gross outliers, rounded to the power of ten below
/// its diagonal. (0, 0, 0) if floats hold them well as they are: if the distance of two floats of
/// the size of the coordinates is below a hundredth of the spacing that the points would have on a
/// flat sheet as large as the box. O(n).
Eigen::Vector3d
chooseShift (const std::vector<Eigen::Vector3d>& positions, int threads);

/// Precision of the coordinates in outputs. Readers that expect 32-bit floats, as PCL's loadPLYFile
/// into PointXYZ does, take doubles of a PLY file for (0, 0, 0).
enum class Precision
{
  AUTO,   ///< SINGLE if the input is, or if that holds every coordinate exactly; else DOUBLE
  SINGLE, ///< 32-bit floats; other coordinates are rounded
  DOUBLE  ///< 64-bit floats
};

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

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds that are hard on a reconstruction: most of them are no surface at all.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace pcl
{
namespace floater
{
/// A kind of cloud.
struct HardCloud
{
  std::string name;
  std::string meaning;
  /// \param count number of points, 1000 or more
  /// \return as many points or a few less, the same in every call
  std::vector<Eigen::Vector3d> (*make) (std::size_t count);
  bool closes_holes = false; ///< every boundary loop is filled
  bool is_view = false;      ///< seen from the origin, which the options tell
};

/// All kinds; the first is the ordinary one.
const std::vector<HardCloud>&
hardClouds ();

} // namespace floater
} // namespace pcl

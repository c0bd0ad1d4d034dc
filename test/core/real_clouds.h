// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Real clouds, of the folder PCL_FLOATER_DATA of the environment.
#pragma once

#include "cloud_reader.h"
#include "clouds.h"

#include <cstdlib>
#include <fstream>
#include <string>

namespace pcl::floater::samples {
/// The points of a cloud; none if it is not there.
inline Positions
realCloud (const std::string& name)
{
  const char* const folder = std::getenv ("PCL_FLOATER_DATA");
  const std::string file =
      (folder != nullptr && *folder != '\0' ? folder : PCL_FLOATER_DEFAULT_DATA) + ("/" + name) +
      ".pcd";
  return std::ifstream (file) ? readCloud (file).positions () : Positions{};
}
constexpr const char* NO_REAL_CLOUD = "PCL_FLOATER_DATA names no folder with this cloud";

} // namespace pcl::floater::samples

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers in messages.
#pragma once

#include <cstddef>
#include <string>

namespace pcl::floater {
/// "1 point", "2 points".
inline std::string
counted (std::size_t count, const std::string& noun)
{
  return std::to_string (count) + " " + noun + (count == 1 ? "" : "s");
}

} // namespace pcl::floater

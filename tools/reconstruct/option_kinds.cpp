// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "option_kinds.h"

#include <algorithm>

namespace pcl::floater {
void
addPath (CLI::App& app, const std::string& name, std::filesystem::path& path,
         const std::string& description, const std::string& group, const char* kind)
{
  app.add_option_function<std::string> (
         name, [&path] (const std::string& word) { path = word; }, description)
      ->option_text (kind)
      ->group (group);
}

std::optional<Eigen::Vector3d>
parsePlace (const std::string& word)
{
  Eigen::Vector3d place;
  std::size_t first = 0;
  bool is_good = std::count (word.begin (), word.end (), ',') == 2;
  for (int axis = 0; axis < 3 && is_good; ++axis) {
    const std::size_t comma = std::min (word.find (',', first), word.size ());
    is_good = parseNumber (std::string_view (word).substr (first, comma - first), place[axis]);
    first = comma + 1;
  }
  return is_good && place.allFinite () ? std::optional (place) : std::nullopt;
}

} // namespace pcl::floater

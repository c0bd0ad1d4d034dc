// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "limit_settings.h"

#include "text_scanner.h"

namespace pcl::floater {
std::optional<std::string>
setLimit (const std::string& setting, Limits& limits)
{
  const std::size_t equals = setting.find ('=');
  const std::string name = setting.substr (0, equals);
  const std::string word = equals == std::string::npos ? "" : setting.substr (equals + 1);
  std::optional<std::string> problem = "'" + setting + "' is no NAME=VALUE of a limit";
  const auto offer = [&] (const char* offered, auto& limit, auto least) {
    if (name != offered)
      return;
    if (parseNumber (word, limit) && limit >= least)
      problem.reset ();
    else
      problem = "'" + word + "' is no value of " + name;
  };
  offer ("parts.points", limits.parts.points, std::size_t{1000});
  offer ("parts.rings", limits.parts.rings, std::size_t{1});
  return problem;
}

} // namespace pcl::floater

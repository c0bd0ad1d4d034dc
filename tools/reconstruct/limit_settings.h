// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Limits of the stages by name, which tests and benchmarks vary: --limit NAME=VALUE.
#pragma once

#include "options/stage_limits.h"

#include <optional>
#include <string>

namespace pcl::floater {
/// Changes the limit that a setting such as "parts.points=5000" names.
/// \return why it cannot, if so
std::optional<std::string>
setLimit (const std::string& setting, Limits& limits);

} // namespace pcl::floater

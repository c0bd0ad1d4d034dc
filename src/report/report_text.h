// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Phrases for messages to the user.
#pragma once

#include "core/types.h"
#include "points/points.h"

#include <string>

namespace pcl::floater {
/// Cloud index and position: "point 7 (1.5, 0, 2.25)".
std::string
place (const Points& points, Index p);

/// A number with three significant digits: "15.6", "2.44e+13".
std::string
rounded (double value);

/// "1 edge is", "2 edges are".
std::string
counted (std::size_t count, const char* one, const char* several);

/// " at ..." for a single item, otherwise ", one of them at ...".
std::string
oneAt (std::size_t count, const std::string& place);

} // namespace pcl::floater

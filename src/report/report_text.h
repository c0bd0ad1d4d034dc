// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Phrases that messages to the user are made of.
#pragma once

#include "core/types.h"
#include "points/points.h"

#include <string>

namespace pcl::floater {
/// "point 7 (1.5, 0, 2.25)": its cloud index and its place in the cloud.
std::string
place (const Points& points, Index p);

/// A number with three significant digits: "15.6", "2.44e+13".
std::string
rounded (double value);

/// "1 edge is", "2 edges are".
std::string
counted (std::size_t count, const char* one, const char* several);

/// " at ..." if there is but one thing, else ", one of them at ...".
std::string
oneAt (std::size_t count, const std::string& place);

} // namespace pcl::floater

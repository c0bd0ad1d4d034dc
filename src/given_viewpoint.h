// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a viewpoint that the user gives may be wrong.
#pragma once

#include "options/request.h"
#include "points/points.h"
#include "view/rays.h"

#include <optional>

namespace pcl::floater {
/// Another place from which the points look evenly spaced, if they do not as seen from the given
/// one: then that is likely to be wrong. The origin of the sensor that the file tells is tried
/// first, then a place is searched. Clouds that look even from nowhere, such as a scan that was
/// thinned at random, tell nothing. 0.1 microseconds per point where the given place is right, as
/// long as a search for the viewpoint otherwise.
std::optional<Viewpoint>
contradictingViewpoint (const Points& points, const Viewpoint& given, const Request& request);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Test of a viewpoint that the user gave.
#pragma once

#include "options/request.h"
#include "points/points.h"
#include "view/rays.h"

#include <optional>

namespace pcl::floater {
/// If the points are not evenly spaced as seen from the given viewpoint, but are from another one:
/// that one. The given one is then likely to be wrong. First the sensor origin in the file is
/// tried, then a viewpoint is searched. No result for clouds that are even from nowhere, such as a
/// scan that was thinned at random. 0.1 microseconds per point if the given viewpoint is right,
/// otherwise the time of a search.
std::optional<Viewpoint>
contradictingViewpoint (const Points& points, const Viewpoint& given, const Request& request);

} // namespace pcl::floater

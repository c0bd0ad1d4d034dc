// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The way of a single scan, which is connected as its sensor saw it.
#pragma once

#include "core/problem.h"
#include "options/request.h"
#include "points/points.h"
#include "view/rays.h"

#include <pcl/surface/floater/reconstruct.h>

#include <array>
#include <optional>

namespace pcl::floater {
/// The viewpoint that is given, or the origin of the sensor if the cloud was seen from there.
std::optional<Viewpoint>
knownViewpoint (const Points& points, const std::array<double, 3>& sensor_origin,
                const Request& request);

/// One scan, seen from a viewpoint.
/// \return nothing if too many points are in no triangle of the view, and the viewpoint is not
/// given
std::optional<Problem>
reconstructView (const Points& points, const Viewpoint& viewpoint, const Request& request,
                 Result& result);

/// The same from a viewpoint that is given or told by the file; a given one may be wrong, which a
/// warning tells.
std::optional<Problem>
reconstructKnownView (const Points& points, const Viewpoint& viewpoint, const Request& request,
                      Result& result);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reconstruction of a single scan, which is connected as its sensor saw it.
#pragma once

#include "core/problem.h"
#include "options/stage_limits.h"
#include "points/points.h"
#include "view/rays.h"

#include <pcl/surface/floater/reconstruct.h>

#include <optional>

namespace pcl::floater {
/// The given viewpoint, or the origin of the sensor if the points are evenly spaced from there.
std::optional<Viewpoint>
knownViewpoint (const Points& points, const Request& request);

/// Reconstructs one scan from a viewpoint.
/// \return nothing if too many points are in no triangle of the view and the viewpoint was not
///     given
std::optional<Problem>
reconstructView (const Points& points, const Viewpoint& viewpoint, const Request& request,
                 Result& result);

/// Like reconstructView (), for a viewpoint from the user or the file. Warns if a given one may be
/// wrong.
std::optional<Problem>
reconstructKnownView (const Points& points, const Viewpoint& viewpoint, const Request& request,
                      Result& result);

} // namespace pcl::floater

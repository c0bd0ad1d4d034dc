// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The methods, each from its points to the result and the report.
#pragma once

#include "core/problem.h"
#include "local/local_geometry.h"
#include "options/stage_limits.h"
#include "points/points.h"
#include "view/rays.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl::floater {
/// A disc that is laid out in the plane.
Problem
reconstructDisc (const Points& points, LocalGeometry geometry, const Request& request,
                 Result& result);

/// A surface of any topology, from stars.
Problem
reconstructSurface (const Points& points, LocalGeometry geometry, const Request& request,
                    Result& result);

/// One scan, which is connected as its sensor saw it from a viewpoint.
/// \return nothing if too many points are in no triangle, and the viewpoint was not given
std::optional<Problem>
reconstructView (const Points& points, const Viewpoint& viewpoint, const Request& request,
                 Result& result);

} // namespace pcl::floater

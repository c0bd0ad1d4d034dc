// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a report says of the cloud.
#pragma once

#include "points/coordinate_grid.h"
#include "points/net.h"
#include "points/noise.h"
#include "points/points.h"
#include "view/view_method.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl::floater {
/// Counts, non-finite points and duplicates.
void
reportPoints (const Points& points, Report& report);

/// Points left out of the mesh, with a finding; adds them to those reported before.
/// \param outliers cloud indices
/// \param what     GROSS_OUTLIERS or OUTLIERS
void
reportOutliers (const std::vector<Index>& outliers, FindingId what, Report& report);

/// Points that lie on others.
void
reportStacks (const Points& points, const Stacks& stacks, Report& report);

/// Points on no surface, ascending, and those that lie on them; a finding if they are left out unasked.
void
reportScatter (const Points& points, const std::vector<Index>& scatter, bool is_finding,
               Report& report);

/// The noise; warns if points are connected by their projections.
void
reportNoise (const Noise& noise, bool denoised, Report& report);

/// The step to which coordinates seem to be rounded; warns if it is too coarse.
void
reportCoordinateGrid (const Points& points, const CoordinateGrid& grid, Report& report);

/// The viewpoint, and the triangles left out of the view.
void
reportView (const Points& points, const Viewpoint& viewpoint, const ViewSurface& surface,
            Report& report);

/// Warns that the points are evenly spaced from another viewpoint than the given one.
void
reportOtherViewpoint (const Points& points, const Viewpoint& other, Report& report);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the stages found in the cloud, as the user reads it: cloud indices, counts, warnings in
// words.
#pragma once

#include "core/problem.h"
#include "core/types.h"
#include "points/coordinate_grid.h"
#include "points/noise.h"
#include "view/view_method.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl::floater {
/// Counts, non-finite points and duplicates.
void
reportPoints (const Points& points, Report& report);

/// Why a cloud with a point so far from the others cannot be worked on.
Problem
tooFarAway (Index cloud_index, const Eigen::Vector3d& position);

/// Points left out before the working set was made, since they are many times as far away as all
/// others; a warning on them.
/// \param outliers cloud indices, ascending
void
reportGrossOutliers (const std::vector<Index>& outliers, Report& report);

/// Points left out of the working set, of which `working_points` are left; a warning on them. They
/// are added to the gross outliers.
/// \param outliers cloud indices, ascending
void
reportOutliers (const std::vector<Index>& outliers, std::size_t working_points, Report& report);

/// Points around which no scale is flat.
/// \param scatter ascending
void
reportScatter (const Points& points, const std::vector<Index>& scatter, Report& report);

/// The noise, and a warning if points are connected as they lie in their local planes.
void
reportNoise (const Noise& noise, bool denoised, Report& report);

/// The step to which coordinates seem to be rounded, and a warning if it is too coarse.
void
reportCoordinateGrid (const Points& points, const CoordinateGrid& grid, Report& report);

/// The viewpoint and what was left out of the view.
void
reportView (const Points& points, const Viewpoint& viewpoint, const ViewSurface& surface,
            Report& report);

/// A warning that so many points are in no triangle of a view that the viewpoint may be wrong.
void
reportDoubtfulView (const Points& points, std::size_t unused, Report& report);

/// The points look evenly spaced from this place, and not from the given viewpoint.
void
reportOtherViewpoint (const Points& points, const Viewpoint& other, Report& report);

/// Points of a view that are in no triangle, as outliers; a warning on them.
/// \param unused ascending
void
reportOutliersOfView (const Points& points, const std::vector<Index>& unused, Report& report);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a report says of the cloud and of its front side.
#pragma once

#include "core/problem.h"
#include "core/types.h"
#include "points/coordinate_grid.h"
#include "points/net.h"
#include "points/noise.h"
#include "points/points.h"
#include "view/view_method.h"

#include <pcl/surface/floater/reconstruct.h>

#include <string>

namespace pcl::floater {
/// Reports counts, non-finite points and duplicates.
void
reportPoints (const Points& points, Report& report);

/// The error for a point too far from the others.
Problem
tooFarAway (Index cloud_index, const Eigen::Vector3d& position);

/// Reports and warns of points left out before the working set was made, many times as far away as
/// all others.
/// \param outliers cloud indices, ascending
void
reportGrossOutliers (const std::vector<Index>& outliers, Report& report);

/// Reports and warns of points left out of the working set; adds them to the gross outliers.
/// \param outliers cloud indices, ascending
/// \param working_points number of points that are left
void
reportOutliers (const std::vector<Index>& outliers, std::size_t working_points, Report& report);

/// Reports points of no surface.
/// \param scatter ascending
/// \param is_unasked whether they are left out though nobody asked for it, which is worth a warning
void
reportScatter (const Points& points, const std::vector<Index>& scatter, bool is_unasked,
               Report& report);

/// Reports the points that lie on others.
void
reportStacks (const Points& points, const Stacks& stacks, Report& report);

/// Reports the noise, and warns if points are connected by their projections.
void
reportNoise (const Noise& noise, bool denoised, Report& report);

/// Reports the step to which coordinates seem to be rounded, and warns if it is too coarse.
void
reportCoordinateGrid (const Points& points, const CoordinateGrid& grid, Report& report);

/// Reports the viewpoint and the triangles left out of the view.
void
reportView (const Points& points, const Viewpoint& viewpoint, const ViewSurface& surface,
            Report& report);

/// Warns that many points are in no triangle of a view: the viewpoint may be wrong.
void
reportDoubtfulView (const Points& points, std::size_t unused, Report& report);

/// Warns that the points are evenly spaced from another viewpoint than the given one.
void
reportOtherViewpoint (const Points& points, const Viewpoint& other, Report& report);

/// Reports and warns of points in no triangle of a view, as outliers.
/// \param unused ascending
void
reportOutliersOfView (const Points& points, const std::vector<Index>& unused, Report& report);

} // namespace pcl::floater

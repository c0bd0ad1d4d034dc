// SPDX-License-Identifier: GPL-3.0-or-later
// From what the stages found to what the user reads: cloud indices, counts, warnings in words.
#pragma once

#include "boundary/boundary_loop.h"
#include "common/types.h"
#include "parameterization/parameterize.h"
#include "triangulation/surface_finish.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl
{
namespace floater
{
/// Counts, non-finite points and duplicates.
void
reportWorkingSet (const WorkingSet& set, Report& report);

/// Points left out of the working set, of which `working_points` are left; a warning on them.
/// \param outliers cloud indices, ascending
void
reportOutliers (std::vector<Index> outliers, std::size_t working_points, Report& report);

/// The noise, and a warning if points are connected as they lie in their local planes.
void
reportNoise (double noise, bool denoised, Report& report);

/// Loop, candidates, and a warning where the loop takes a long step.
void
reportBoundary (const WorkingSet& set, const Boundary& boundary, Report& report);

/// Parameter of every cloud point: a duplicate has that of its stand-in. Warnings on linked points.
void
reportParameterization (const WorkingSet& set, const Parameterization& parameterization,
                        Report& report);

/// Triangles in cloud indices, unused points and counts; warnings on unused points and folds.
std::vector<Triangle>
reportMesh (const WorkingSet& set, const SurfaceMesh& mesh, const SurfaceFinish& finish,
            Report& report);

} // namespace floater
} // namespace pcl

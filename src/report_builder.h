// SPDX-License-Identifier: GPL-3.0-or-later
// From what the stages found to what the user reads: cloud indices, counts, warnings in words.
#pragma once

#include "boundary/boundary_loop.h"
#include "common/problem.h"
#include "common/types.h"
#include "mesh_check.h"
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

/// A warning if a surface was cut open since it seems one-sided.
/// \param cut triangles left out for that
void
reportOneSided (const WorkingSet& set, const std::vector<Triangle>& cut, Report& report);

/// The parameterization seen from behind, for a disc that was turned round.
void
mirrorParameters (Report& report);

/// Triangles from working set to cloud indices, and counts.
std::vector<Triangle>
reportMesh (const WorkingSet& set, std::vector<Triangle> triangles, const SurfaceFinish& finish,
            Report& report);

/// What checkMesh () found: its figures, in a few words if they are why no disc was made, points
/// that are in no triangle, but for those that the report lists as outliers, the longest loop if
/// there is none yet, and warnings with places: on unused points, folds, long edges, triangles
/// without area, pieces of a few points, and small holes that no option asked for. \return
/// INTERNAL_ERROR if the mesh is no oriented manifold
Problem
reportCheck (const WorkingSet& set, const MeshExamination& found, const Options& options,
             Report& report);

} // namespace floater
} // namespace pcl

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbours, outliers, noise, and the geometry around each point of a cloud.
#pragma once

#include "local/local_geometry.h"
#include "mesh/facing.h"
#include "options/request.h"
#include "points/neighbors.h"
#include "points/noise.h"

#include <pcl/surface/floater/report.h>

namespace pcl::floater {
/// \param search of the caller; nullptr: a kd-tree of the core's
NeighborSettings
neighborSettings (const Options& options, NeighborSearch* search);

/// Beyond TW 385: takes out points that lie off any surface, which would be woven in as spikes.
/// Those that the user's loop names stay.
void
removeOutliers (Points& points, CsrLists& neighbors, const NeighborSettings& settings,
                const Request& request, Report& report);

/// The same of outliers that are known, ascending; neighbours are not renewed.
void
removeOutliers (Points& points, const std::vector<Index>& outliers, Report& report);

/// Measures noise and looks for scatter, which has no surface at any scale; it is taken out if that
/// is asked for, but for points that the user's loop names.
/// \param planes of the points; made anew where points are taken out
/// \param neighbors those of the planes
/// \return nothing noisy if noise is not to be projected away
/// \param known  of every NOISE_PROBES-th point, if they have been measured before
Noise
measureNoiseAndScatter (Points& points, LocalPlanes& planes, const NeighborTable& neighbors,
                        const NeighborSettings& settings, const Request& request,
                        const NoiseProbes* known, Report& report);

/// How the stars of the points are made.
StarSettings
starSettings (const Request& request);

/// Beyond TW 385: projects noisy points on the planes of the points around, by which they are
/// connected. The mesh is triangles only, so the user's points stay where they are.
/// \param neighbors of the points as they lie
/// \return the geometry around each projected point
LocalGeometry
projectNoise (Points& points, CsrLists neighbors, const Noise& noise,
              const NeighborSettings& settings, const Request& request);

/// What tells which side of a component is its front, as the options ask for it. The normals are
/// those of the points, which must outlive the hints.
FacingHints
facingHints (const Points& points, const Request& request);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbours, outliers, noise, and the geometry around each point of a cloud.
#pragma once

#include "local/local_geometry.h"
#include "mesh/facing.h"
#include "options/stage_limits.h"
#include "points/neighbors.h"
#include "points/noise.h"

#include <pcl/surface/floater/report.h>

namespace pcl::floater {
/// \param search of the caller; nullptr: the kd-tree of the core
NeighborSettings
neighborSettings (const Options& options, NeighborSearch* search);

/// Beyond TW 385: removes points that lie off any surface, which would become spikes. Points of the
/// user's loop are kept.
void
removeOutliers (Points& points, CsrLists& neighbors, const NeighborSettings& settings,
                const Request& request, Report& report);

/// Removes outliers that were found before, ascending; does not renew neighbours.
void
removeOutliers (Points& points, const std::vector<Index>& outliers, Report& report);

/// Measures noise and finds scatter: points without a surface at any scale. Removes scatter if that
/// is requested, except points of the user's loop.
/// \param planes of the points; renewed if points are removed
/// \param neighbors from which the planes were made
/// \param known of every NOISE_PROBES-th point, if measured before
/// \return nothing noisy if denoising is off
Noise
measureNoiseAndScatter (Points& points, LocalPlanes& planes, const NeighborTable& neighbors,
                        const NeighborSettings& settings, const Request& request,
                        const NoiseProbes* known, Report& report);

/// Settings for the stars of the points.
StarSettings
starSettings (const Request& request);

/// Beyond TW 385: projects noisy points on local planes, by which they are connected. The mesh has
/// triangles only, so the user's points stay unchanged.
/// \param neighbors of the unprojected points
/// \return the geometry around each projected point
LocalGeometry
projectNoise (Points& points, CsrLists neighbors, const Noise& noise,
              const NeighborSettings& settings, const Request& request);

/// Evidence for the front of a component, as the options ask for it. Refers to the normals of the
/// points, which must outlive the result.
FacingHints
facingHints (const Points& points, const Request& request);

} // namespace pcl::floater

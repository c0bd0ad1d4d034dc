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
/// Beyond TW 385: points that lie off any surface and are to be left out, since they would become
/// spikes; ascending. Points of the user's loop are kept.
std::vector<Index>
outliersOf (const Points& points, const CsrLists& neighbors, const Request& request);

/// DEGENERATE if the cloud is curves that are too far apart for a surface.
Problem
checkCurves (const Points& points, const LocalGeometry& geometry, const Request& request);

/// Whether scatter is left out of the mesh.
bool
dropsScatter (const Options& options);

/// Scatter: points of regions that are no surface at any scale, ascending; without points of the
/// user's loop if it is left out of the mesh.
std::vector<Index>
scatterOf (const Points& points, const LocalGeometry& geometry, const Noise& noise,
           const Request& request);

/// Reports scatter, and removes it from the points if it is left out of the mesh.
/// \return whether points were removed
bool
takeScatter (Points& points, const std::vector<Index>& scatter, const Options& options,
             Report& report);

/// The neighbours of all points, and their spacing, for fitLocalPlanes ().
LocalPlanes
searchPlanes (const Points& points, const NeighborSettings& settings, const Request& request);

/// Beyond TW 385: projects noisy points on local planes, by which they are connected, where noise
/// explains the disagreement of their stars. The mesh has triangles only, so the user's points stay
/// unchanged.
/// \param geometry around each point
/// \param noise    in: to project; out: of the projected points
/// \return the geometry around each projected point
LocalGeometry
projectNoise (Points& points, LocalGeometry geometry, Noise& noise,
              const NeighborSettings& settings, const Request& request);

/// Evidence for the front of a component, as the options ask for it. Refers to the normals of the
/// points, which must outlive the result.
FacingHints
facingHints (const Points& points, const Request& request);

} // namespace pcl::floater

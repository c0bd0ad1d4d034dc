// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is no surface: clouds that are curves, such as profiles of a scanner, too far apart for one; and
// scatter, points that lie on none at any scale, such as leaves.
#pragma once

#include "local/local_geometry.h"
#include "points/noise.h"

namespace pcl::floater {
/// Whether a cloud is curves: points on lines, or the turns of a sensor that turns about an axis
/// of the coordinates and moves along it, however noisy. A point is joined to another curve if a
/// triangle that its corners agree on has a corner beside its line, or in another turn.
/// \param origin of the cloud's coordinates
/// \param neighbors number of each point's neighbours that are nearest
/// \return if so: the median distance to points beside the curve, in steps along it; 0: unknown
std::optional<double>
findCurves (const Positions& positions, const Vector3d& origin, const LocalGeometry& geometry,
            std::size_t neighbors, const RunContext& run);

/// Finds scatter as regions: points that may be scatter and hang together by their nearest
/// neighbours, many of which are strong; and likewise among far points. O(n).
/// \param noise      its unevenness may be empty
/// \param is_certain only regions that certainly are scatter
/// \return ascending
std::vector<Index>
findScatter (const LocalGeometry& geometry, const Noise& noise, bool is_certain,
             const RunContext& run);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Scatter: points that lie on no surface at any scale, such as leaves.
#pragma once

#include "local/local_geometry.h"
#include "points/noise.h"

namespace pcl::floater {
/// Finds scatter as regions: points that may be scatter and hang together by their nearest
/// neighbours, many of which are strong; and likewise among far points. O(n).
/// \param noise      its unevenness may be empty
/// \param is_certain only regions that certainly are scatter
/// \return ascending
std::vector<Index>
findScatter (const LocalGeometry& geometry, const Noise& noise, bool is_certain,
             const RunContext& run);

} // namespace pcl::floater

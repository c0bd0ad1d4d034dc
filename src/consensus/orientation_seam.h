// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces without an orientation, such as a Moebius strip.
#pragma once

#include "core/types.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Where a one-sided surface was cut open: the longest row of triangles that contradict the
/// orientation (see ConsensusMesh) that hang together by edges, in the order of `contradicting`;
/// empty if it is shorter than SHORTEST_ROW. An orientation that runs once around such a surface
/// meets itself the wrong way along a whole row across it, while a wrong triangle between two
/// sheets stands alone. O(n log n).
///
/// Weakness: strips less than about 4 spacings wide have shorter rows.
std::vector<Triangle>
findOrientationSeam (const std::vector<Triangle>& contradicting);

/// Triangles. Scans of two-sided surfaces had rows of up to 5, strips 4 spacings wide rows of 8,
/// and those 12 spacings wide rows of 37.
constexpr std::size_t SHORTEST_ROW = 8;

} // namespace floater
} // namespace pcl

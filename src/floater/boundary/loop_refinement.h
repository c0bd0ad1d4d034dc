// SPDX-License-Identifier: GPL-3.0-or-later
// Last touches to a boundary loop.
#pragma once

#include "local/stars.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Undoes crossings by 2-opt in a window, and inserts candidates that lie beside an edge of the
/// loop where that costs little detour: left out, such a point would be an interior point beyond
/// the border, and the surface would fold there. \param candidates points that look like boundary,
/// those of the loop among them
void
refineLoop (const std::vector<Eigen::Vector3d>& positions, const Stars& stars,
            const std::vector<float>& spacing, const std::vector<Index>& candidates,
            std::vector<Index>& loop);

} // namespace floater
} // namespace pcl

// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary loop as a rim of the triangles that stars agree on.
#pragma once

#include "boundary/boundary_loop.h"

namespace pcl
{
namespace floater
{
/// Makes the complex (see complex_mesh.h) and takes the rim that HolePolicy::KEEP_LARGEST would
/// keep of the largest piece, the surface on its left. All steps of such a loop are edges of
/// triangles, so that it cuts across nothing; points beside it that no star joined to the rest are
/// not on it. Its candidates are the points of all rims. O(n log n), about 5 microseconds per
/// point.
Boundary
complexLoop (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
             const Stars& stars, const std::vector<float>& spacing, int threads);

} // namespace floater
} // namespace pcl

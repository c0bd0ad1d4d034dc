// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary loop as a rim of the triangles that stars agree on.
#pragma once

#include "boundary/boundary_loop.h"

namespace pcl
{
namespace floater
{
/// Makes the complex (see complex_mesh.h) and takes the rim that HolePolicy::KEEP_LARGEST would
/// keep of the largest piece, the surface on its left. Points with a gap in their star that lie
/// beside it are then inserted (see refineLoop): a ragged border has points that no triangle joins
/// to the rest. Candidates are these points and those of all rims. O(n log n).
Boundary
complexLoop (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
             const Stars& stars, const std::vector<float>& spacing, int threads);

} // namespace floater
} // namespace pcl

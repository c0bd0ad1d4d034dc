// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary loop of a disc as a loop of the triangles that stars agree on.
#pragma once

#include "floater/boundary/boundary.h"
#include "local/local_geometry.h"

namespace pcl
{
namespace floater
{
/// Makes the consensus mesh and takes the loop that HolePolicy::KEEP_LARGEST would keep open of the
/// largest component, the surface on its left. Points with a gap in their star that lie beside it
/// are then inserted (see refineLoop): a ragged border has points that no triangle joins to the
/// rest. Candidates are these points and those of all loops. O(n log n).
Boundary
consensusLoop (const std::vector<Eigen::Vector3d>& positions, const LocalGeometry& geometry,
               const RunContext& run);

} // namespace floater
} // namespace pcl

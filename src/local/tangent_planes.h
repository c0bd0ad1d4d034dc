// SPDX-License-Identifier: GPL-3.0-or-later
// Normals of the points by least-squares planes.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Unit normals, of arbitrary sign: the plane through the 8 nearest points, then refitted to those
/// of all k neighbours that lie near that plane, so that a second sheet within reach does not tilt
/// it. \param near nearest neighbours, nearest first
std::vector<Eigen::Vector3f>
fitTangentPlanes (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                  const RunContext& run);

} // namespace floater
} // namespace pcl

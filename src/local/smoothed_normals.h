// SPDX-License-Identifier: GPL-3.0-or-later
// Mean normals: planes from which both faces of a sharp edge are seen.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Mean of the normals of a point and its 8 nearest, unit length, on the side of its own. On a
/// sharp edge the best plane of the points there is that of either face; the mean lies between the
/// faces.
Eigen::Vector3d
meanNormal (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
            const std::vector<Eigen::Vector3f>& normals, Index p);

/// The mean normals of some points where they are more than 26 degrees (cosine 0.9) off the points'
/// own, which they else are; zero for the other points. O(n).
std::vector<Eigen::Vector3f>
smoothedNormals (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                 const std::vector<Eigen::Vector3f>& normals, const RunContext& run);

/// Nearest points over which the mean is taken.
constexpr std::size_t MEAN_OVER = 8;

} // namespace floater
} // namespace pcl

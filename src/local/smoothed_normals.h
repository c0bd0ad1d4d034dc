// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Smoothed normals: at a sharp edge, both of its faces are visible from them.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "points/rows.h"

#include <vector>

namespace pcl::floater {
/// Mean of the normals of a point and its 8 nearest neighbours, unit length, on the side of its
/// own. At a sharp edge the least-squares plane follows one of the faces; the mean lies between
/// them.
Eigen::Vector3d
meanNormal (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
            const std::vector<Eigen::Vector3f>& normals, Index p);

/// The mean normal of each point where it is more than 26 degrees off the point's normal; otherwise
/// the point's normal. O(n).
/// \param rows points to compute; others are zero
std::vector<Eigen::Vector3f>
smoothedNormals (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                 const std::vector<Eigen::Vector3f>& normals, const Rows& rows,
                 const RunContext& run);

} // namespace pcl::floater

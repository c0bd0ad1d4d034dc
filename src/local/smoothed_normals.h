// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Smoothed normals: planes from which both faces of a sharp edge are seen.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "points/rows.h"

#include <vector>

namespace pcl::floater {
/// Mean of the normals of a point and its 8 nearest neighbours, unit length, on the side of its
/// own. On a sharp edge the plane that fits best is that of either face; the mean lies between the
/// faces.
Eigen::Vector3d
meanNormal (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
            const std::vector<Eigen::Vector3f>& normals, Index p);

/// The mean normals of points where they are more than 26 degrees off the points' own; the points'
/// own normals elsewhere. O(n).
/// \param rows points whose normals are wanted; those of others are zero
std::vector<Eigen::Vector3f>
smoothedNormals (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                 const std::vector<Eigen::Vector3f>& normals, const Rows& rows,
                 const RunContext& run);

} // namespace pcl::floater

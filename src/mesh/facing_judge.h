// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Decides which components of a mesh are flipped.
#pragma once

#include "mesh/facing.h"

#include <vector>

namespace pcl::floater {
/// See faceOutwards.
/// \param together see findTogether
/// \return of each component: 1 if it is to be flipped
std::vector<std::uint8_t>
judgeFacing (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
             const MeshComponents& found, const std::vector<FacingSums>& components,
             std::vector<Continuation> together, const FacingHints& hints,
             const FacingLimits& limits, const RunContext& run, MeshFacing& facing);

} // namespace pcl::floater

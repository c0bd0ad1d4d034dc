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

/// Whether a sheet with this mean normal is to be turned to face up.
bool
facesDown (const Eigen::Vector3d& normal, const FacingLimits& limits);

/// No terrain: it stands.
bool
isUpright (const Eigen::Vector3d& normal, const FacingLimits& limits);

/// Confidence in a decision with this ratio of evidence for and against it, 1 or more. A factor of
/// two gives 0.9.
double
certaintyOf (double factor);

/// Confidence that terrain or a sheet faces up: what lies has been seen from above, what stands from
/// either side, and few roofs are steeper than 45 degrees.
double
certaintyOfUp (const Eigen::Vector3d& normal);

/// Of boxes with openings in their sides only, most are rooms: of a box that was seen from outside,
/// nothing tells what is within, or the bottom is missing. All of the floor lies below the ceiling,
/// as in no part of a machine.
bool
isRoom (const FacingSums& sums, const FacingLimits& limits);

} // namespace pcl::floater

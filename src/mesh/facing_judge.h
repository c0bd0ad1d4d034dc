// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Decides which components of a mesh are flipped.
#pragma once

#include "mesh/facing.h"

#include <vector>

namespace pcl::floater {
/// A mesh to be oriented. Its triangles are requested only if lines of sight are needed.
class FacedMesh
{
public:
  virtual ~FacedMesh () = default;

  virtual const std::vector<Triangle>& triangles () = 0;
  virtual const std::vector<Index>& components () = 0; ///< of each triangle
  virtual const std::vector<Eigen::Vector3d>& positions () = 0;
  virtual std::vector<BoundarySegment> boundary () = 0;
};

/// The hints without a facing that needs an unknown viewpoint.
FacingHints
usableHints (const FacingHints& hints, MeshFacing& facing);

/// See faceOutwards.
/// \param together see findTogether
/// \return of each component: 1 if it is to be flipped
std::vector<std::uint8_t>
judgeFacing (FacedMesh& mesh, const std::vector<FacingSums>& components,
             std::vector<Continuation> together, const FacingHints& hints,
             const FacingLimits& limits, const RunContext& run, MeshFacing& facing);

} // namespace pcl::floater

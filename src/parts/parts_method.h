// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The consensus method for a large cloud: the meshes of its parts, stitched together.
#pragma once

#include "consensus/consensus_method.h"
#include "parts/part_mesh.h"
#include "parts/seam_check.h"

#include <vector>

namespace pcl::floater {
/// Settings of a surface in parts.
struct PartsSettings
{
  SurfaceSettings surface;
  PartLimits parts;
  CheckLimits check;
  UncrossingLimits uncrossing;
  bool remove_self_intersections = true;
  double diagonal = 1.0; ///< see Points

  PartFinishSettings ofPart (const Parts& all) const;
};

/// A finished surface in parts. Its triangles stay with the parts.
struct SurfaceOfParts
{
  Surface surface; ///< without its mesh
  CheckedParts checked;
  std::vector<InnerCheck> checks; ///< of each part
};

/// Makes the surface of a cloud that has several parts. Stages CONSENSUS, HOLES, FLIPS and CHECK.
/// Joint decisions are needed only where the meshes of parts end: O(n / sqrt (m)) for parts of m
/// points. O(n log n).
SurfaceOfParts
makeSurfaceOfParts (const Points& points, const Parts& parts, PartWork& work,
                    const PartsSettings& settings, const RunContext& run);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Check of the finished parts as one mesh.
#pragma once

#include "mesh/check.h"
#include "parts/near_triangles.h"
#include "parts/seam_finish.h"

#include <vector>

namespace pcl::floater {
/// A mesh whose inner triangles are with the parts.
struct MeshOfParts
{
  std::size_t triangles = 0;                        ///< all
  std::vector<std::vector<std::uint8_t>> is_turned; ///< of each part: 1 for components of its inner
                                                    ///< triangles to be flipped
  std::vector<Triangle> seam;                       ///< all other triangles; corners are points
};

/// A mesh in parts, with its check and facing.
struct CheckedParts
{
  MeshOfParts mesh;
  MeshExamination found; ///< with number and positions of self-intersections, but without the pairs
  MeshFacing facing;
  CrossingSum crossing;
};

/// Settings for the check of a mesh in parts.
struct PartsCheckSettings
{
  bool remove_self_intersections = true; ///< except of inner triangles
  CostLimits cost;
  UncrossingLimits uncrossing;
  CheckLimits check;
  FacingHints facing;
  FacingLimits facing_limits;
};

/// Removes self-intersections in the zones, examines the mesh (see checkMesh), and orients its
/// components outwards (see faceOutwards). O(m log m) for m points in all zones. If facing needs
/// lines of sight, the whole mesh is assembled: O(n log n). Crossings of inner triangles of two
/// parts stay.
/// \param checks of all parts
CheckedParts
checkParts (FinishedSeam seam, const std::vector<InnerCheck>& checks, const Parts& parts,
            PartWork& work, const Points& points, const PartsCheckSettings& settings,
            const RunContext& run);

/// All triangles of a mesh in parts: the inner ones of each part, then the others.
std::vector<Triangle>
assembleTriangles (const MeshOfParts& mesh, const std::vector<InnerCheck>& checks,
                   const Parts& parts, PartWork& work, const RunContext& run);

} // namespace pcl::floater

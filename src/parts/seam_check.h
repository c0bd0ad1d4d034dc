// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the finished parts form together.
#pragma once

#include "mesh/check.h"
#include "parts/near_triangles.h"
#include "parts/seam_finish.h"

#include <vector>

namespace pcl::floater {
/// A mesh, most triangles of which stay where the parts are.
struct MeshOfParts
{
  std::size_t triangles = 0;                        ///< all
  std::vector<std::vector<std::uint8_t>> is_turned; ///< of each part: 1 for the components of its
                                                    ///< inner triangles that are to be turned round
  std::vector<Triangle> seam; ///< all triangles that are not inner ones; corners are points
};

/// A mesh in parts, and what is known of it.
struct CheckedParts
{
  MeshOfParts mesh;
  MeshExamination found; ///< with the number and places of crossing triangles, but without the
                         ///< pairs themselves
  MeshFacing facing;
  CrossingSum crossing;
};

/// How a finished mesh in parts is checked.
struct PartsCheckSettings
{
  bool remove_self_intersections = true; ///< of triangles that are not inner ones
  CostLimits cost;
  UncrossingLimits uncrossing;
  CheckLimits check;
  FacingHints facing;
  FacingLimits facing_limits;
};

/// Removes crossings of triangles that are not inner ones, examines the mesh (see checkMesh), and
/// turns its components to face outwards (see faceOutwards). O(m log m) for m points in all zones.
/// If facing needs lines of sight, the whole mesh is assembled: O(n log n). Inner triangles of two
/// parts that cross each other stay as they are.
/// \param checks of all parts
/// \param points their positions need not be in memory
CheckedParts
checkParts (FinishedSeam seam, const std::vector<InnerCheck>& checks, const Parts& parts,
            PartWork& work, const Points& points, const PartsCheckSettings& settings,
            const RunContext& run);

/// All triangles of a mesh in parts: the inner ones of each part, then the others.
std::vector<Triangle>
assembleTriangles (const MeshOfParts& mesh, const std::vector<InnerCheck>& checks,
                   const Parts& parts, PartWork& work, const RunContext& run);

} // namespace pcl::floater

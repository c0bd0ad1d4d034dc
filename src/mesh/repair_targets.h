// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Classifies vertices for the repair.
#pragma once

#include "core/run_context.h"
#include "mesh/triangle_cost.h"
#include "mesh/triangle_mesh.h"

#include <cstddef>
#include <vector>

namespace pcl::floater {
/// Class of each point, decided before the repair.
enum class RepairTarget : std::uint8_t
{
  NOTHING,   ///< there is nothing to repair
  BAD,       ///< a corner of a bad triangle: a turned one (see CostLimits), or one more than 90
             ///< degrees from a neighbouring triangle
  SCATTERED, ///< most points of the patch around are corners of bad triangles: there is no
             ///< consistent surface, so only vertices at folds are moved
  LEFT       ///< most points of the patch around are scatter: no triangle is better than another
};

/// Class of each point. A patch is a run of points along the space-filling curve. O(n).
/// \param scatter      points around which the cloud is not flat at any scale, ascending
/// \param patch_points length of a patch
std::vector<RepairTarget>
findRepairTargets (const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
                   const std::vector<Index>& scatter, const TriangleCost& cost,
                   std::size_t patch_points, const RunContext& run);

/// Whether a triangle is bad (see RepairTarget::BAD).
/// \param normal_of normal of a triangle, of any length
template <typename NormalOf>
bool
isBad (const TriangleMesh& mesh, const TriangleCost& cost, Index t, NormalOf&& normal_of)
{
  if (cost.isTurned (mesh.triangles[t]))
    return true;
  const Eigen::Vector3d normal = normal_of (t);
  for (const Index u : mesh.neighbors[t])
    if (u != NONE && normal.dot (normal_of (u)) < 0.0)
      return true;
  return false;
}

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The geometry around each point.
#pragma once

#include "local/stars.h"
#include "local/tangent_planes.h"
#include "points/kd_tree.h"
#include "points/points.h"

#include <optional>
#include <vector>

namespace pcl::floater {
/// What both methods know of the surface around each point.
struct LocalGeometry
{
  CsrLists neighbors;         ///< nearest first
  std::vector<float> spacing; ///< of the working positions: see localSpacing, or REACH_AS_SPACING
                              ///< of the reach of the star if that is more
  std::vector<float> own_spacing; ///< of the positions themselves if these are others; else empty
  Stars stars;                    ///< with the normals of the points
  std::vector<Index> scatter;     ///< points around which the cloud is flat at no scale, ascending

  /// Spacing on the mesh, whose vertices are the positions themselves.
  const std::vector<float>& meshSpacing () const
  {
    return own_spacing.empty () ? spacing : own_spacing;
  }
};

/// What stars are made of.
struct LocalPlanes
{
  CsrLists neighbors;                   ///< nearest first; beyond them, those beside rows
  std::vector<float> spacing;           ///< of the working positions: see localSpacing
  std::vector<Eigen::Vector3f> normals; ///< of the tangent planes: unit length, of arbitrary sign
  std::optional<KdTree> tree;           ///< of the working positions, if stars reach beyond
  BesideLines beside;                   ///< the same
};

/// Tangent planes and spacing by the working positions of the points. O(n k).
/// \param neighbors of each point, nearest first
/// \param known     kd-tree of the working positions; none: one is built if it is needed
LocalPlanes
fitLocalPlanes (const Points& points, CsrLists neighbors, std::optional<KdTree> known,
                const StarSettings& settings, const RunContext& run,
                const PlaneLimits& limits = {});

/// The stars of some points only; see makeStarsOf.
Stars
makeStarsOf (const std::vector<Index>& centres, const Points& points, const LocalPlanes& planes,
             const StarSettings& settings, const RunContext& run);

/// The spacing of LocalGeometry, of the spacing of the points and the reach of their stars.
void
takeReachAsSpacing (const std::vector<float>& reach, std::vector<float>& spacing);

/// Stars and spacing by the working positions of the points. O(n k log k).
LocalGeometry
makeLocalGeometry (const Points& points, LocalPlanes planes, const StarSettings& settings,
                   const RunContext& run);

/// Planes and stars at once.
LocalGeometry
makeLocalGeometry (const Points& points, CsrLists neighbors, const StarSettings& settings,
                   const RunContext& run);

} // namespace pcl::floater

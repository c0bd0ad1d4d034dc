// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Components of a mesh that continue each other across a gap.
#pragma once

#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl::floater {
/// Thresholds for the continuation of a boundary edge.
struct ContinuationLimits
{
  double reach = 8.0;  ///< largest gap, in mean boundary edges of the component
  double cosine = 0.5; ///< of the angle between the direction across the gap and the direction in
                       ///< which either surface ends; sheets above each other have 0
  double agreement = 0.5; ///< of the edges that continue each other, by length: majority for one
                          ///< orientation over the other, as a share of all
  double support = 0.1;   ///< of Continuation::support, over the length of the shorter border. The
                          ///< walls of generated hollow bodies, which do not continue each other,
                          ///< reach 0.08; halves of a square have 0.3
};

/// Two components, one continuing the other.
struct Continuation
{
  Index a, b;       ///< a < b
  bool is_opposite; ///< their fronts are on opposite sides
  double support;   ///< length of the edges of both with this orientation, minus the contradicting
                    ///< ones
};

/// For each boundary edge, finds the nearest one ahead that faces it. If it belongs to another
/// component, that one continues this one. If both edges run in the same direction, the fronts are
/// on opposite sides, whatever the angle between the surfaces: shared edges have opposite
/// directions. O(b log b) for b boundary edges; no search if only one component has a boundary.
/// \return ordered by (a, b)
std::vector<Continuation>
findContinuations (const TriangleMesh& mesh, const MeshComponents& components,
                   const std::vector<Eigen::Vector3d>& positions, const ContinuationLimits& limits,
                   const RunContext& run);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Which components of a mesh continue each other across a gap.
#pragma once

#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl::floater {
/// When a boundary edge is continued by another one.
struct ContinuationLimits
{
  double reach = 8.0;  ///< mean boundary edges of the component; the gap is no wider
  double cosine = 0.5; ///< of the angle between the way across the gap and the direction in which
                       ///< either surface ends; sheets above each other have 0
  double agreement = 0.5; ///< of the edges that continue each other, by length: how many more say
                          ///< one thing than the other, as a share of all
  double support = 0.1;   ///< of Continuation::support, by the length of the shorter border. The
                          ///< walls of generated hollow bodies, which are no continuations of each
                          ///< other, reach 0.08; halves of a square have 0.3
};

/// Two components, one of which goes on where the other one ends.
struct Continuation
{
  Index a, b;       ///< a < b
  bool is_opposite; ///< their fronts are on opposite sides
  double support;   ///< length of the edges of both that say so, less those that contradict
};

/// For each boundary edge, the nearest one that lies ahead of it and faces it. If it belongs to
/// another component, that one continues this one. Where both run the same way round, the fronts
/// are on opposite sides, whatever the angle between the surfaces: edges that are shared run
/// opposite ways. O(b log b) for b boundary edges; none are looked at if there is but one component
/// with boundary.
/// \return ordered by (a, b)
std::vector<Continuation>
findContinuations (const TriangleMesh& mesh, const MeshComponents& components,
                   const std::vector<Eigen::Vector3d>& positions, const ContinuationLimits& limits,
                   const RunContext& run);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary loop of a disc as a loop of the triangles that stars agree on.
#pragma once

#include "consensus/consensus_mesh.h"
#include "floater/boundary/boundary.h"
#include "local/local_geometry.h"
#include "mesh/open_loops.h"

namespace pcl::floater {
/// The limits of all steps of consensusLoop.
struct ConsensusLoopLimits
{
  ConsensusLimits consensus;
  OpenLoopLimits open_loops;
  double gap_ratio = 2.0; ///< circumradius by local spacing; a triangle of a star above it is a gap
                          ///< (see findGaps). Chosen by hand; no measurement is recorded
};

/// Makes the consensus mesh and takes the loop that HolePolicy::KEEP_LARGEST would keep open of its
/// largest component, the surface on the left. Points beside the loop that have a gap in their star
/// are then inserted (see refineLoop), since a ragged boundary has points that no triangle connects
/// to the rest. O(n log n).
/// \param positions by which the geometry was made
/// \return the loop; its candidates are the points with gaps and those of all loops
Boundary
consensusLoop (const std::vector<Eigen::Vector3d>& positions, const LocalGeometry& geometry,
               const RunContext& run, const ConsensusLoopLimits& limits = {});

} // namespace pcl::floater

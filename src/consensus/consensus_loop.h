// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary loop of a disc, from the consensus mesh.
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
  double gap_ratio = 2.0; ///< circumradius over local spacing above which a star triangle is a gap
                          ///< (see findGaps). Chosen by hand; no measurement is recorded
};

/// Makes the consensus mesh and takes the loop of its largest component that
/// HolePolicy::KEEP_LARGEST would keep open, the surface on the left. Then inserts points beside
/// the loop that have a gap in their star (see refineLoop): a ragged boundary has points that no
/// triangle connects to the rest. O(n log n).
/// \param positions by which the geometry was made
/// \return the loop; its candidates are the points with gaps and on any loop
Boundary
consensusLoop (const std::vector<Eigen::Vector3d>& positions, const LocalGeometry& geometry,
               const RunContext& run, const ConsensusLoopLimits& limits = {});

} // namespace pcl::floater

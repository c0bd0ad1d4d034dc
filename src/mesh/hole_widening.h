// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Holes of the surface that triangles of the consensus cover in part.
#pragma once

#include "mesh/loops.h"

#include <vector>

namespace pcl::floater {
/// Which triangles are too large for the sampling around them. No point lies in the circumcircle of
/// a triangle, and the largest such circle depends on how even the sampling is: for Poisson disks
/// its radius is at most the mean edge, among random points about twice that.
///
/// Measured on 300 generated surfaces (see OpenLoopLimits): of windows 4 to 8 spacings wide 76 %
/// stay open instead of 70 %, of narrower ones 39 % instead of 13 %, and no more of 2050 gaps of the
/// sampling than before.
struct HoleWideningLimits
{
  /// A circumradius may reach the mean edge two rings into the surface; or, where the sampling is
  /// uneven, this times that edge, plus `spread` times LoopEvidence::irregularity times it.
  double evenness = 0.4;
  double spread = 4.0;
  std::size_t rings = 3;  ///< of triangles that are removed at most, from the loop on
  double log_odds = 1.39; ///< of a widened loop that stays open, at least; 4 to 1: it is chosen
                          ///< among many for looking open, and a gap that is opened counts as
                          ///< four windows that are filled
};

/// Judges loops, and removes triangles over a hole where a loop that looks like a gap becomes a
/// likely boundary without them; doubtful loops of one width together (see judgeTogether). O(n) plus
/// twice judgeLoops ().
/// \param loops   of the mesh, ascending by their smallest points before
/// \param spacing local spacing of each point
void
widenHoles (TriangleMesh& mesh, std::vector<BoundaryLoop>& loops,
            const std::vector<Eigen::Vector3d>& positions, const std::vector<float>& spacing,
            const CsrLists& neighbors, const std::vector<Eigen::Vector3f>& normals,
            const OpenLoopLimits& open_loops, const HoleWideningLimits& limits,
            const RunContext& run);

} // namespace pcl::floater

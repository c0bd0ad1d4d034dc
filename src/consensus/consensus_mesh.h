// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// From the stars of the points to an oriented manifold.
#pragma once

#include "consensus/candidates.h"
#include "core/csr_lists.h"
#include "local/local_geometry.h"
#include "mesh/hole_filling.h"
#include "mesh/hole_widening.h"
#include "mesh/loops.h"
#include "mesh/triangle_mesh.h"

#include <vector>

namespace pcl::floater {
/// The limits of closeHoles.
struct HoleClosingLimits
{
  OpenLoopLimits open_loops;
  HoleWideningLimits hole_widening;
  HoleFillingLimits hole_filling;
  CostLimits cost;
};

/// A boundary loop of the consensus mesh, and its judgement.
struct JudgedLoop
{
  BoundaryLoop loop;
  LoopJudgement judgement;
};

struct ClosedHoles
{
  std::size_t filled = 0;
  std::vector<JudgedLoop> doubtful; ///< in the order of their smallest points, see isDoubtful
};

/// Decides which loops stay open, widens those by the automatic policy (see widenHoles), and fills
/// the others. O(n) plus judgeLoops () and fillHoles ().
/// \param positions by which the mesh was made
/// \param unit length of one unit of the cloud in the unit of the positions
ClosedHoles
closeHoles (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
            const LocalGeometry& geometry, double unit, const HoleOptions& holes,
            const HoleClosingLimits& limits, const RunContext& run);

/// Limits of the consensus mesh.
struct ConsensusLimits
{
  CandidateLimits candidates;
  std::size_t smallest_island = 32; ///< triangles; smaller islands are dropped (see manifoldPart).
                                    ///< Chosen by hand; no measurement is recorded
  std::size_t shortest_seam = 8;    ///< triangles; a shorter row is no sign of a one-sided surface
                                    ///< (see findOrientationSeam). Measured: scans of two-sided
                                    ///< surfaces had rows of up to 5, Moebius strips 4 spacings
                                    ///< wide rows of 8, and strips 12 spacings wide rows of 37
};

/// The consensus manifold, before its holes are filled.
struct ConsensusMesh
{
  TriangleMesh mesh;
  std::vector<Eigen::Vector3f> normals; ///< those of the stars, oriented like the mesh
  std::vector<Triangle> seam;           ///< see Consensus
};

/// Finds candidates, their consensus and its manifold part.
/// O(n + m log m) for m doubtful candidates.
/// \param positions by which the stars were made
/// \param neighbors of each point, nearest first
/// \param stars     of all points; freed when the candidates are found
/// \param spacing   of each point (see localSpacing)
ConsensusMesh
makeConsensusMesh (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                   Stars stars, const std::vector<float>& spacing, const ConsensusLimits& limits,
                   const RunContext& run);

} // namespace pcl::floater

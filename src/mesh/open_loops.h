// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Decides which boundary loops are boundaries of the surface, and which are gaps in the sampling.
#pragma once

#include "mesh/loop_evidence.h"

#include <pcl/surface/floater/options.h>

#include <cmath>
#include <vector>

namespace pcl::floater {
/// Thresholds and coefficients that separate boundaries from gaps.
///
/// The coefficients belong to a logistic regression: the sum of evidence times coefficient is the
/// logarithm of the odds that the loop is a boundary. They were fitted to loops of generated
/// surfaces: windows of 4 to 40 spacings, borders, and gaps, on ten shapes in thirteen samplings,
/// and on random bodies in four. `pcl_floater_open_loops --fit` repeats the fit; without an option
/// it prints the error rates on other surfaces. A gap that stays open counts as four windows that
/// are filled.
struct OpenLoopLimits
{
  EmptySectorLimits sectors;
  double constant = -12.6;
  double points = 2.19;      ///< of the logarithm of the number of points
  double compactness = 12.9; ///< for this and the others see LoopEvidence
  double irregularity = -5.35;
  double growth = -2.06;
  double turning = 1.54;
  double open_points = 0.599; ///< of the root of the number of points times the 4th power of
                              ///< open_share: long loops with hardly a point beyond
  double deepest_gap = 2.46;  ///< of LoopEvidence::depth times open_share, since a loop with points
                              ///< beyond it is not empty. Deeper gaps stay open by the automatic
                              ///< policy. Measured: fewer than 1 in 200 generated gaps from 4
                              ///< spacings on are deeper
  double doubtful = 0.9;      ///< probability; less certain decisions are listed in the report;
                              ///< about one in ten of those is wrong. Chosen by hand
};

/// Judgement of a boundary loop.
struct LoopJudgement
{
  double log_odds = 0.0; ///< logarithm of the odds that it is a boundary of the surface; above 0 it
                         ///< is more likely a boundary than a gap
  double empty_length = 0.0; ///< length of the loop whose points have no neighbour at all beyond
                             ///< it, in the unit of the positions
  bool is_too_deep = false;  ///< to be filled by triangles with support from the sampling

  double probability () const { return 1.0 / (1.0 + std::exp (-log_odds)); }
};

LoopJudgement
judgeLoop (const BoundaryLoop& loop, const LoopEvidence& evidence, const OpenLoopLimits& limits);

/// Whether a decision is reported: it is less certain than OpenLoopLimits::doubtful, or the loop
/// stays open only because it is too deep.
bool
isDoubtful (const LoopJudgement& judgement, const OpenLoopLimits& limits);

/// Judges all loops by the evidence of each (see findEvidence).
std::vector<LoopJudgement>
judgeLoops (const TriangleMesh& mesh, const std::vector<BoundaryLoop>& loops,
            const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
            const std::vector<Eigen::Vector3f>& normals, const OpenLoopLimits& limits,
            const RunContext& run);

/// Decides which loops are kept open: sets BoundaryLoop::keep_open.
///
/// The automatic policy keeps likely boundaries, and loops that are too deep to be filled. A
/// requested number of loops is taken from the most likely boundaries on; the largest loop of each
/// component is the longest of its likely boundaries. If likely boundaries run out, both use the
/// length of the loop with no point beyond. O(m log m) for m loops.
/// \param judgements of each loop
/// \param components number of components of the mesh
/// \param unit       length of one unit of the cloud in the unit of the positions
void
chooseOpenLoops (std::vector<BoundaryLoop>& loops, const std::vector<LoopJudgement>& judgements,
                 std::size_t components, const HoleOptions& holes, double unit);

} // namespace pcl::floater

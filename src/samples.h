// SPDX-License-Identifier: GPL-3.0-or-later
// What both methods work on: points, neighbours and stars.
#pragma once

#include "common/problem.h"
#include "common/stage_clock.h"
#include "common/types.h"
#include "complex/candidate_triangles.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl
{
namespace floater
{
/// Points of a run.
struct Samples
{
  WorkingSet set; ///< where noise is strong, with positions in the local planes ...
  std::vector<Eigen::Vector3d> noisy; ///< ... and these are the points' own; else empty
  FlatLists near;                     ///< the nearest neighbours, or those in a ball
  Stars stars;                        ///< Delaunay stars; for a surface only their normals
  std::vector<float> spacing;         ///< for a surface: see BlockSurface, also for the following
  std::vector<Eigen::Vector3f> crease;
  std::vector<CandidateLists> candidates;

  /// Where the points are in the user's cloud, but for centre and scale.
  const std::vector<Eigen::Vector3d>& ownPositions () const
  {
    return noisy.empty () ? set.positions : noisy;
  }
};

/// True if the options ask for the disc method.
bool
asksForDisc (const Options& options);

/// Working set, neighbours without outliers, noise, and stars; for a surface also the triangles
/// that these propose, block by block where the cloud is large. Books stages WORKING_SET, NEIGHBORS
/// and STARS (blocks: all of it), and reports what was found. \param input its positions are
/// consumed
/// \return TOO_FEW_POINTS or DEGENERATE
Problem
prepareSamples (Input& input, const Options& options, StageClock& clock, Samples& samples,
                Report& report);

} // namespace floater
} // namespace pcl

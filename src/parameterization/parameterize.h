// SPDX-License-Identifier: GPL-3.0-or-later
// Section 4 of TW 385: from stars and loop to parameters.
#pragma once

#include "common/problem.h"
#include "common/stage_clock.h"
#include "common/types.h"

#include <pcl/surface/floater/options.h>

#include <vector>

namespace pcl
{
namespace floater
{
/// Parameters of the points in the plane.
struct Parameterization
{
  std::vector<Eigen::Vector2d> uv; ///< per point; NaN for points that do not reach the loop
  std::size_t relinked = 0;        ///< points that had to be linked back to the loop
  std::size_t unreachable = 0;     ///< points that do not reach the loop
  Problem problem;                 ///< UNREACHABLE, SINGULAR, NOT_CONVERGED or OUT_OF_MEMORY
};

/// Weights, parameters of the loop, assembly and solution. Books stages WEIGHTS and SOLVE, and the
/// figures of the system and its factorization.
/// \param stars consumed but for the normals
Parameterization
parameterize (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near, Stars& stars,
              const std::vector<Index>& loop, const Options& options, StageClock& clock,
              Statistics& statistics);

} // namespace floater
} // namespace pcl

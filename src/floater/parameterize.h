// SPDX-License-Identifier: GPL-3.0-or-later
// Section 4 of TW 385: from stars and loop to parameters.
#pragma once

#include "core/problem.h"
#include "core/run_context.h"
#include "floater/solvers/solution.h"
#include "local/stars.h"

#include <pcl/surface/floater/options.h>

#include <vector>

namespace pcl
{
namespace floater
{
struct ParameterizationSettings
{
  Weighting weighting = Weighting::MEAN_VALUE;
  DomainOptions domain;
  SolverOptions solver;
};

/// Parameters of the points in the plane.
struct Parameterization
{
  std::vector<Eigen::Vector2d> uv; ///< per point; NaN for points that do not reach the loop
  std::size_t relinked = 0;        ///< points that had to be linked back to the loop
  std::size_t unreachable = 0;     ///< points that do not reach the loop
  std::size_t unknowns = 0;        ///< rows of the system
  std::size_t nonzeros = 0;        ///< of its matrix
  Solution solution;               ///< figures of the solver; the solution itself is in uv
  Problem problem;                 ///< UNREACHABLE, SINGULAR, NOT_CONVERGED or OUT_OF_MEMORY
};

/// Weights, parameters of the loop, assembly and solution. Runs through stages WEIGHTS and SOLVE.
/// \param nearest nearest neighbours, to link points that do not reach the loop
/// \param stars   of the points; freed as soon as the weights are made
Parameterization
parameterize (const std::vector<Eigen::Vector3d>& positions, const CsrLists& nearest, Stars stars,
              const std::vector<Index>& loop, const ParameterizationSettings& settings,
              const RunContext& run);

} // namespace floater
} // namespace pcl

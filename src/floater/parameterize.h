// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The parameterization (TW 385, section 4): parameters from stars and boundary loop.
#pragma once

#include "core/problem.h"
#include "core/run_context.h"
#include "floater/disc_limits.h"
#include "floater/solvers/solver.h"
#include "local/stars.h"

#include <pcl/surface/floater/options.h>

#include <vector>

namespace pcl::floater {
struct ParameterizationSettings
{
  Weighting weighting = Weighting::MEAN_VALUE;
  DomainOptions domain;
  SolverOptions solver;
  bool link_points = true; ///< link isolated points so that all are connected with the loop
};

/// Parameters of the points in the plane.
struct Parameterization
{
  std::vector<Eigen::Vector2d> uv; ///< per point; NaN if it is not connected with the loop; empty
                                   ///< if there is a problem
  std::size_t relinked = 0;    ///< points that had to be linked to points connected with the loop
  std::size_t unreachable = 0; ///< points not connected with the loop
  std::size_t unknowns = 0;    ///< rows of the linear system
  std::size_t nonzeros = 0;    ///< entries of its matrix
  Solution solution;           ///< figures of the solver; the solution itself is in uv
  Problem problem; ///< UNREACHABLE, SINGULAR, NOT_CONVERGED, SOLVER_UNAVAILABLE, OUT_OF_MEMORY or
                   ///< INTERNAL_ERROR
};

/// Makes weights, lays the loop on a convex curve, and assembles and solves the linear system
/// (TW 385, equations (1) to (3)). Runs through the stages WEIGHTS and SOLVE.
/// \param positions per point
/// \param nearest   nearest neighbours, to which points that are not connected with the loop are
///                  linked
/// \param stars     with their offsets; freed as soon as there are weights
/// \param loop      boundary points in order, at least 3
/// \throws std::bad_alloc
Parameterization
parameterize (const std::vector<Eigen::Vector3d>& positions, const CsrLists& nearest, Stars stars,
              const std::vector<Index>& loop, const ParameterizationSettings& settings,
              const RunContext& run, const DiscLimits& limits = {});

} // namespace pcl::floater

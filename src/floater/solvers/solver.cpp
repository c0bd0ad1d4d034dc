// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/solver.h"

#include "floater/solvers/solver_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace pcl::floater {
LinearSystem
assembleSystem (const CsrLists& neighbors, const std::vector<double>& weights,
                const std::vector<Index>& loop, const std::vector<Eigen::Vector2d>& loop_uv,
                const std::vector<std::uint8_t>& reachable, std::size_t most_entries)
{
  LinearSystem system;
  std::vector<Index> place_in_loop (neighbors.rows (), NONE), unknown_of_point = place_in_loop;
  for (std::size_t i = 0; i < loop.size (); ++i)
    place_in_loop[loop[i]] = static_cast<Index> (i);
  for (std::size_t p = 0; p < neighbors.rows (); ++p)
    if (place_in_loop[p] == NONE && reachable[p] != 0) {
      unknown_of_point[p] = static_cast<Index> (system.point_of_unknown.size ());
      system.point_of_unknown.push_back (static_cast<Index> (p));
    }
  const auto unknowns = static_cast<Eigen::Index> (system.point_of_unknown.size ());
  std::size_t entries = 0;
  system.matrix.resize (unknowns, unknowns);
  system.matrix.reserve (unknowns + static_cast<Eigen::Index> (neighbors.ids.size ()));
  system.rhs.setZero (unknowns, 2);
  std::vector<std::pair<Eigen::Index, double>> row;
  for (Eigen::Index i = 0; i < unknowns; ++i) {
    row.assign (1, {i, 0.0});
    const Index p = system.point_of_unknown[static_cast<std::size_t> (i)];
    for (std::size_t entry = neighbors.offsets[p]; entry < neighbors.offsets[p + 1]; ++entry) {
      const Index q = neighbors.ids[entry];
      const double weight = weights[entry];
      if (unknown_of_point[q] != NONE)
        row.emplace_back (unknown_of_point[q], -weight);
      else if (place_in_loop[q] != NONE)
        system.rhs.row (i) += weight * loop_uv[place_in_loop[q]].transpose ();
      else
        continue;
      row.front ().second += weight;
    }
    requireCountable (entries += row.size (), most_entries, "the linear system",
                      "use fewer points or fewer neighbours, or make a surface instead of a disc");
    std::sort (row.begin (), row.end ());
    system.matrix.startVec (i);
    for (const auto& [column, value] : row)
      system.matrix.insertBack (i, column) = value;
  }
  system.matrix.finalize ();
  return system;
}

namespace {
// Above this number, memory counts: METIS's factors are smaller than AMD's by a quarter to a third,
// and solving takes as long, or up to 1.6 times as long (four discs of 300,000 points).
constexpr std::size_t METIS_UNKNOWNS = 100'000;

// Pivots on the diagonal: a system counts as singular if its reciprocal condition is below this.
// Floating unknowns leave a pivot of rounding errors that is seldom exactly 0 (up to 3e-14 with
// 5000 unknowns). Unknowns that depend on the loop by the smallest of weights (SMALLEST_WEIGHT)
// stay above.
constexpr double SINGULAR_RECIPROCAL_CONDITION = 1e-12;

// Looks for a problem in the pivots and the residual of solution.uv, which stays only without.
void
conclude (const LinearSystem& system, const SolverOptions& options, Solution& solution)
{
  bool is_finite = true, is_within = true;
  for (Eigen::Index side = 0; side < 2; ++side) {
    const Residual residual = measureResidual (system, side, solution.uv.col (side));
    const double norm = residual.rest.norm ();
    solution.residual = std::max (solution.residual, residual.rest.cwiseAbs ().maxCoeff ());
    if (norm != 0.0)
      solution.relative_residual = std::max (solution.relative_residual, norm / residual.rhs);
    is_finite = is_finite && std::isfinite (norm);
    is_within = is_within && norm <= residual.target (options.tolerance);
  }
  const bool is_iterative =
      options.method == Solver::BICGSTAB_ILUT || options.method == Solver::GAUSS_SEIDEL;
  if (!is_iterative && !(solution.reciprocal_condition >= SINGULAR_RECIPROCAL_CONDITION))
    solution.problem =
        notSolved (RunStatus::SINGULAR, "factorization: a pivot consists of rounding errors only");
  else if (!is_finite)
    solution.problem = notSolved (RunStatus::INTERNAL_ERROR, "the solution is not finite");
  else if (is_iterative && !is_within) {
    std::ostringstream message;
    const std::size_t iterations = std::max (solution.iterations[0], solution.iterations[1]);
    message << (options.method == Solver::BICGSTAB_ILUT ? "BiCGSTAB" : "Gauss-Seidel")
            << " reached a relative residual of " << solution.relative_residual << " in "
            << iterations << (iterations == 1 ? " iteration" : " iterations") << ", not "
            << options.tolerance;
    solution.problem = notSolved (RunStatus::NOT_CONVERGED, message.str ());
  }
  if (solution.problem)
    solution.uv.resize (0, 2);
}

void
solveAsItIs (const LinearSystem& system, Ordering ordering, const SolverOptions& options,
             const RunContext& run, Solution& solution)
{
  if (options.method == Solver::BICGSTAB_ILUT)
    solveWithBicgstab (system, options, run, solution);
  else if (options.method == Solver::GAUSS_SEIDEL)
    solveWithGaussSeidel (system, options, run, solution);
  else
    solveWithUmfpack (system, ordering, run, solution);
  if (solution.uv.rows () > 0)
    conclude (system, options, solution);
}

} // namespace

Residual
measureResidual (const LinearSystem& system, Eigen::Index side,
                 const Eigen::Ref<const Eigen::VectorXd>& solution)
{
  constexpr double ROUNDING = 4.0 * std::numeric_limits<double>::epsilon ();
  Residual residual{system.rhs.col (side), system.rhs.col (side).norm (), 0.0};
  Eigen::VectorXd magnitude = residual.rest.cwiseAbs ();
  for (Eigen::Index i = 0; i < system.matrix.rows (); ++i)
    for (SystemMatrix::InnerIterator entry (system.matrix, i); entry; ++entry) {
      const double term = entry.value () * solution[entry.col ()];
      residual.rest[i] -= term;
      magnitude[i] += std::abs (term);
    }
  residual.rounding = ROUNDING * magnitude.norm ();
  return residual;
}

Problem
notSolved (RunStatus status, const std::string& why)
{
  if (status == RunStatus::SINGULAR)
    return {status, "the linear system is singular (" + why + "); use more neighbours"};
  if (status == RunStatus::NOT_CONVERGED)
    return {status, why + "; allow more iterations, or use a direct solver"};
  if (status == RunStatus::OUT_OF_MEMORY)
    return {status, "not enough memory for the factorization (" + why +
                        "): use fewer points, or a machine with more memory"};
  return {RunStatus::INTERNAL_ERROR, "the linear system was not solved (" + why + ")"};
}

Solution
solve (const LinearSystem& system, const SolverOptions& options, const RunContext& run)
{
  Solution solution;
  if (system.unknowns () == 0) {
    solution.reciprocal_condition = 1.0;
    return solution;
  }
  Ordering ordering = options.ordering;
  if (options.method == Solver::UMFPACK && ordering == Ordering::AUTOMATIC)
    ordering = system.unknowns () > METIS_UNKNOWNS ? Ordering::METIS : Ordering::AMD;
  if (ordering == Ordering::AUTOMATIC || ordering == Ordering::NATURAL ||
      (options.method == Solver::UMFPACK && ordering == Ordering::AMD)) {
    solveAsItIs (system, ordering, options, run, solution);
    return solution;
  }
  // Any solver can solve the reordered system as it comes.
  const Eigen::PermutationMatrix<Eigen::Dynamic> order = orderUnknowns (system.matrix, ordering);
  const Eigen::PermutationMatrix<Eigen::Dynamic> place = order.inverse ();
  LinearSystem ordered;
  ordered.matrix = system.matrix.twistedBy (place);
  ordered.rhs = place * system.rhs;
  solveAsItIs (ordered, Ordering::NATURAL, options, run, solution);
  if (!solution.problem)
    solution.uv = order * Eigen::MatrixX2d (solution.uv);
  return solution;
}

} // namespace pcl::floater

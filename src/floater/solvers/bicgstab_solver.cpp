// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/bicgstab_solver.h"

#include "core/parallel.h"
#include "core/run_context.h"
#include "floater/solvers/floating_unknowns.h"
#include "floater/solvers/iterative.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl::floater {
namespace {
using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using Vector = Eigen::VectorXd;

class IncompleteFactors : public Eigen::IncompleteLUT<double>
{
public:
  std::size_t nonZeros () const { return static_cast<std::size_t> (m_lu.nonZeros ()); }
};

// A preconditioner that borrows one factorization for both right-hand sides and counts its own
// uses: Eigen's count of iterations begins anew when the solver restarts.
class SharedPreconditioner
{
public:
  void share (const IncompleteFactors& factors, const RunContext& run)
  {
    factors_ = &factors;
    run_ = &run;
  }
  std::size_t uses () const { return uses_; }

  template <typename AnyMatrix>
  SharedPreconditioner& analyzePattern (const AnyMatrix& /*matrix*/)
  {
    return *this;
  }
  template <typename AnyMatrix>
  SharedPreconditioner& factorize (const AnyMatrix& /*matrix*/)
  {
    return *this;
  }
  template <typename AnyMatrix>
  SharedPreconditioner& compute (const AnyMatrix& /*matrix*/)
  {
    return *this;
  }
  Eigen::ComputationInfo info () { return Eigen::Success; }

  template <typename Rhs>
  Vector solve (const Rhs& rhs) const
  {
    ++uses_;
    run_->poll ();
    return factors_->solve (rhs);
  }

private:
  const IncompleteFactors* factors_ = nullptr;
  const RunContext* run_ = nullptr;
  mutable std::size_t uses_ = 0;
};

// The residual at which to stop: see Residual::isWithin ().
// \param magnitudes absolute values of the matrix
double
targetResidual (const Matrix& magnitudes, const Vector& rhs, const Vector& solution,
                double tolerance)
{
  constexpr double ROUNDING = 4.0 * std::numeric_limits<double>::epsilon ();
  const Vector terms = magnitudes * solution.cwiseAbs () + rhs.cwiseAbs ();
  return std::max (tolerance * rhs.norm (), ROUNDING * terms.norm ());
}

// Solves for one right-hand side.
// \return iterations
std::size_t
iterate (const Eigen::Map<const Matrix>& matrix, const Matrix& magnitudes, const Vector& rhs,
         const IncompleteFactors& factors, const SolverOptions& options, const RunContext& run,
         Vector& solution)
{
  constexpr std::size_t USES_PER_ITERATION = 2;
  solution = Vector::Zero (rhs.size ());
  Vector rest = rhs;
  double norm = rhs.norm ();
  std::size_t iterations = 0;
  const auto most = static_cast<std::size_t> (options.max_iterations);
  for (double target = options.tolerance * norm; norm > target && iterations < most;
       target = targetResidual (magnitudes, rhs, solution, options.tolerance)) {
    Eigen::BiCGSTAB<Matrix, SharedPreconditioner> bicgstab;
    bicgstab.preconditioner ().share (factors, run);
    bicgstab.compute (matrix);
    bicgstab.setTolerance (target / norm);
    bicgstab.setMaxIterations (static_cast<Eigen::Index> (most - iterations));
    const Vector step = bicgstab.solve (rest);
    iterations += bicgstab.preconditioner ().uses () / USES_PER_ITERATION;
    const Vector next = solution + step;
    rest = rhs - matrix * next;
    const double next_norm = rest.norm ();
    if (!(next_norm < norm))
      break;
    solution = next;
    const bool stalls = next_norm > 0.5 * norm;
    norm = next_norm;
    if (stalls)
      break;
  }
  return iterations;
}

} // namespace

Solution
solveWithBicgstab (const LinearSystem& system, const SolverOptions& options, const RunContext& run)
{
  Solution solution;
  if (refuseFloatingUnknowns (system, solution))
    return solution;
  const auto n = static_cast<Eigen::Index> (system.unknowns ());
  const Eigen::Map<const Matrix> matrix (n, n, static_cast<Eigen::Index> (system.nonzeros ()),
                                         system.row_offsets.data (), system.columns.data (),
                                         system.values.data ());
  const Matrix magnitudes = matrix.cwiseAbs ();

  IncompleteFactors factors;
  // Eigen counts the fill in mean rows of the matrix. Half of it goes to L, and half to U.
  const double mean_row = static_cast<double> (system.nonzeros ()) / static_cast<double> (n);
  const double fill = std::ceil (2.0 * options.ilut_fill / mean_row);
  // Eigen reserves so many entries, and counts them in an int without looking.
  const std::size_t reserved_in_row =
      std::min (system.unknowns (), static_cast<std::size_t> (fill * mean_row) + 1) + 1;
  requireCountable (system.unknowns () * reserved_in_row, MOST_MATRIX_ENTRIES,
                    "the incomplete factorization", "use a smaller fill, or fewer points");
  factors.setFillfactor (static_cast<int> (fill));
  factors.setDroptol (options.ilut_drop);
  factors.compute (matrix);
  solution.nnz_factors = factors.nonZeros ();

  const std::array<const std::vector<double>*, 2> rhs{&system.rhs_u, &system.rhs_v};
  std::array<Vector, 2> unknowns;
  parallelTasks (run, 2, [&] (std::size_t side) {
    solution.iterations[side] =
        iterate (matrix, magnitudes, Eigen::Map<const Vector> (rhs[side]->data (), n), factors,
                 options, run, unknowns[side]);
  });
  solution.uv.resize (system.unknowns ());
  for (std::size_t i = 0; i < solution.uv.size (); ++i)
    solution.uv[i] = {unknowns[0][static_cast<Eigen::Index> (i)],
                      unknowns[1][static_cast<Eigen::Index> (i)]};
  concludeIteration (system, options.tolerance, "BiCGSTAB", solution);
  return solution;
}

} // namespace pcl::floater

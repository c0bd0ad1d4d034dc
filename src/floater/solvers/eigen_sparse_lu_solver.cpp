// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/eigen_sparse_lu_solver.h"

#include "core/parallel.h"
#include "floater/solvers/residual.h"

#include <Eigen/SparseLU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl::floater {
namespace {
using ColumnMatrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

template <typename Order>
class Factors : public Eigen::SparseLU<ColumnMatrix, Order>
{
public:
  // min |U_kk| / max |U_kk|. Eigen stores the diagonal blocks of U with L.
  double pivotRatio () const
  {
    double least = std::numeric_limits<double>::infinity (), largest = 0.0;
    for (Eigen::Index column = 0; column < this->cols (); ++column)
      for (typename Eigen::SparseLU<ColumnMatrix, Order>::SCMatrix::InnerIterator entry (
               this->m_Lstore, column);
           entry; ++entry)
        if (entry.index () == column) {
          least = std::min (least, std::abs (entry.value ()));
          largest = std::max (largest, std::abs (entry.value ()));
          break;
        }
    return largest > 0.0 ? least / largest : 0.0;
  }
};

template <typename Order>
Solution
solveOrdered (const LinearSystem& system, bool symmetric, const RunContext& run)
{
  Solution solution;
  const auto n = static_cast<Eigen::Index> (system.unknowns ());
  const Eigen::Map<const ColumnMatrix> transpose (
      n, n, static_cast<Eigen::Index> (system.nonzeros ()), system.row_offsets.data (),
      system.columns.data (), system.values.data ());
  Factors<Order> factors;
  factors.isSymmetric (symmetric);
  factors.compute (transpose);
  if (factors.info () != Eigen::Success) {
    solution.message = "factorization: " + factors.lastErrorMessage ();
    solution.outcome = solution.message.find ("MEMORY") != std::string::npos
                           ? Solution::Outcome::OUT_OF_MEMORY
                           : Solution::Outcome::SINGULAR;
    return solution;
  }
  solution.nnz_factors =
      static_cast<std::size_t> (factors.nnzL () + factors.nnzU ()) - system.unknowns ();
  solution.reciprocal_condition = factors.pivotRatio ();
  if (!(solution.reciprocal_condition >= SINGULAR_RECIPROCAL_CONDITION)) {
    solution.outcome = Solution::Outcome::SINGULAR;
    solution.message = "factorization: a pivot consists of rounding errors only";
    return solution;
  }
  const std::array<const std::vector<double>*, 2> rhs{&system.rhs_u, &system.rhs_v};
  const std::array<decltype (factors.transpose ()), 2> solvers{factors.transpose (),
                                                               factors.transpose ()};
  std::array<Vector, 2> unknowns;
  parallelTasks (run, 2, [&] (std::size_t side) {
    unknowns[side] = solvers[side].solve (Eigen::Map<const Vector> (rhs[side]->data (), n));
  });
  solution.uv.resize (system.unknowns ());
  for (std::size_t i = 0; i < solution.uv.size (); ++i)
    solution.uv[i] = {unknowns[0][static_cast<Eigen::Index> (i)],
                      unknowns[1][static_cast<Eigen::Index> (i)]};
  solution.outcome = Solution::Outcome::OK;
  recordResidual (system, solution);
  return solution;
}

} // namespace

Solution
solveWithEigenSparseLu (const LinearSystem& system, Ordering ordering, const RunContext& run)
{
  return ordering == Ordering::NATURAL
             ? solveOrdered<Eigen::NaturalOrdering<int>> (system, true, run)
             : solveOrdered<Eigen::COLAMDOrdering<int>> (system, false, run);
}

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The solvers of the linear system (TW 385, section 4.2), behind one interface.
#pragma once

#include "core/csr_lists.h"
#include "core/problem.h"
#include "core/run_context.h"

#include <Eigen/SparseCore>
#include <pcl/surface/floater/options.h>

namespace pcl::floater {
/// A square matrix in compressed rows, whose columns ascend; see MOST_MATRIX_ENTRIES.
using SystemMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// A u = b for both coordinates of the interior points.
struct LinearSystem
{
  std::vector<Index> point_of_unknown; ///< interior points that take part, ascending
  SystemMatrix matrix;
  Eigen::MatrixX2d rhs; ///< per unknown, for either coordinate

  std::size_t unknowns () const { return static_cast<std::size_t> (matrix.rows ()); }
  std::size_t nonzeros () const { return static_cast<std::size_t> (matrix.nonZeros ()); }
};

/// Assembles the system of TW 385, equation (1): the diagonal of a row is the sum of its weights,
/// those of loop points included, and the weights of unknowns come with a negative sign. Since the
/// diagonal is that sum instead of 1, rows sum up exactly, and the solution is as accurate as the
/// solver. O(entries).
/// \param neighbors per point: distinct neighbours, not the point itself; a neighbour that is
///                  neither an unknown nor on the loop is left out
/// \param weights   parallel to neighbors.ids, positive
/// \param reachable per point; 1 if the point takes part (see reachLoop ())
/// \throws IndexLimitReached if the matrix has more than `most_entries`
LinearSystem
assembleSystem (const CsrLists& neighbors, const std::vector<double>& weights,
                const std::vector<Index>& loop, const std::vector<Vector2d>& loop_uv,
                const Flags& reachable, std::size_t most_entries = MOST_MATRIX_ENTRIES);

/// The solution of a LinearSystem, and its figures.
struct Solution : SystemStatistics
{
  Problem problem;     ///< SINGULAR, NOT_CONVERGED, OUT_OF_MEMORY or INTERNAL_ERROR
  Eigen::MatrixX2d uv; ///< per unknown; no rows if there is a problem
};

/// Solves for both coordinates with options.method in the order options.ordering. An empty system
/// has no problem. Direct solvers refuse a singular system by a pivot of rounding errors. An iterative
/// solver whose measured residual is above options.tolerance returns NOT_CONVERGED and no solution;
/// of a singular system it may return one of many solutions. The result does not depend on the
/// number of threads.
/// \throws std::bad_alloc, IndexLimitReached
Solution
solve (const LinearSystem& system, const SolverOptions& options, const RunContext& run);

/// Makes OpenBLAS use one thread while any instance exists, and restores the former number
/// afterwards. More threads are slower on our small fronts, and change the last digits of the
/// factors. OpenBLAS is looked up at run time; with any other BLAS this does nothing. The number
/// belongs to the process, so all instances share it: the first saves it, the last restores it.
class SingleBlasThread
{
public:
  /// \throws std::bad_alloc if there is no memory for the work buffer of OpenBLAS
  SingleBlasThread ();
  ~SingleBlasThread ();
  SingleBlasThread (const SingleBlasThread&) = delete;
  SingleBlasThread& operator= (const SingleBlasThread&) = delete;
};

/// Why there is no solution.
/// \param status SINGULAR, NOT_CONVERGED, OUT_OF_MEMORY, or INTERNAL_ERROR
Problem
notSolved (RunStatus status, const std::string& why);

/// One factorization for both right-hand sides, with one BLAS thread: fills `uv` and the figures of the
/// solution, or tells the problem. The rows are the columns of the transpose, whose dominant diagonal
/// keeps pivots on the diagonal.
/// \param ordering AMD, or NATURAL: as the unknowns come
void
solveWithUmfpack (const LinearSystem& system, Ordering ordering, const RunContext& run,
                  Solution& solution);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/single_blas_thread.h"
#include "floater/solvers/solver_parts.h"

#include <slu_ddefs.h>

#include <cmath>
#include <limits>

namespace pcl::floater {
namespace {
// What SuperLU allocates. A matrix is empty until it has a store.
struct Allocated
{
  Allocated () { StatInit (&stat); }
  Allocated (const Allocated&) = delete;
  Allocated& operator= (const Allocated&) = delete;
  ~Allocated ()
  {
    const auto release = [] (SuperMatrix& matrix, void (*destroy) (SuperMatrix*)) {
      if (matrix.Store != nullptr)
        destroy (&matrix);
    };
    release (rows, Destroy_SuperMatrix_Store);
    release (sides, Destroy_SuperMatrix_Store);
    release (lower, Destroy_SuperNode_Matrix);
    release (upper, Destroy_CompCol_Matrix);
    StatFree (&stat);
  }
  SuperMatrix rows{}, sides{}, lower{}, upper{};
  SuperLUStat_t stat{};
};

// min |U_kk| / max |U_kk|. SuperLU stores the diagonal blocks of U with L.
double
pivotRatio (const SuperMatrix& factor)
{
  const auto& store = *static_cast<const SCformat*> (factor.Store);
  const auto* values = static_cast<const double*> (store.nzval);
  double least = std::numeric_limits<double>::infinity (), largest = 0.0;
  for (int column = 0; column < factor.ncol; ++column) {
    const int first = store.sup_to_col[store.col_to_sup[column]];
    const double pivot = std::abs (values[store.nzval_colptr[column] + (column - first)]);
    least = std::min (least, pivot);
    largest = std::max (largest, pivot);
  }
  return largest > 0.0 ? least / largest : 0.0;
}

} // namespace

void
solveWithSuperlu (const LinearSystem& system, Ordering ordering, Solution& solution)
{
  // SuperLU counts the entries that it reserves in an int without looking.
  constexpr int FILL = 6; // question to sp_ienv
  requireCountable (static_cast<std::size_t> (sp_ienv (FILL)) * system.nonzeros (),
                    MOST_MATRIX_ENTRIES, "the factors of SuperLU",
                    "use fewer points or another solver");
  const SingleBlasThread single_blas_thread;
  const auto n = static_cast<int> (system.unknowns ());
  superlu_options_t control;
  set_default_options (&control);
  control.Equil = NO;
  control.PrintStat = NO;
  control.SymmetricMode = YES;
  control.ColPerm = ordering == Ordering::NATURAL ? NATURAL : MMD_AT_PLUS_A;

  // SuperLU only reads these arrays, though its pointers are not const.
  Allocated all;
  dCreate_CompRow_Matrix (&all.rows, n, n, static_cast<int> (system.nonzeros ()),
                          const_cast<double*> (system.matrix.valuePtr ()),
                          const_cast<int*> (system.matrix.innerIndexPtr ()),
                          const_cast<int*> (system.matrix.outerIndexPtr ()), SLU_NR, SLU_D, SLU_GE);
  Eigen::MatrixX2d uv = system.rhs; // solved in place
  dCreate_Dense_Matrix (&all.sides, n, 2, uv.data (), n, SLU_DN, SLU_D, SLU_GE);
  std::vector<int> column_order (system.unknowns ()), row_order (system.unknowns ());
  int info = 0;
  dgssv (&control, &all.rows, column_order.data (), row_order.data (), &all.lower, &all.upper,
         &all.sides, &all.stat, &info);
  if (info > n) { // there are no factors
    all.lower.Store = all.upper.Store = nullptr;
    solution.problem =
        notSolved (RunStatus::OUT_OF_MEMORY,
                   "factorization: SuperLU got only " + std::to_string (info - n) + " bytes");
    return;
  }
  if (info < 0) {
    solution.problem = notSolved (RunStatus::INTERNAL_ERROR,
                                  "SuperLU does not accept argument " + std::to_string (-info));
    return;
  }
  mem_usage_t memory{};
  dQuerySpace (&all.lower, &all.upper, &memory);
  solution.peak_bytes = static_cast<std::size_t> (memory.total_needed);
  solution.nnz_factors =
      static_cast<std::size_t> (static_cast<const SCformat*> (all.lower.Store)->nnz) +
      static_cast<std::size_t> (static_cast<const NCformat*> (all.upper.Store)->nnz) -
      system.unknowns ();
  solution.reciprocal_condition = info > 0 ? 0.0 : pivotRatio (all.lower);
  solution.uv = std::move (uv);
}

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/superlu_solver.h"

#include "floater/solvers/residual.h"
#include "floater/solvers/single_blas_thread.h"

#include <slu_ddefs.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl::floater {
namespace {
// A matrix of SuperLU, freed by the function for its kind. It is empty until it has a store.
template <void (*release) (SuperMatrix*)>
struct Owned
{
  Owned () = default;
  Owned (const Owned&) = delete;
  Owned& operator= (const Owned&) = delete;
  ~Owned ()
  {
    if (matrix.Store != nullptr)
      release (&matrix);
  }
  SuperMatrix matrix{};
};

struct Counters
{
  Counters () { StatInit (&stat); }
  Counters (const Counters&) = delete;
  Counters& operator= (const Counters&) = delete;
  ~Counters () { StatFree (&stat); }
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

Solution
solveWithSuperlu (const LinearSystem& system, Ordering ordering)
{
  Solution solution;
  const SingleBlasThread single_blas_thread;
  const auto n = static_cast<int> (system.unknowns ());
  superlu_options_t control;
  set_default_options (&control);
  control.Equil = NO;
  control.PrintStat = NO;
  control.SymmetricMode = ordering == Ordering::COLAMD ? NO : YES;
  control.ColPerm = ordering == Ordering::COLAMD    ? COLAMD
                    : ordering == Ordering::NATURAL ? NATURAL
                                                    : MMD_AT_PLUS_A;

  // SuperLU only reads these arrays, though its pointers are not const.
  Owned<Destroy_SuperMatrix_Store> transpose;
  dCreate_CompCol_Matrix (&transpose.matrix, n, n, static_cast<int> (system.nonzeros ()),
                          const_cast<double*> (system.values.data ()),
                          const_cast<int*> (system.columns.data ()),
                          const_cast<int*> (system.row_offsets.data ()), SLU_NC, SLU_D, SLU_GE);
  // SuperLU counts the entries that it reserves in an int without looking.
  constexpr int FILL = 6; // question to sp_ienv
  requireCountable (static_cast<std::size_t> (sp_ienv (FILL)) * system.nonzeros (),
                    MOST_MATRIX_ENTRIES, "the factors of SuperLU",
                    "use fewer points or another solver");
  std::vector<int> column_order (system.unknowns ()), row_order (system.unknowns ()),
      tree (system.unknowns ());
  get_perm_c (control.ColPerm, &transpose.matrix, column_order.data ());
  Owned<Destroy_CompCol_Permuted> ordered;
  sp_preorder (&control, &transpose.matrix, column_order.data (), tree.data (), &ordered.matrix);

  Owned<Destroy_SuperNode_Matrix> lower;
  Owned<Destroy_CompCol_Matrix> upper;
  GlobalLU_t working{};
  Counters counters;
  int info = 0;
  constexpr int PANEL_SIZE = 1, RELAX = 2; // questions to sp_ienv
  dgstrf (&control, &ordered.matrix, sp_ienv (RELAX), sp_ienv (PANEL_SIZE), tree.data (), nullptr,
          0, column_order.data (), row_order.data (), &lower.matrix, &upper.matrix, &working,
          &counters.stat, &info);
  if (info > n) { // out of memory: there are no factors
    lower.matrix.Store = upper.matrix.Store = nullptr;
    solution.outcome = Solution::Outcome::OUT_OF_MEMORY;
    solution.message = "factorization: SuperLU got only " + std::to_string (info - n) + " bytes";
    return solution;
  }
  if (info < 0) {
    solution.message = "factorization: SuperLU does not accept argument " + std::to_string (-info);
    return solution;
  }
  mem_usage_t memory{};
  dQuerySpace (&lower.matrix, &upper.matrix, &memory);
  solution.peak_bytes = static_cast<std::size_t> (memory.total_needed);
  solution.nnz_factors =
      static_cast<std::size_t> (static_cast<const SCformat*> (lower.matrix.Store)->nnz) +
      static_cast<std::size_t> (static_cast<const NCformat*> (upper.matrix.Store)->nnz) -
      system.unknowns ();
  solution.reciprocal_condition = info > 0 ? 0.0 : pivotRatio (lower.matrix);
  if (!(solution.reciprocal_condition >= SINGULAR_RECIPROCAL_CONDITION)) {
    solution.outcome = Solution::Outcome::SINGULAR;
    solution.message = info > 0 ? "factorization: pivot " + std::to_string (info) + " is zero"
                                : "factorization: a pivot consists of rounding errors only";
    return solution;
  }

  std::vector<double> unknowns (system.rhs_u); // solved in place, column by column
  unknowns.insert (unknowns.end (), system.rhs_v.begin (), system.rhs_v.end ());
  Owned<Destroy_SuperMatrix_Store> sides;
  dCreate_Dense_Matrix (&sides.matrix, n, 2, unknowns.data (), n, SLU_DN, SLU_D, SLU_GE);
  dgstrs (TRANS, &lower.matrix, &upper.matrix, column_order.data (), row_order.data (),
          &sides.matrix, &counters.stat, &info);
  if (info != 0) {
    solution.message = "solution: SuperLU does not accept argument " + std::to_string (-info);
    return solution;
  }
  solution.uv.resize (system.unknowns ());
  for (std::size_t i = 0; i < solution.uv.size (); ++i)
    solution.uv[i] = {unknowns[i], unknowns[solution.uv.size () + i]};
  solution.outcome = Solution::Outcome::OK;
  recordResidual (system, solution);
  return solution;
}

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/umfpack_solver.h"

#include "core/parallel.h"
#include "floater/solvers/floating_unknowns.h"
#include "floater/solvers/residual.h"
#include "floater/solvers/single_blas_thread.h"

#include <umfpack.h>

#include <algorithm>
#include <array>
#include <memory>
#include <numeric>

namespace pcl::floater {
namespace {
// Unknowns from which on the interface has 64-bit indices. That with 32 bits takes an eighth less
// memory, and holds factors of up to 2 GB; there are about 1.2 kB of them per unknown.
constexpr std::size_t LONG_INDEX_UNKNOWNS = 1000000;

// UMFPACK's two integer types.
struct IntInterface
{
  using Int = int;
  static constexpr auto DEFAULTS = &umfpack_di_defaults;
  static constexpr auto SYMBOLIC = &umfpack_di_symbolic;
  static constexpr auto QSYMBOLIC = &umfpack_di_qsymbolic;
  static constexpr auto NUMERIC = &umfpack_di_numeric;
  static constexpr auto SOLVE = &umfpack_di_solve;
  static constexpr auto FREE_SYMBOLIC = &umfpack_di_free_symbolic;
  static constexpr auto FREE_NUMERIC = &umfpack_di_free_numeric;
};

struct LongInterface
{
  using Int = SuiteSparse_long;
  static constexpr auto DEFAULTS = &umfpack_dl_defaults;
  static constexpr auto SYMBOLIC = &umfpack_dl_symbolic;
  static constexpr auto QSYMBOLIC = &umfpack_dl_qsymbolic;
  static constexpr auto NUMERIC = &umfpack_dl_numeric;
  static constexpr auto SOLVE = &umfpack_dl_solve;
  static constexpr auto FREE_SYMBOLIC = &umfpack_dl_free_symbolic;
  static constexpr auto FREE_NUMERIC = &umfpack_dl_free_numeric;
};

// UMFPACK's handles are freed through a pointer to them.
template <void (*release) (void**)>
struct Release
{
  void operator() (void* handle) const { release (&handle); }
};
template <void (*release) (void**)>
using Handle = std::unique_ptr<void, Release<release>>;

// Records the reason if a call has failed.
// \return true if it has not
bool
accept (double status, const char* call, Solution& solution)
{
  if (status == UMFPACK_OK)
    return true;
  const int code = static_cast<int> (status);
  solution.message = std::string (call) + ": UMFPACK status " + std::to_string (code);
  if (code == UMFPACK_WARNING_singular_matrix)
    solution.outcome = Solution::Outcome::SINGULAR;
  else if (code == UMFPACK_ERROR_out_of_memory)
    solution.outcome = Solution::Outcome::OUT_OF_MEMORY;
  else
    solution.outcome = Solution::Outcome::FAILED;
  return false;
}

// The pattern of the matrix: a copy in another type of index, or the system's own.
template <typename Int>
struct Pattern
{
  explicit Pattern (const LinearSystem& system)
      : offsets (system.row_offsets.begin (), system.row_offsets.end ()),
        columns (system.columns.begin (), system.columns.end ())
  {
  }
  std::vector<Int> offsets, columns;
};
template <>
struct Pattern<int>
{
  explicit Pattern (const LinearSystem& system)
      : offsets (system.row_offsets), columns (system.columns)
  {
  }
  const std::vector<int>&offsets, &columns;
};

using Control = std::array<double, UMFPACK_CONTROL>;
using Info = std::array<double, UMFPACK_INFO>;

// \param is_order_given the columns are not to be reordered
template <typename Interface>
Control
makeControl (Ordering ordering, bool is_order_given, UmfpackStrategy strategy)
{
  // Pivots off the diagonal cost digits, which refinement recovers.
  constexpr double REFINEMENT_STEPS = 2.0;
  const bool is_symmetric = strategy == UmfpackStrategy::SYMMETRIC;
  Control control{};
  Interface::DEFAULTS (control.data ());
  control[UMFPACK_STRATEGY] =
      is_symmetric ? UMFPACK_STRATEGY_SYMMETRIC : UMFPACK_STRATEGY_UNSYMMETRIC;
  control[UMFPACK_SCALE] = UMFPACK_SCALE_NONE;
  control[UMFPACK_IRSTEP] = is_symmetric ? 0.0 : REFINEMENT_STEPS;
  // UMFPACK_ORDERING_AMD is COLAMD with the unsymmetric strategy.
  control[UMFPACK_ORDERING] =
      ordering == Ordering::METIS ? UMFPACK_ORDERING_METIS : UMFPACK_ORDERING_AMD;
  if (is_order_given) {
    control[UMFPACK_FIXQ] = 1.0;
    // Without AMD's estimate, UMFPACK would allocate far too much memory in advance. With 0 it
    // begins with the least memory it needs, and grows in steps.
    control[UMFPACK_ALLOC_INIT] = 0.0;
  }
  return control;
}

// Records what the factorization cost.
void
recordFigures (const Info& info, Solution& solution)
{
  // UMFPACK leaves -1 for figures that it did not compute.
  const auto figure = [&info] (std::size_t entry) { return std::max (0.0, info[entry]); };
  solution.peak_bytes =
      static_cast<std::size_t> (figure (UMFPACK_PEAK_MEMORY) * figure (UMFPACK_SIZE_OF_UNIT));
  solution.reciprocal_condition = figure (UMFPACK_RCOND);
}

// \param order of the unknowns; empty: UMFPACK makes the ordering
// \return nullptr if it fails, with the reason in the solution
template <typename Interface, typename Int = typename Interface::Int>
Handle<Interface::FREE_NUMERIC>
factorize (const LinearSystem& system, const Pattern<Int>& pattern, const std::vector<int>& order,
           const Control& control, Solution& solution)
{
  const auto n = static_cast<Int> (system.unknowns ());
  Info info{};
  void* handle = nullptr;
  if (!order.empty ()) {
    const std::vector<Int> fixed (order.begin (), order.end ());
    Interface::QSYMBOLIC (n, n, pattern.offsets.data (), pattern.columns.data (),
                          system.values.data (), fixed.data (), &handle, control.data (),
                          info.data ());
  }
  else
    Interface::SYMBOLIC (n, n, pattern.offsets.data (), pattern.columns.data (),
                         system.values.data (), &handle, control.data (), info.data ());
  const Handle<Interface::FREE_SYMBOLIC> symbolic (handle);
  if (!accept (info[UMFPACK_STATUS], "symbolic analysis", solution))
    return nullptr;
  handle = nullptr;
  Interface::NUMERIC (pattern.offsets.data (), pattern.columns.data (), system.values.data (),
                      symbolic.get (), &handle, control.data (), info.data ());
  Handle<Interface::FREE_NUMERIC> numeric (handle);
  recordFigures (info, solution);
  if (!accept (info[UMFPACK_STATUS], "factorization", solution))
    return nullptr;
  solution.nnz_factors =
      static_cast<std::size_t> (info[UMFPACK_LNZ] + info[UMFPACK_UNZ]) - system.unknowns ();
  return numeric;
}

// \param order of the unknowns; empty: UMFPACK makes the ordering
template <typename Interface>
Solution
solve (const LinearSystem& system, Ordering ordering, const std::vector<int>& order,
       UmfpackStrategy strategy, const RunContext& run)
{
  using Int = typename Interface::Int;
  Solution solution;
  const Control control = makeControl<Interface> (ordering, !order.empty (), strategy);
  auto pattern = std::make_unique<const Pattern<Int>> (system);
  Handle<Interface::FREE_NUMERIC> numeric =
      factorize<Interface> (system, *pattern, order, control, solution);
  if (!numeric)
    return solution;
  if (strategy == UmfpackStrategy::SYMMETRIC) {
    if (!(solution.reciprocal_condition >= SINGULAR_RECIPROCAL_CONDITION)) {
      solution.outcome = Solution::Outcome::SINGULAR;
      solution.message = "factorization: a pivot consists of rounding errors only";
      return solution;
    }
    pattern.reset (); // only refinement needs the matrix after the factorization
  }

  // The factors are only read, so both right-hand sides can be solved at the same time.
  const std::array<const std::vector<double>*, 2> rhs{&system.rhs_u, &system.rhs_v};
  std::array<std::vector<double>, 2> unknowns;
  for (auto& one : unknowns)
    one.resize (system.unknowns ());
  std::array<double, 2> status{};
  parallelTasks (run, 2, [&] (std::size_t side) {
    Info info{};
    Interface::SOLVE (UMFPACK_At, pattern ? pattern->offsets.data () : nullptr,
                      pattern ? pattern->columns.data () : nullptr,
                      pattern ? system.values.data () : nullptr, unknowns[side].data (),
                      rhs[side]->data (), numeric.get (), control.data (), info.data ());
    status[side] = info[UMFPACK_STATUS];
  });
  numeric.reset ();
  for (const double one : status)
    if (!accept (one, "solution", solution))
      return solution;

  solution.uv.resize (system.unknowns ());
  for (std::size_t i = 0; i < system.unknowns (); ++i)
    solution.uv[i] = {unknowns[0][i], unknowns[1][i]};
  solution.outcome = Solution::Outcome::OK;
  return solution;
}

Solution
solveInOrder (const LinearSystem& system, Ordering ordering, const std::vector<int>& order,
              const RunContext& run, UmfpackStrategy strategy)
{
  Solution solution;
  if (system.unknowns () == 0) {
    solution.outcome = Solution::Outcome::OK;
    solution.reciprocal_condition = 1.0;
    return solution;
  }
  // Pivots off the diagonal do not tell of floating unknowns by being small.
  if (strategy == UmfpackStrategy::UNSYMMETRIC && refuseFloatingUnknowns (system, solution))
    return solution;
  const SingleBlasThread single_blas_thread;
  if (system.unknowns () <= LONG_INDEX_UNKNOWNS)
    solution = solve<IntInterface> (system, ordering, order, strategy, run);
  // UMFPACK reports running out of 32-bit indices as running out of memory.
  if (system.unknowns () > LONG_INDEX_UNKNOWNS ||
      solution.outcome == Solution::Outcome::OUT_OF_MEMORY)
    solution = solve<LongInterface> (system, ordering, order, strategy, run);
  if (solution.outcome == Solution::Outcome::OK)
    recordResidual (system, solution);
  return solution;
}

} // namespace

Solution
solveWithUmfpack (const LinearSystem& system, Ordering ordering, const RunContext& run,
                  UmfpackStrategy strategy)
{
  std::vector<int> order;
  if (ordering == Ordering::NATURAL) {
    order.resize (system.unknowns ());
    std::iota (order.begin (), order.end (), 0);
  }
  return solveInOrder (system, ordering, order, run, strategy);
}

Solution
solveWithUmfpack (const LinearSystem& system, const std::vector<int>& order, const RunContext& run)
{
  return solveInOrder (system, Ordering::NATURAL, order, run, UmfpackStrategy::SYMMETRIC);
}

} // namespace pcl::floater

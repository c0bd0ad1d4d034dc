// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/solver.h"

#include "core/parallel.h"

#include <Eigen/UmfPackSupport>

#include <dlfcn.h>
#include <sys/mman.h>

#include <memory>
#include <new>

namespace pcl::floater {
namespace {
// Unknowns from which on the interface has 64-bit indices. That with 32 bits takes a fifth less
// memory, and holds factors of up to 2 GB; there are about 1.2 kB of them per unknown.
constexpr std::size_t LONG_INDEX_UNKNOWNS = 1000000;

// UMFPACK's handles are freed through a pointer to them.
using Handle = std::unique_ptr<void, void (*) (void*)>;

using Control = std::array<double, UMFPACK_CONTROL>;
using Info = std::array<double, UMFPACK_INFO>;

// Records the reason if a call has failed.
// \return true if it has not
bool
accept (const Info& info, const char* call, Solution& solution)
{
  const int code = static_cast<int> (info[UMFPACK_STATUS]);
  if (code == UMFPACK_OK)
    return true;
  const RunStatus status = code == UMFPACK_WARNING_singular_matrix ? RunStatus::SINGULAR
                           : code == UMFPACK_ERROR_out_of_memory   ? RunStatus::OUT_OF_MEMORY
                                                                   : RunStatus::INTERNAL_ERROR;
  solution.problem =
      notSolved (status, std::string (call) + ": UMFPACK status " + std::to_string (code));
  return false;
}

// Eigen has overloads of UMFPACK's functions for either type of indices, but for one.
template <typename Int>
void
solveWithIndices (const LinearSystem& system, const Control& control, const RunContext& run,
                  Solution& solution)
{
  constexpr auto analyze = [] {
    if constexpr (std::is_same_v<Int, int>)
      return &umfpack_di_qsymbolic;
    else
      return &umfpack_dl_qsymbolic;
  }();
  Info info{};
  Handle numeric (nullptr, [] (void* it) { Eigen::umfpack_free_numeric (&it, 0.0, Int{}); });
  { // the matrix is not needed afterwards: there is no refinement
    const auto n = static_cast<Int> (system.unknowns ());
    const int *first = system.matrix.outerIndexPtr (), *column = system.matrix.innerIndexPtr ();
    const double* const values = system.matrix.valuePtr ();
    const std::vector<Int> offsets (first, first + n + 1), columns (column, column + first[n]);
    void* handle = nullptr;
    std::vector<Int> order (control[UMFPACK_FIXQ] > 0.0 ? system.unknowns () : 0);
    std::iota (order.begin (), order.end (), Int{0});
    analyze (n, n, offsets.data (), columns.data (), values,
             order.empty () ? nullptr : order.data (), &handle, control.data (), info.data ());
    const Handle symbolic (std::exchange (handle, nullptr),
                           [] (void* it) { Eigen::umfpack_free_symbolic (&it, 0.0, Int{}); });
    if (!accept (info, "symbolic analysis", solution))
      return;
    Eigen::umfpack_numeric (offsets.data (), columns.data (), values, symbolic.get (), &handle,
                            control.data (), info.data ());
    numeric.reset (handle);
  }
  // UMFPACK leaves -1 for figures that it did not compute.
  const auto figure = [&info] (std::size_t entry) { return std::max (0.0, info[entry]); };
  solution.factorization_bytes =
      static_cast<std::size_t> (figure (UMFPACK_PEAK_MEMORY) * figure (UMFPACK_SIZE_OF_UNIT));
  solution.reciprocal_condition = figure (UMFPACK_RCOND);
  if (!accept (info, "factorization", solution))
    return;
  solution.nnz_factors =
      static_cast<std::size_t> (info[UMFPACK_LNZ] + info[UMFPACK_UNZ]) - system.unknowns ();

  // The factors are only read, so both right-hand sides can be solved at the same time.
  Eigen::MatrixX2d uv (system.rhs.rows (), 2);
  std::array<Info, 2> of_side{};
  parallelTasks (run, 2, [&] (std::size_t side) {
    const auto at = static_cast<Eigen::Index> (side);
    const Int* const no_index = nullptr;
    Eigen::umfpack_solve (UMFPACK_At, no_index, no_index, nullptr, uv.col (at).data (),
                          system.rhs.col (at).data (), numeric.get (), control.data (),
                          of_side[side].data ());
  });
  if (accept (of_side[0], "solution", solution) && accept (of_side[1], "solution", solution))
    solution.uv = std::move (uv);
}

using Get = int (*) ();
using Set = void (*) (int);

std::mutex blas_mutex; // guards the next two
int blas_users = 0;
int threads_before = 1; // before the first user

// Of OpenBLAS, if that is the BLAS of the process; else nullptr.
template <typename Function>
Function
blasFunction (const char* name)
{
  return reinterpret_cast<Function> (dlsym (RTLD_DEFAULT, name));
}

} // namespace

SingleBlasThread::SingleBlasThread ()
{
  const auto get = blasFunction<Get> ("openblas_get_num_threads");
  const auto set = blasFunction<Set> ("openblas_set_num_threads");
  if (set != nullptr) {
    // OpenBLAS maps a work buffer at its first use, and retries forever if memory is short.
    constexpr std::size_t BUFFER_BYTES = std::size_t{128} << 20; // of OpenBLAS 0.3 on x86-64
    void* const room = mmap (nullptr, BUFFER_BYTES, PROT_READ | PROT_WRITE,
                             MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (room == MAP_FAILED || munmap (room, BUFFER_BYTES) != 0)
      throw std::bad_alloc ();
  }
  const std::lock_guard<std::mutex> lock (blas_mutex);
  if (blas_users++ > 0 || get == nullptr || set == nullptr)
    return;
  threads_before = get ();
  set (1);
}

SingleBlasThread::~SingleBlasThread ()
{
  const std::lock_guard<std::mutex> lock (blas_mutex);
  if (--blas_users == 0 && threads_before != 1)
    blasFunction<Set> ("openblas_set_num_threads") (threads_before);
}

void
solveWithUmfpack (const LinearSystem& system, Ordering ordering, const RunContext& run,
                  Solution& solution)
{
  const SingleBlasThread single_blas_thread;
  Control control{};
  umfpack_di_defaults (control.data ()); // the same for both integers
  control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
  control[UMFPACK_SCALE] = UMFPACK_SCALE_NONE;
  control[UMFPACK_IRSTEP] = 0.0; // pivots on the diagonal need no refinement
  control[UMFPACK_ORDERING] = UMFPACK_ORDERING_AMD;
  if (ordering == Ordering::NATURAL) {
    control[UMFPACK_FIXQ] = 1.0;
    // Without AMD's estimate, UMFPACK would allocate far too much memory in advance. With 0 it
    // begins with the least memory it needs, and grows in steps.
    control[UMFPACK_ALLOC_INIT] = 0.0;
  }
  const bool is_long = system.unknowns () > LONG_INDEX_UNKNOWNS;
  if (!is_long)
    solveWithIndices<int> (system, control, run, solution);
  // UMFPACK reports running out of 32-bit indices as running out of memory.
  if (is_long || solution.problem.status == RunStatus::OUT_OF_MEMORY) {
    solution.problem = {};
    solveWithIndices<SuiteSparse_long> (system, control, run, solution);
  }
}

} // namespace pcl::floater

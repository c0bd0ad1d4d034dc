// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "umfpack_sizes.h"

#include "floater/solvers/single_blas_thread.h"

#include <umfpack.h>

#include <array>
#include <stdexcept>
#include <string>

namespace pcl
{
namespace floater
{
UmfpackSizes
measureUmfpack (const LinearSystem& system)
{
  const SingleBlasThread single_blas_thread;
  std::array<double, UMFPACK_CONTROL> control{};
  std::array<double, UMFPACK_INFO> info{};
  umfpack_di_defaults (control.data ());
  control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
  control[UMFPACK_SCALE] = UMFPACK_SCALE_NONE;
  control[UMFPACK_ORDERING] = UMFPACK_ORDERING_AMD;
  const auto n = static_cast<int> (system.unknowns ());
  void *symbolic = nullptr, *numeric = nullptr;
  umfpack_di_symbolic (n, n, system.row_offsets.data (), system.columns.data (),
                       system.values.data (), &symbolic, control.data (), info.data ());
  int status = static_cast<int> (info[UMFPACK_STATUS]);
  if (status == UMFPACK_OK) {
    umfpack_di_numeric (system.row_offsets.data (), system.columns.data (), system.values.data (),
                        symbolic, &numeric, control.data (), info.data ());
    status = static_cast<int> (info[UMFPACK_STATUS]);
  }
  umfpack_di_free_symbolic (&symbolic);
  umfpack_di_free_numeric (&numeric);
  if (status != UMFPACK_OK)
    throw std::runtime_error ("UMFPACK status " + std::to_string (status));

  const auto bytes = [&info] (int entry) {
    return static_cast<std::size_t> (info[static_cast<std::size_t> (entry)] *
                                     info[UMFPACK_SIZE_OF_UNIT]);
  };
  UmfpackSizes sizes;
  sizes.factors = bytes (UMFPACK_VARIABLE_FINAL);
  sizes.permutations = bytes (UMFPACK_NUMERIC_SIZE) - sizes.factors;
  sizes.peak = bytes (UMFPACK_PEAK_MEMORY);
  sizes.nnz_factors =
      static_cast<std::size_t> (info[UMFPACK_LNZ] + info[UMFPACK_UNZ]) - system.unknowns ();
  return sizes;
}

} // namespace floater
} // namespace pcl

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What UMFPACK keeps of a factorization.
#pragma once

#include "floater/solvers/linear_system.h"

namespace pcl
{
namespace floater
{
/// Bytes, as UMFPACK itself counts them.
struct UmfpackSizes
{
  std::size_t factors = 0;      ///< numbers and pattern of L and U
  std::size_t permutations = 0; ///< P, Q, the diagonal, and all else that is kept
  std::size_t peak = 0;         ///< while it factorizes
  std::size_t nnz_factors = 0;  ///< nnz (L + U), unit diagonal of L not counted
};

/// Factorizes as the library does by default, with 32-bit indices.
/// \throw std::runtime_error with UMFPACK's status
UmfpackSizes
measureUmfpack (const LinearSystem& system);

} // namespace floater
} // namespace pcl

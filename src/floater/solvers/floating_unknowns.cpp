// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/floating_unknowns.h"

#include <cmath>
#include <string>

namespace pcl::floater {
namespace {
// Largest rounding error of the sum of a row, relative to it. The smallest weight of a row is far
// larger (SMALLEST_WEIGHT).
constexpr double ROUNDING = 1e-13;

} // namespace

std::size_t
countFloatingUnknowns (const LinearSystem& system)
{
  const std::size_t n = system.unknowns ();
  std::vector<std::uint8_t> tied (n, 0);
  std::vector<Index> queue;
  queue.reserve (n);
  const auto entries = [&system] (std::size_t i, const auto& visit) {
    const auto last = static_cast<std::size_t> (system.row_offsets[i + 1]);
    for (auto entry = static_cast<std::size_t> (system.row_offsets[i]); entry < last; ++entry)
      if (system.values[entry] != 0.0)
        visit (static_cast<std::size_t> (system.columns[entry]), std::abs (system.values[entry]));
  };
  for (std::size_t i = 0; i < n; ++i) {
    double diagonal = 0.0, others = 0.0;
    entries (i, [&] (std::size_t j, double value) { (i == j ? diagonal : others) += value; });
    if (diagonal - others > ROUNDING * diagonal) {
      tied[i] = 1;
      queue.push_back (static_cast<Index> (i));
    }
  }
  // Row j holds the unknowns that have j in their row.
  const CsrLists leading_to = makeCsrLists (n, [&] (const auto& emit) {
    for (std::size_t i = 0; i < n; ++i)
      entries (i, [&] (std::size_t j, double) {
        if (i != j)
          emit (j, static_cast<Index> (i));
      });
  });
  for (std::size_t head = 0; head < queue.size (); ++head)
    for (const Index i : leading_to.row (queue[head]))
      if (tied[i] == 0) {
        tied[i] = 1;
        queue.push_back (i);
      }
  return n - queue.size ();
}

bool
refuseFloatingUnknowns (const LinearSystem& system, Solution& solution)
{
  const std::size_t floating = countFloatingUnknowns (system);
  if (floating == 0)
    return false;
  solution.outcome = Solution::Outcome::SINGULAR;
  solution.message =
      std::to_string (floating) + (floating == 1 ? " unknown does not depend on the boundary"
                                                 : " unknowns do not depend on the boundary");
  return true;
}

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/solver_parts.h"

#include <cholmod.h>

#include <array>
#include <cstdlib>
#include <mutex>
#include <new>
#include <utility>

namespace pcl::floater {
namespace {
// The pattern of A + A^T without the diagonal.
CsrLists
symmetricPattern (const LinearSystem& system)
{
  const auto has = [&system] (std::size_t i, std::size_t column) {
    return std::binary_search (system.columns.begin () + system.row_offsets[i],
                               system.columns.begin () + system.row_offsets[i + 1],
                               static_cast<int> (column));
  };
  return makeCsrLists (system.unknowns (), [&] (const auto& emit) {
    for (std::size_t i = 0; i < system.unknowns (); ++i)
      system.visitRow (i, [&] (std::size_t j, double) {
        if (i == j)
          return;
        emit (i, static_cast<Index> (j));
        if (!has (j, i))
          emit (j, static_cast<Index> (i));
      });
  });
}

// Calls METIS with a state of rand () of its own.
int
callMetis (cholmod_sparse& pattern, int* order, cholmod_common& common)
{
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock (mutex);
  std::array<char, 128> state{}; // as many bytes as rand () has in the beginning
  char* const before = initstate (1, state.data (), state.size ());
  constexpr int POSTORDER = 1;
  const int done = cholmod_metis (&pattern, nullptr, 0, POSTORDER, order, &common);
  setstate (before);
  return done;
}

// Approximate minimum degree (Amestoy, Davis and Duff 1996), or nested dissection by METIS (Karypis
// and Kumar 1998).
std::vector<int>
orderByCholmod (const CsrLists& symmetric, Ordering ordering)
{
  std::vector<int> offsets (symmetric.offsets.begin (), symmetric.offsets.end ());
  std::vector<int> rows (symmetric.ids.begin (), symmetric.ids.end ());
  std::vector<int> order (symmetric.rows ());
  cholmod_sparse pattern{};
  pattern.nrow = pattern.ncol = order.size ();
  pattern.nzmax = rows.size ();
  pattern.p = offsets.data ();
  pattern.i = rows.data ();
  pattern.stype = 1; // symmetric, read from its upper triangle
  pattern.itype = CHOLMOD_INT;
  pattern.xtype = CHOLMOD_PATTERN;
  pattern.dtype = CHOLMOD_DOUBLE;
  pattern.packed = 1;
  cholmod_common common{};
  cholmod_start (&common);
  common.print = 0;
  const int done = ordering == Ordering::METIS
                       ? callMetis (pattern, order.data (), common)
                       : cholmod_amd (&pattern, nullptr, 0, order.data (), &common);
  cholmod_finish (&common);
  if (done == 0)
    throw std::bad_alloc (); // the pattern is valid; METIS does not tell what it lacks
  return order;
}

// Each component level by level, and in a level those of few neighbours first (Cuthill and McKee
// 1969); the reverse of that (George 1971).
std::vector<int>
reverseCuthillMckee (const CsrLists& graph)
{
  std::vector<int> order;
  std::vector<std::uint8_t> seen (graph.rows (), 0);
  const auto neighbors = [&graph] (int v) { return graph.row (static_cast<std::size_t> (v)); };
  const auto addFrom = [&] (int start) {
    std::size_t levels = 0, level_end = order.size ();
    seen[static_cast<std::size_t> (start)] = 1;
    order.push_back (start);
    for (std::size_t head = level_end; head < order.size (); ++head) {
      if (head == level_end) {
        ++levels;
        level_end = order.size ();
      }
      const auto first = static_cast<std::ptrdiff_t> (order.size ());
      for (const Index next : neighbors (order[head]))
        if (std::exchange (seen[next], std::uint8_t{1}) == 0)
          order.push_back (static_cast<int> (next));
      std::stable_sort (order.begin () + first, order.end (), [&] (int a, int b) {
        return neighbors (a).size () < neighbors (b).size ();
      });
    }
    return levels;
  };
  for (std::size_t v = 0; v < graph.rows (); ++v) {
    if (seen[v] != 0)
      continue;
    // It begins at a vertex that is nearly as far as possible from another (George and Liu 1979).
    const std::size_t begin = order.size ();
    std::size_t levels = addFrom (static_cast<int> (v));
    for (std::size_t before = 0; before < levels;) {
      before = levels;
      const int last = order.back ();
      for (std::size_t i = begin; i < order.size (); ++i)
        seen[static_cast<std::size_t> (order[i])] = 0;
      order.resize (begin);
      levels = addFrom (last);
    }
  }
  std::reverse (order.begin (), order.end ());
  return order;
}

} // namespace

std::vector<int>
orderUnknowns (const LinearSystem& system, Ordering ordering)
{
  const CsrLists symmetric = symmetricPattern (system);
  return ordering == Ordering::REVERSE_CUTHILL_MCKEE ? reverseCuthillMckee (symmetric)
                                                     : orderByCholmod (symmetric, ordering);
}

LinearSystem
permuteSystem (const LinearSystem& system, const std::vector<int>& order)
{
  std::vector<int> place (order.size ());
  for (std::size_t i = 0; i < order.size (); ++i)
    place[static_cast<std::size_t> (order[i])] = static_cast<int> (i);
  LinearSystem permuted;
  permuted.columns.reserve (system.nonzeros ());
  permuted.values.reserve (system.nonzeros ());
  permuted.rhs.resize (system.rhs.rows (), 2);
  std::vector<std::pair<int, double>> row;
  for (std::size_t i = 0; i < order.size (); ++i) {
    row.clear ();
    system.visitRow (static_cast<std::size_t> (order[i]), [&] (std::size_t column, double value) {
      row.emplace_back (place[column], value);
    });
    permuted.addRow (row);
    permuted.rhs.row (static_cast<Eigen::Index> (i)) = system.rhs.row (order[i]);
  }
  return permuted;
}

} // namespace pcl::floater

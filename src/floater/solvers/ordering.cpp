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
using Order = Eigen::PermutationMatrix<Eigen::Dynamic>;

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
Order
orderByCholmod (SystemMatrix& symmetric, Ordering ordering)
{
  Order order (symmetric.rows ());
  cholmod_sparse pattern{};
  pattern.nrow = pattern.ncol = static_cast<std::size_t> (symmetric.rows ());
  pattern.nzmax = static_cast<std::size_t> (symmetric.nonZeros ());
  pattern.p = symmetric.outerIndexPtr ();
  pattern.i = symmetric.innerIndexPtr ();
  pattern.stype = 1; // symmetric, read from its upper triangle
  pattern.itype = CHOLMOD_INT;
  pattern.xtype = CHOLMOD_PATTERN;
  pattern.dtype = CHOLMOD_DOUBLE;
  pattern.packed = 1;
  cholmod_common common{};
  cholmod_start (&common);
  common.print = 0;
  const int done = ordering == Ordering::METIS
                       ? callMetis (pattern, order.indices ().data (), common)
                       : cholmod_amd (&pattern, nullptr, 0, order.indices ().data (), &common);
  cholmod_finish (&common);
  if (done == 0)
    throw std::bad_alloc (); // the pattern is valid; METIS does not tell what it lacks
  return order;
}

// Each component level by level, and in a level those of few neighbours first (Cuthill and McKee
// 1969); the reverse of that (George 1971).
Order
reverseCuthillMckee (const SystemMatrix& graph)
{
  std::vector<int> order;
  std::vector<std::uint8_t> seen (static_cast<std::size_t> (graph.rows ()), 0);
  const auto isNew = [&seen] (int v) {
    return std::exchange (seen[static_cast<std::size_t> (v)], std::uint8_t{1}) == 0;
  };
  const int* const offsets = graph.outerIndexPtr ();
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
      for (SystemMatrix::InnerIterator next (graph, order[head]); next; ++next)
        if (isNew (next.index ()))
          order.push_back (next.index ());
      std::stable_sort (order.begin () + first, order.end (), [offsets] (int a, int b) {
        return offsets[a + 1] - offsets[a] < offsets[b + 1] - offsets[b];
      });
    }
    return levels;
  };
  for (int v = 0; v < graph.rows (); ++v) {
    if (seen[static_cast<std::size_t> (v)] != 0)
      continue;
    // It begins at a vertex that is nearly as far as possible from another (George and Liu 1979).
    const std::size_t begin = order.size ();
    std::size_t levels = addFrom (v);
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
  return Order (Eigen::Map<Eigen::VectorXi> (order.data (), graph.rows ()));
}

} // namespace

Order
orderUnknowns (const SystemMatrix& matrix, Ordering ordering)
{
  SystemMatrix symmetric = matrix + SystemMatrix (matrix.transpose ());
  return ordering == Ordering::REVERSE_CUTHILL_MCKEE ? reverseCuthillMckee (symmetric)
                                                     : orderByCholmod (symmetric, ordering);
}

} // namespace pcl::floater

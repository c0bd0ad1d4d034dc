// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic_factors.h"

#include "floater/solvers/ordering.h"

#include <algorithm>

namespace pcl
{
namespace floater
{
namespace
{
// Neighbours of each unknown by the pattern of A + A^T, without the diagonal, ascending.
CsrLists
symmetricPattern (const LinearSystem& system)
{
  const std::size_t n = system.unknowns ();
  std::vector<std::vector<Index>> lists (n);
  for (Index i = 0; i < n; ++i)
    for (int entry = system.row_offsets[i]; entry < system.row_offsets[i + 1]; ++entry) {
      const auto j = static_cast<Index> (system.columns[static_cast<std::size_t> (entry)]);
      if (j == i)
        continue;
      lists[i].push_back (j);
      lists[j].push_back (i);
    }
  CsrLists pattern;
  pattern.offsets.push_back (0);
  for (std::vector<Index>& list : lists) {
    std::sort (list.begin (), list.end ());
    list.erase (std::unique (list.begin (), list.end ()), list.end ());
    pattern.ids.insert (pattern.ids.end (), list.begin (), list.end ());
    pattern.offsets.push_back (static_cast<Index> (pattern.ids.size ()));
  }
  return pattern;
}

} // namespace

// Row i of L is the subtree of the elimination tree that the entries of A's row i, read as leaves,
// span below i (Liu 1990): each climbs towards i until it meets a node that was there before.
std::size_t
symbolicFactors (const LinearSystem& system, const std::vector<int>& order,
                 const std::function<void (Index, Index)>& visit)
{
  const CsrLists pattern = symmetricPattern (permuteSystem (system, order));
  const std::size_t n = order.size ();

  // The elimination tree, with shortcuts to the roots so far.
  std::vector<Index> parent (n, NONE), ancestor (n, NONE);
  for (Index i = 0; i < n; ++i)
    for (const Index neighbor : pattern.row (i))
      for (Index j = neighbor; j < i;) {
        const Index next = ancestor[j];
        ancestor[j] = i;
        if (next == NONE) {
          parent[j] = i;
          break;
        }
        j = next;
      }

  std::size_t below = 0;
  std::vector<Index> seen (n, NONE);
  for (Index i = 0; i < n; ++i) {
    seen[i] = i;
    for (const Index neighbor : pattern.row (i))
      for (Index j = neighbor; j < i && seen[j] != i; j = parent[j]) {
        seen[j] = i;
        ++below;
        if (visit)
          visit (i, j);
      }
  }
  return 2 * below + n;
}

} // namespace floater
} // namespace pcl

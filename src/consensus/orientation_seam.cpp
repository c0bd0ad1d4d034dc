// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "consensus/orientation_seam.h"

#include "core/disjoint_sets.h"

#include <algorithm>
#include <tuple>

namespace pcl::floater {
std::vector<Triangle>
findOrientationSeam (const std::vector<Triangle>& contradicting, std::size_t shortest_seam)
{
  struct Edge
  {
    Index from, to, triangle;
  };
  std::vector<Edge> edges;
  edges.reserve (3 * contradicting.size ());
  for (Index t = 0; t < contradicting.size (); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [from, to] = std::minmax (contradicting[t][i], contradicting[t][(i + 1) % 3]);
      edges.push_back ({from, to, t});
    }
  std::sort (edges.begin (), edges.end (), [] (const Edge& a, const Edge& b) {
    return std::tie (a.from, a.to, a.triangle) < std::tie (b.from, b.to, b.triangle);
  });
  DisjointSets rows (contradicting.size ());
  for (std::size_t i = 1; i < edges.size (); ++i)
    if (edges[i].from == edges[i - 1].from && edges[i].to == edges[i - 1].to)
      rows.join (edges[i].triangle, edges[i - 1].triangle);

  std::vector<std::size_t> length (contradicting.size (), 0);
  for (Index t = 0; t < contradicting.size (); ++t)
    ++length[rows.find (t)];
  const auto longest = std::max_element (length.begin (), length.end ());
  std::vector<Triangle> row;
  if (longest == length.end () || *longest < shortest_seam)
    return row;
  const auto root = static_cast<Index> (longest - length.begin ());
  for (Index t = 0; t < contradicting.size (); ++t)
    if (rows.find (t) == root)
      row.push_back (contradicting[t]);
  return row;
}

} // namespace pcl::floater

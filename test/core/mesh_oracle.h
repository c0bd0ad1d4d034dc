// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Topology of a mesh, computed without any code of the library.
#pragma once

#include "core/types.h"

#include <map>
#include <set>
#include <utility>
#include <vector>

namespace pcl::floater::samples {
/// Topology of a mesh, counted from its edges.
struct MeshTopology
{
  bool manifold = true; ///< edges with one or two oppositely directed triangles, one fan per vertex
  std::size_t vertices = 0;
  std::size_t components = 0;
  long euler = 0;
  std::vector<std::vector<Index>> loops;
};

template <typename Triangles>
MeshTopology
topologyOf (const Triangles& triangles)
{
  MeshTopology topology;
  std::map<std::pair<Index, Index>, std::size_t> directed;
  std::map<Index, Index> parent;                       // of components
  std::map<Index, std::map<Index, Index>> next_in_fan; // by vertex: edge to edge, anti-clockwise
  const auto root = [&parent] (Index p) {
    while (parent[p] != p)
      p = parent[p] = parent[parent[p]];
    return p;
  };
  for (const auto& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = static_cast<Index> (t[i]), b = static_cast<Index> (t[(i + 1) % 3]),
                 c = static_cast<Index> (t[(i + 2) % 3]);
      topology.manifold = topology.manifold && a != b && ++directed[{a, b}] == 1;
      parent.emplace (a, a);
      parent.emplace (b, b);
      parent[root (a)] = root (b);
      next_in_fan[a][b] = c;
    }
  topology.vertices = parent.size ();
  std::size_t undirected = 0;
  std::map<Index, Index> successor;
  for (const auto& [edge, count] : directed) {
    const bool at_boundary = directed.count ({edge.second, edge.first}) == 0;
    undirected += at_boundary || edge.first < edge.second ? 1 : 0;
    if (at_boundary)
      topology.manifold = topology.manifold && successor.emplace (edge).second;
  }
  for (auto& [p, fan] : next_in_fan) {
    // The fan begins at an edge that is the end of no triangle; in a closed fan anywhere.
    std::set<Index> ends;
    for (const auto& [from, to] : fan)
      ends.insert (to);
    Index start = fan.begin ()->first;
    for (const auto& [from, to] : fan)
      if (ends.count (from) == 0)
        start = from;
    std::size_t length = 0;
    for (Index at = start; length <= fan.size () && fan.count (at) != 0; at = fan[at]) {
      if (length > 0 && at == start)
        break;
      ++length;
    }
    topology.manifold = topology.manifold && length == fan.size ();
  }
  for (const auto& [p, unused] : parent)
    topology.components += root (p) == p ? 1 : 0;
  topology.euler = static_cast<long> (topology.vertices) - static_cast<long> (undirected) +
                   static_cast<long> (triangles.size ());
  while (!successor.empty ()) {
    std::vector<Index> loop;
    for (auto at = successor.begin (); at != successor.end ();) {
      loop.push_back (at->first);
      const Index next = at->second;
      successor.erase (at);
      at = successor.find (next);
    }
    topology.loops.push_back (std::move (loop));
  }
  return topology;
}

} // namespace pcl::floater::samples

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/ordering.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/cuthill_mckee_ordering.hpp>
#include <boost/graph/properties.hpp>

namespace pcl::floater {
std::vector<int>
reverseCuthillMckee (const LinearSystem& system)
{
  using Graph =
      boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS,
                            boost::property<boost::vertex_color_t, boost::default_color_type,
                                            boost::property<boost::vertex_degree_t, int>>>;
  const std::size_t n = system.unknowns ();
  Graph graph (n);
  const auto has = [&system] (std::size_t i, int column) {
    return std::binary_search (system.columns.begin () + system.row_offsets[i],
                               system.columns.begin () + system.row_offsets[i + 1], column);
  };
  for (std::size_t i = 0; i < n; ++i)
    for (int entry = system.row_offsets[i]; entry < system.row_offsets[i + 1]; ++entry) {
      const auto j = static_cast<std::size_t> (system.columns[static_cast<std::size_t> (entry)]);
      // Once for each pair: by the smaller unknown, or by the only one of both that has the other.
      if (i < j || (i > j && !has (j, static_cast<int> (i))))
        boost::add_edge (i, j, graph);
    }
  std::vector<boost::graph_traits<Graph>::vertex_descriptor> order (n);
  boost::cuthill_mckee_ordering (graph, order.rbegin (), boost::get (boost::vertex_color, graph),
                                 boost::make_degree_map (graph));
  return {order.begin (), order.end ()};
}

} // namespace pcl::floater

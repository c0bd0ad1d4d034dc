// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/solver_parts.h"

#include <Eigen/CholmodSupport>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/cuthill_mckee_ordering.hpp>

#include <array>
#include <cstdlib>
#include <iterator>
#include <mutex>
#include <new>

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
orderByCholmod (const SystemMatrix& symmetric, Ordering ordering)
{
  Order order (symmetric.rows ());
  cholmod_sparse pattern = Eigen::viewAsCholmod (symmetric.selfadjointView<Eigen::Lower> ());
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

// Small bandwidth (Cuthill and McKee 1969; George 1971).
Order
reverseCuthillMckee (const SystemMatrix& symmetric)
{
  using Color = boost::property<boost::vertex_color_t, boost::default_color_type>;
  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, Color>;
  Graph graph (static_cast<std::size_t> (symmetric.rows ()));
  for (int row = 0; row < symmetric.rows (); ++row)
    for (SystemMatrix::InnerIterator entry (symmetric, row); entry && entry.col () < row; ++entry)
      boost::add_edge (static_cast<std::size_t> (row), static_cast<std::size_t> (entry.col ()),
                       graph);
  Order order (symmetric.rows ());
  int* const end = order.indices ().data () + order.size ();
  boost::cuthill_mckee_ordering (graph, std::make_reverse_iterator (end),
                                 boost::get (boost::vertex_color, graph),
                                 boost::make_degree_map (graph));
  return order;
}

} // namespace

Order
orderUnknowns (const SystemMatrix& matrix, Ordering ordering)
{
  const SystemMatrix symmetric = matrix + SystemMatrix (matrix.transpose ());
  return ordering == Ordering::REVERSE_CUTHILL_MCKEE ? reverseCuthillMckee (symmetric)
                                                     : orderByCholmod (symmetric, ordering);
}

} // namespace pcl::floater

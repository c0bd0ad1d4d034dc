// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A smallest set of vertices that separates a graph into two parts.
#pragma once

#include "core/csr_lists.h"

#include <vector>

namespace pcl::floater {
/// The part of a graph to which a vertex belongs.
enum class CutPart : std::uint8_t
{
  FIRST,  ///< on the first side
  SECOND, ///< on the second side
  CUT     ///< in the cut between them
};

/// Sides outside of the graph that a vertex is next to; the sum if it is next to both.
enum CutEnds : std::uint8_t
{
  INSIDE = 0,
  NEXT_TO_FIRST = 1,
  NEXT_TO_SECOND = 2
};

/// Finds a smallest set of vertices without which no path leads from the first side to the second
/// one. Of several such cuts it finds the one that is nearest to the first side. By Menger's
/// theorem a cut has as many vertices as there are paths without a common vertex. Dinic's algorithm
/// finds these, with each vertex split into an entry and an exit joined by an arc of capacity 1.
/// O(sqrt (vertices) entries), and far less in a narrow band. Keeps its memory from call to call.
class VertexCut
{
public:
  /// \param graph symmetric; no vertex is its own neighbour
  /// \param ends  per vertex: CutEnds
  /// \return per vertex: its part; valid until the next call
  const std::vector<CutPart>& find (const CsrLists& graph, const std::vector<std::uint8_t>& ends);

private:
  using State = Index; // of the residual network: 2 v is the entry of vertex v, 2 v + 1 its exit
  static State entryOf (Index v) { return 2 * v; }
  static State exitOf (Index v) { return 2 * v + 1; }

  bool isOnPath (Index v) const { return before_[v] != NONE; }
  Index successors (State s) const;
  State successor (State s, Index arc) const;
  bool isLast (State s) const;
  bool layer (bool whole);
  bool findPath (State start);
  void usePath ();

  const CsrLists* graph_ = nullptr;
  const std::vector<std::uint8_t>* ends_ = nullptr;
  std::vector<Index> starts_; // vertices next to the first side
  std::vector<Index> before_,
      after_;                // per vertex: its neighbours on its path, or SIDE; NONE: no path
  std::vector<Index> level_; // per state: distance from the first side
  std::vector<Index> arc_;   // per state: the first arc that is still worth trying
  std::vector<State> queue_, path_;
  std::vector<CutPart> parts_;
};

} // namespace pcl::floater

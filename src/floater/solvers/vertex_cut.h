// SPDX-License-Identifier: GPL-3.0-or-later
// A smallest set of vertices that parts a graph in two.
#pragma once

#include "core/csr_lists.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Where a vertex ends up.
enum class CutPart : std::uint8_t
{
  FIRST, ///< on the first side
  SECOND,
  CUT ///< between them
};

/// What lies beyond a vertex; of one that is next to both sides, the sum of the two.
enum CutEnds : std::uint8_t
{
  INSIDE = 0,
  NEXT_TO_FIRST = 1,
  NEXT_TO_SECOND = 2
};

/// Finds a smallest set of vertices whose removal leaves no way from the first side to the second,
/// that one which is nearest to the first side. By Menger's theorem it has as many vertices as
/// there are ways without a common vertex; these are found by Dinic's algorithm, in which a vertex
/// is a way in and a way out joined by an arc of capacity 1. O(sqrt (vertices) entries), far less
/// in a narrow band. Keeps its memory from call to call.
class VertexCut
{
public:
  /// \param graph symmetric, no vertex its own neighbour
  /// \param ends  of each vertex, CutEnds
  /// \return part of each vertex, valid until the next call
  const std::vector<CutPart>& find (const CsrLists& graph, const std::vector<std::uint8_t>& ends);

private:
  using State = Index; // even on the way into a vertex, odd on the way out
  static State wayInto (Index v) { return 2 * v; }
  static State wayOut (Index v) { return 2 * v + 1; }

  bool isOnWay (Index v) const { return before_[v] != NONE; }
  Index successors (State s) const;
  State successor (State s, Index arc) const;
  bool isLast (State s) const;
  bool layer (bool whole);
  bool findWay (State start);
  void useWay ();

  const CsrLists* graph_ = nullptr;
  const std::vector<std::uint8_t>* ends_ = nullptr;
  std::vector<Index> starts_;
  std::vector<Index> before_, after_; // of each vertex on its way: the next vertices, or SIDE
  std::vector<Index> level_, arc_;    // of each state
  std::vector<State> queue_, way_;
  std::vector<CutPart> parts_;
};

} // namespace floater
} // namespace pcl

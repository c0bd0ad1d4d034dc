// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/vertex_cut.h"

namespace pcl::floater {
namespace {
constexpr Index SIDE = NONE - 1; // instead of a vertex, where a path begins or ends

} // namespace

// The number of arcs that leave a state, those that cannot be used included.
Index
VertexCut::successors (State s) const
{
  return s % 2 == 0 ? 1 : 1 + static_cast<Index> (graph_->row (s / 2).size ());
}

// The state to which an arc of the residual network leads: forwards where there is no path yet,
// backwards along a path. NONE if the arc cannot be used.
VertexCut::State
VertexCut::successor (State s, Index arc) const
{
  const Index v = s / 2;
  if (s % 2 == 0) {
    if (!isOnPath (v))
      return s + 1;
    return before_[v] == SIDE ? NONE : exitOf (before_[v]);
  }
  if (arc == 0)
    return isOnPath (v) ? s - 1 : NONE;
  const Index w = graph_->row (v)[arc - 1];
  return w == after_[v] || w == before_[v] ? NONE : entryOf (w);
}

bool
VertexCut::isLast (State s) const
{
  return s % 2 == 1 && ((*ends_)[s / 2] & NEXT_TO_SECOND) != 0 && after_[s / 2] != SIDE;
}

// Sets the levels of the states up to the first one at which a path can end.
// \param whole of all states that can be reached
// \return true if there was such a state; always false if `whole`
bool
VertexCut::layer (bool whole)
{
  level_.assign (before_.size () * 2, NONE);
  queue_.clear ();
  for (const Index v : starts_) {
    level_[entryOf (v)] = 0;
    queue_.push_back (entryOf (v));
  }
  for (std::size_t head = 0; head < queue_.size (); ++head) {
    const State s = queue_[head];
    if (!whole && isLast (s))
      return true;
    for (Index arc = 0; arc < successors (s); ++arc) {
      const State t = successor (s, arc);
      if (t == NONE || level_[t] != NONE)
        continue;
      level_[t] = level_[s] + 1;
      queue_.push_back (t);
    }
  }
  return false;
}

// Looks for a path along ascending levels. Arcs that have led nowhere are not tried again.
bool
VertexCut::findPath (State start)
{
  path_.assign (1, start);
  while (!path_.empty ()) {
    const State s = path_.back ();
    if (isLast (s))
      return true;
    State next = NONE;
    for (Index& arc = arc_[s]; next == NONE && arc < successors (s);) {
      next = successor (s, arc);
      if (next == NONE || level_[next] != level_[s] + 1) {
        next = NONE;
        ++arc;
      }
    }
    if (next != NONE) {
      path_.push_back (next);
      continue;
    }
    path_.pop_back ();
    if (!path_.empty ())
      ++arc_[path_.back ()];
  }
  return false;
}

// Adds the path that was found. Where it goes back along another path, the two exchange their ends.
void
VertexCut::usePath ()
{
  for (const State s : path_)
    level_[s] = NONE; // a state serves one path only
  for (std::size_t i = 0; i + 1 < path_.size (); ++i)
    if (path_[i] % 2 == 0 && path_[i + 1] / 2 != path_[i] / 2) {
      before_[path_[i] / 2] = NONE;
      after_[path_[i + 1] / 2] = NONE;
    }
  for (std::size_t i = 0; i + 1 < path_.size (); ++i)
    if (path_[i] % 2 == 1 && path_[i + 1] / 2 != path_[i] / 2) {
      after_[path_[i] / 2] = path_[i + 1] / 2;
      before_[path_[i + 1] / 2] = path_[i] / 2;
    }
  before_[path_.front () / 2] = SIDE;
  after_[path_.back () / 2] = SIDE;
}

const std::vector<CutPart>&
VertexCut::find (const CsrLists& graph, const std::vector<std::uint8_t>& ends)
{
  graph_ = &graph;
  ends_ = &ends;
  const std::size_t count = graph.rows ();
  before_.assign (count, NONE);
  after_.assign (count, NONE);
  starts_.clear ();
  for (Index v = 0; v < count; ++v)
    if ((ends[v] & NEXT_TO_FIRST) != 0)
      starts_.push_back (v);

  while (layer (false)) {
    arc_.assign (count * 2, 0);
    for (const Index v : starts_)
      if (before_[v] != SIDE && findPath (entryOf (v)))
        usePath ();
  }
  layer (true);
  parts_.resize (count);
  for (Index v = 0; v < count; ++v)
    parts_[v] = level_[exitOf (v)] != NONE    ? CutPart::FIRST
                : level_[entryOf (v)] != NONE ? CutPart::CUT
                                              : CutPart::SECOND;
  return parts_;
}

} // namespace pcl::floater

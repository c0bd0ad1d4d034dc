// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/solvers/vertex_cut.h"

namespace pcl
{
namespace floater
{
namespace
{
constexpr Index SIDE = NONE - 1; // instead of a vertex: a way begins or ends there

} // namespace

// How many arcs leave a state, those that cannot be used among them.
Index
VertexCut::successors (State s) const
{
  return s % 2 == 0 ? 1 : 1 + static_cast<Index> (graph_->row (s / 2).size ());
}

// Arcs of the residual network: forward where no way goes, back where one does. NONE if the arc
// cannot be used.
VertexCut::State
VertexCut::successor (State s, Index arc) const
{
  const Index v = s / 2;
  if (s % 2 == 0) {
    if (!isOnWay (v))
      return s + 1;
    return before_[v] == SIDE ? NONE : wayOut (before_[v]);
  }
  if (arc == 0)
    return isOnWay (v) ? s - 1 : NONE;
  const Index w = graph_->row (v)[arc - 1];
  return w == after_[v] || w == before_[v] ? NONE : wayInto (w);
}

bool
VertexCut::isLast (State s) const
{
  return s % 2 == 1 && ((*ends_)[s / 2] & NEXT_TO_SECOND) != 0 && after_[s / 2] != SIDE;
}

// Numbers the states by their distance from the first side, as far as the nearest last one, or all.
// \return true if a last one was reached
bool
VertexCut::layer (bool whole)
{
  level_.assign (before_.size () * 2, NONE);
  queue_.clear ();
  for (const Index v : starts_) {
    level_[wayInto (v)] = 0;
    queue_.push_back (wayInto (v));
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

// Looks for a way along ascending levels. What has led nowhere is not tried again (see arc_).
bool
VertexCut::findWay (State start)
{
  way_.assign (1, start);
  while (!way_.empty ()) {
    const State s = way_.back ();
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
      way_.push_back (next);
      continue;
    }
    way_.pop_back ();
    if (!way_.empty ())
      ++arc_[way_.back ()];
  }
  return false;
}

// Adds the way that was found. Where it goes back along another one, the two exchange their ends.
void
VertexCut::useWay ()
{
  for (const State s : way_)
    level_[s] = NONE; // serves one way at a time
  for (std::size_t i = 0; i + 1 < way_.size (); ++i)
    if (way_[i] % 2 == 0 && way_[i + 1] / 2 != way_[i] / 2) {
      before_[way_[i] / 2] = NONE;
      after_[way_[i + 1] / 2] = NONE;
    }
  for (std::size_t i = 0; i + 1 < way_.size (); ++i)
    if (way_[i] % 2 == 1 && way_[i + 1] / 2 != way_[i] / 2) {
      after_[way_[i] / 2] = way_[i + 1] / 2;
      before_[way_[i + 1] / 2] = way_[i] / 2;
    }
  before_[way_.front () / 2] = SIDE;
  after_[way_.back () / 2] = SIDE;
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
      if (before_[v] != SIDE && findWay (wayInto (v)))
        useWay ();
  }
  layer (true);
  parts_.resize (count);
  for (Index v = 0; v < count; ++v)
    parts_[v] = level_[wayOut (v)] != NONE    ? CutPart::FIRST
                : level_[wayInto (v)] != NONE ? CutPart::CUT
                                              : CutPart::SECOND;
  return parts_;
}

} // namespace floater
} // namespace pcl

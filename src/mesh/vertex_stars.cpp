// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/vertex_stars.h"

namespace pcl::floater {
TriangleRanges::TriangleRanges (const std::vector<Triangle>& triangles, std::size_t points,
                                const RunContext& run)
    : points_ (points)
{
  lists_ = makeCsrLists ((points + LENGTH - 1) / LENGTH, [&] (const auto& emit) {
    ProgressLoop progress (run);
    left_out_ = 0;
    for (Index t = 0; t < triangles.size (); ++t) {
      progress.next ();
      const auto [a, b, c] = triangles[t];
      if (!isProper (triangles[t], points)) {
        ++left_out_;
        continue;
      }
      emit (a / LENGTH, t);
      if (b / LENGTH != a / LENGTH)
        emit (b / LENGTH, t);
      if (c / LENGTH != a / LENGTH && c / LENGTH != b / LENGTH)
        emit (c / LENGTH, t);
    }
  });
}

VertexStars::VertexStars (const std::vector<Triangle>& triangles, const TriangleRanges& ranges,
                          std::size_t r)
    : first_ (ranges.firstPoint (r))
{
  const std::size_t points = ranges.lastPoint (r) - first_;
  const auto isHere = [&] (Index p) { return p - first_ < points; }; // also if p is below
  begins_.assign (points + 2, 0);
  for (const Index t : ranges.of (r))
    for (const Index p : triangles[t])
      if (isHere (p))
        ++begins_[p - first_ + 2];
  std::partial_sum (begins_.begin (), begins_.end (), begins_.begin ());
  wedges_.resize (begins_.back ());
  // begins_[p + 1] is the index of the next entry of p; at the end, the end of p.
  for (const Index t : ranges.of (r))
    for (std::size_t i = 0; i < 3; ++i)
      if (const Triangle& c = triangles[t]; isHere (c[i]))
        wedges_[begins_[c[i] - first_ + 1]++] = {t, c[(i + 1) % 3], c[(i + 2) % 3]};
  begins_.pop_back ();
}

bool
StarOrder::set (const VertexStar& star)
{
  leaving_.clear ();
  for (Index i = 0; i < star.size (); ++i)
    leaving_.emplace_back (star[i].next, i);
  std::sort (leaving_.begin (), leaving_.end ());
  const auto isSame = [] (const auto& a, const auto& b) { return a.first == b.first; };
  if (std::adjacent_find (leaving_.begin (), leaving_.end (), isSame) != leaving_.end ())
    return false;
  // A wedge is followed anti-clockwise by the one that begins at its last edge.
  after_.assign (star.size (), NONE);
  before_.assign (star.size (), NONE);
  for (Index i = 0; i < star.size (); ++i) {
    const std::pair<Index, Index> first{star[i].previous, 0};
    const auto found = std::lower_bound (leaving_.begin (), leaving_.end (), first);
    if (found == leaving_.end () || found->first != first.first)
      continue;
    after_[i] = found->second;
    before_[found->second] = i;
  }
  return true;
}

bool
StarOrder::isOneFan () const
{
  if (after_.empty ())
    return true;
  Index start = 0;
  for (Index i = 0; i < before_.size (); ++i)
    if (before_[i] == NONE)
      start = i; // start of an open fan
  // If an edge leads to p twice, the walk may cycle without reaching its start.
  std::size_t count = 1;
  for (Index i = after_[start]; i != NONE && i != start && count <= after_.size (); i = after_[i])
    ++count;
  return count == after_.size ();
}

} // namespace pcl::floater

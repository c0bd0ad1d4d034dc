// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/vertex_stars.h"

#include "core/parallel.h"

#include <numeric>

namespace pcl::floater {
namespace {
// Triangles are counted in chunks: few, as each has a counter for each range; enough for the
// threads of a large machine; long enough to be worth a task.
constexpr std::size_t MOST_CHUNKS = 64, SHORTEST_CHUNK = 65536;

// Number of wedges up to which comparing all pairs is faster than a hash table. Measured.
constexpr std::size_t MANY_IN_STAR = 32;

// Calls body (r) for each range that has a corner of the triangle.
template <typename Body>
void
forRangesOf (const Triangle& t, Body&& body)
{
  const std::size_t a = t[0] / TriangleRanges::LENGTH, b = t[1] / TriangleRanges::LENGTH,
                    c = t[2] / TriangleRanges::LENGTH;
  body (a);
  if (b != a)
    body (b);
  if (c != a && c != b)
    body (c);
}

} // namespace

TriangleRanges::TriangleRanges (const std::vector<Triangle>& triangles, std::size_t points,
                                const RunContext& run)
    : points_ (points), begins_ ((points + LENGTH - 1) / LENGTH + 1, 0)
{
  const std::size_t ranges = count ();
  const std::size_t length =
      std::max (SHORTEST_CHUNK, (triangles.size () + MOST_CHUNKS - 1) / MOST_CHUNKS);
  const std::size_t chunks = (triangles.size () + length - 1) / length;
  const auto forChunk = [&] (std::size_t chunk, const auto& body) {
    const std::size_t last = std::min (triangles.size (), (chunk + 1) * length);
    for (std::size_t t = chunk * length; t < last; ++t)
      body (t);
  };
  // Of each chunk: number of entries of each range, then index of the next one.
  std::vector<std::vector<std::size_t>> places (chunks, std::vector<std::size_t> (ranges, 0));
  std::vector<std::size_t> left_out (chunks, 0);
  parallelTasks (run, chunks, [&] (std::size_t chunk) {
    forChunk (chunk, [&] (std::size_t t) {
      if (isProper (triangles[t], points))
        forRangesOf (triangles[t], [&] (std::size_t r) { ++places[chunk][r]; });
      else
        ++left_out[chunk];
    });
  });
  left_out_ = std::accumulate (left_out.begin (), left_out.end (), std::size_t{0});
  std::size_t entries = 0;
  for (std::size_t r = 0; r < ranges; ++r) {
    begins_[r] = entries;
    for (std::vector<std::size_t>& place : places) {
      const std::size_t number = place[r];
      place[r] = entries;
      entries += number;
    }
  }
  begins_[ranges] = entries;
  ids_.resize (entries);
  parallelTasks (run, chunks, [&] (std::size_t chunk) {
    forChunk (chunk, [&] (std::size_t t) {
      if (left_out_ == 0 || isProper (triangles[t], points))
        forRangesOf (triangles[t],
                     [&] (std::size_t r) { ids_[places[chunk][r]++] = static_cast<Index> (t); });
    });
  });
}

VertexStars::VertexStars (const std::vector<Triangle>& triangles, const TriangleRanges& ranges,
                          std::size_t r)
    : first_ (ranges.firstPoint (r))
{
  const std::size_t points = ranges.lastPoint (r) - first_;
  const auto isHere = [&] (Index p) { return p - first_ < points; }; // also if p is below
  begins_.assign (points + 2, 0);
  ranges.forEach (r, [&] (Index t) {
    for (const Index p : triangles[t])
      if (isHere (p))
        ++begins_[p - first_ + 2];
  });
  std::partial_sum (begins_.begin (), begins_.end (), begins_.begin ());
  wedges_.resize (begins_.back ());
  // begins_[p + 1] is the index of the next entry of p; at the end, the end of p.
  ranges.forEach (r, [&] (Index t) {
    const auto [a, b, c] = triangles[t];
    if (isHere (a))
      wedges_[begins_[a - first_ + 1]++] = {t, b, c};
    if (isHere (b))
      wedges_[begins_[b - first_ + 1]++] = {t, c, a};
    if (isHere (c))
      wedges_[begins_[c - first_ + 1]++] = {t, a, b};
  });
  begins_.pop_back ();
}

// Whether no two edges lead to the same point.
bool
StarOrder::indexLeaving (const VertexStar& star)
{
  if (star.size () > MANY_IN_STAR) {
    leaving_ = {}; // not clear (): it visits all buckets of an earlier, larger table
    for (Index i = 0; i < star.size (); ++i)
      if (!leaving_.emplace (star[i].next, i).second)
        return false;
    return true;
  }
  for (std::size_t i = 1; i < star.size (); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (star[i].next == star[j].next)
        return false;
  return true;
}

// The wedge whose first edge leads to q, NONE if there is none.
Index
StarOrder::wedgeTo (Index q, const VertexStar& star) const
{
  if (star.size () > MANY_IN_STAR) {
    const auto found = leaving_.find (q);
    return found == leaving_.end () ? NONE : found->second;
  }
  for (Index i = 0; i < star.size (); ++i)
    if (star[i].next == q)
      return i;
  return NONE;
}

bool
StarOrder::set (const VertexStar& star)
{
  if (!indexLeaving (star))
    return false;
  // A wedge is followed anti-clockwise by the one that begins at its last edge.
  after_.assign (star.size (), NONE);
  before_.assign (star.size (), NONE);
  for (Index i = 0; i < star.size (); ++i) {
    const Index j = wedgeTo (star[i].previous, star);
    after_[i] = j;
    if (j != NONE)
      before_[j] = i;
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

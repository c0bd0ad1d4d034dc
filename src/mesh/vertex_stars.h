// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles around points, by ranges of points, for parallel loops.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "core/types.h"

namespace pcl::floater {
/// Triangles by their smallest points, which lie along a space-filling curve; stable. O(n).
/// \param points number of points; corners are below
inline std::vector<Index>
orderByPoints (const std::vector<Triangle>& triangles, std::size_t points)
{
  CsrLists lists = makeCsrLists (points, [&] (const auto& emit) {
    for (Index t = 0; t < triangles.size (); ++t)
      emit (*std::min_element (triangles[t].begin (), triangles[t].end ()), t);
  });
  return std::move (lists.ids);
}

/// Whether the corners are three points below `points`.
inline bool
isProper (const Triangle& t, std::size_t points)
{
  return t[0] < points && t[1] < points && t[2] < points && t[0] != t[1] && t[1] != t[2] &&
         t[2] != t[0];
}

/// The triangles with a corner in each range of points. If they are in the order of their points,
/// nearly all are in one range only: 4 bytes per triangle, at most 12.
class TriangleRanges
{
public:
  /// Points of a range. Measured: ranges two or four times as long are no faster. The data of a
  /// range fits into a second-level cache, and few edges leave it.
  static constexpr std::size_t LENGTH = 8192;

  /// Leaves out triangles that are not proper. O(triangles).
  TriangleRanges (const std::vector<Triangle>& triangles, std::size_t points,
                  const RunContext& run);

  std::size_t count () const { return lists_.rows (); }
  std::size_t firstPoint (std::size_t r) const { return r * LENGTH; }
  std::size_t lastPoint (std::size_t r) const { return std::min (points_, (r + 1) * LENGTH); }

  /// Number of triangles that are in no range.
  std::size_t leftOut () const { return left_out_; }

  /// The triangles of a range, ascending.
  Row of (std::size_t r) const { return lists_.row (r); }

private:
  std::size_t points_, left_out_ = 0;
  CsrLists lists_;
};

/// A triangle as seen from one of its corners.
struct Wedge
{
  Index triangle;
  Index next, previous; ///< its other corners, anti-clockwise
};

/// The triangles around one point, ascending.
using VertexStar = Span<Wedge>;

/// The stars of the points of one range. 12 bytes per corner in the range.
class VertexStars
{
public:
  /// \param r the range; the triangles are those of the ranges
  VertexStars (const std::vector<Triangle>& triangles, const TriangleRanges& ranges, std::size_t r);

  /// \param p a point of the range
  VertexStar of (std::size_t p) const
  {
    return {wedges_.data () + begins_[p - first_], wedges_.data () + begins_[p - first_ + 1]};
  }

private:
  std::size_t first_; // point of the range
  std::vector<std::size_t> begins_;
  std::vector<Wedge> wedges_;
};

/// How the triangles of a star follow each other around its point.
class StarOrder
{
public:
  /// \return false if an edge leaves the point twice
  bool set (const VertexStar& star);

  /// The wedges before and after wedge i, NONE at a boundary.
  Index before (std::size_t i) const { return before_[i]; }
  Index after (std::size_t i) const { return after_[i]; }

  /// Whether all triangles, if there are any, are one fan.
  bool isOneFan () const;

private:
  std::vector<Index> after_, before_;            // of each wedge: neighbours in the fan, or NONE
  std::vector<std::pair<Index, Index>> leaving_; // ends of the first edges, ascending; wedges
};

} // namespace pcl::floater

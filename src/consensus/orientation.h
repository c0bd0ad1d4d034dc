// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A common orientation of normals, found by the triangles that connect their points.
#pragma once

#include "consensus/candidates.h"
#include "core/disjoint_sets.h"
#include "core/run_context.h"

#include <vector>

namespace pcl::floater {
/// Sets of points whose normals are oriented relative to each other. A triangle joins the sets of
/// its corners: it shows which of their normals point to the same side. Amortized almost O(1) for
/// each call, unless it says otherwise.
class Orientation
{
public:
  /// \param points number of points; each is a set of its own
  explicit Orientation (std::size_t points) : sides_ (points) {}

  /// Joins the sets of the corners of a triangle if it does not contradict the orientation.
  /// \param clockwise as in Candidate
  /// \return false if it does
  bool join (const Triangle& corners, std::uint8_t clockwise);

  /// Joins the sets of two points whose normals point to the same side.
  void joinSameSide (Index p, Index q) { sides_.join (p, q, false); }

  /// Joins the sets of points that candidates connect and that have no common orientation yet. All
  /// candidates between two sets vote together, since a single triangle across a sharp edge or
  /// between sheets may be wrong. Runs in rounds like those of Boruvka's spanning forest: every set
  /// is joined to the one to which the most votes tie it, until no candidate connects two sets.
  /// O(m log m) for m candidates in each round; O(log m) rounds.
  void vote (const Candidate* const* first, const Candidate* const* last, const RunContext& run);

  /// The corners, anti-clockwise seen from the front of the set that they belong to.
  Triangle turned (Triangle corners, std::uint8_t clockwise);

  /// Turns normals so that those of one set agree.
  void turn (std::vector<Eigen::Vector3f>& normals, const RunContext& run);

private:
  SignedSets sides_;
};

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Consistent orientation of normals.
#pragma once

#include "consensus/candidates.h"
#include "core/disjoint_sets.h"
#include "core/run_context.h"
#include "core/types.h"

#include <vector>

namespace pcl::floater {
/// Sets of points whose normals are oriented relative to each other. A triangle joins the sets of
/// its corners, by its orientation relative to each normal. Amortized almost O(1) for each call
/// unless stated.
class Orientation
{
public:
  /// \param points number of points; each is a set of its own
  explicit Orientation (std::size_t points) : sides_ (points) {}

  /// Joins the sets of the corners of a triangle unless it contradicts their orientation.
  /// \param clockwise as in Candidate
  /// \return false if it does
  bool join (const Triangle& corners, std::uint8_t clockwise);

  /// Joins sets that are connected by candidates and have no common orientation yet. All candidates
  /// between two sets vote together, since a single triangle across a sharp edge or between sheets
  /// may be wrong. Rounds as in Boruvka's algorithm: every set is joined to the one with the most
  /// votes, until no candidate connects two sets. O(m log m) for m candidates in each of O(log m)
  /// rounds.
  void vote (const Candidate* const* first, const Candidate* const* last, const RunContext& run);

  /// The corners, anti-clockwise seen from the front of their set.
  Triangle turned (Triangle corners, std::uint8_t clockwise);

  /// Orients the normals of each set consistently.
  void turn (std::vector<Eigen::Vector3f>& normals, const RunContext& run);

private:
  // The place of a corner; `flipped`: the triangle is clockwise seen from the front of its set.
  SignedSets::Place placeOf (const Triangle& corners, std::uint8_t clockwise, std::size_t corner);

  SignedSets sides_;
};

/// Finds where a one-sided surface was cut open: the longest row of contradicting triangles that
/// are connected by edges. An orientation that spreads round such a surface contradicts itself
/// along a whole row across it; a wrong triangle between two sheets stands alone, and where thin
/// sheets are glued, there are many short rows. Fails for strips less than about 4 spacings wide:
/// their rows are too short. O(m log m) for m triangles.
/// \param contradicting see ConsensusMesh::seam
/// \param shortest_seam triangles; see ConsensusLimits
/// \return the triangles of the row, in the order of `contradicting`; empty if it is too short
std::vector<Triangle>
findOrientationSeam (const std::vector<Triangle>& contradicting, std::size_t shortest_seam);

} // namespace pcl::floater

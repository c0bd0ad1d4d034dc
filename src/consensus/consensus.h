// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Candidate triangles from the stars, the consistent orientation of normals, and the triangles that
// stars agree on, as one oriented surface.
#pragma once

#include "core/disjoint_sets.h"
#include "local/stars.h"
#include "mesh/triangle_mesh.h"

namespace pcl::floater {
/// A triangle in the stars of one, two or all three of its corners.
struct Candidate
{
  Triangle corners;                ///< the first is the smallest one whose star has the triangle;
                                   ///< anti-clockwise seen from the normal of that corner
  std::uint8_t votes;              ///< corners whose stars have it, 1 to 3
  std::uint8_t clockwise = 0;      ///< bit i: clockwise seen from the normal of corner i
  bool is_taken = false;           ///< into the consensus
  float circumradius_ratio = 0.0F; ///< circumradius over the mean spacing of its corners
  float normal_agreement = 1.0F;   ///< least |cosine| between its normal and those of its corners
};

/// The triangles of all stars that are neither too large nor too steep, each once, ordered by their
/// first corner and around it. O(entries of the stars).
/// \param normals for the normal agreement: those of the stars, or others on the same side
/// \param spacing of each point (see localSpacing)
std::vector<Candidate>
findCandidates (const Positions& positions, const Stars& stars, const Normals& normals,
                const std::vector<float>& spacing, const RunContext& run);

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
  /// \param voters of the candidates
  void vote (const std::vector<Candidate>& candidates, const Row& voters, const RunContext& run);

  /// The corners, anti-clockwise seen from the front of their set.
  Triangle turned (Triangle corners, std::uint8_t clockwise);

  /// Orients the normals of each set consistently.
  void turn (Normals& normals, const RunContext& run);

private:
  // The place of a corner; `flipped`: the triangle is clockwise seen from the front of its set.
  SignedSets::Place placeOf (const Triangle& corners, std::uint8_t clockwise, std::size_t corner);

  SignedSets sides_;
};

/// Consistently oriented triangles. Their sectors around each point do not overlap in its tangent
/// plane, so every edge has one or two. A point may still have several fans (see manifoldPart).
struct Consensus
{
  std::vector<Triangle> triangles; ///< ordered by their first corners, so that neighbours are close
                                   ///< in memory
  std::vector<std::uint8_t> votes; ///< of each triangle, 1 to 3
  std::vector<Triangle> seam;      ///< triangles of three votes that contradict the orientation: a
                                   ///< row of them on a one-sided surface
};

/// Accepts candidates greedily, by votes (three first), then by normal agreement. A candidate is
/// accepted if its sectors overlap no other one at its corners, and if it does not contradict the
/// orientation of the triangles connected to it (see Orientation). O(n) for sure candidates, O(m
/// log m) for m doubtful ones.
/// \param candidates see findCandidates
/// \param normals    in: unit normals by which the candidates were found; out: oriented like the
///     triangles
Consensus
buildConsensus (const Positions& positions, std::vector<Candidate> candidates, Normals& normals,
                const RunContext& run);

/// Keeps the fan of most votes around every point, and removes islands. An island is an open
/// component with points of a larger component among its nearest neighbours, if it is small, or if
/// most of its points are on its boundary and that component's points are near its planes: it is
/// in a hole of that one. The result is an oriented manifold whose boundary loops pass each point at
/// most once. O(n).
/// \param normals         of the points
/// \param neighbors       of each point
/// \param smallest_island number of triangles of which it is not small
/// \throws std::logic_error if the result is no manifold, which would be a bug
TriangleMesh
manifoldPart (Consensus consensus, const Positions& positions, const Normals& normals,
              const CsrLists& neighbors, std::size_t smallest_island, const RunContext& run);

} // namespace pcl::floater

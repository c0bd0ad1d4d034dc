// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "consensus/consensus.h"

#include <cstdlib>
#include <map>
#include <unordered_set>

namespace pcl::floater {
SignedSets::Place
Orientation::placeOf (const Triangle& corners, std::uint8_t clockwise, std::size_t corner)
{
  SignedSets::Place place = sides_.find (corners[corner]);
  place.flipped = place.flipped != (((clockwise >> corner) & 1U) != 0);
  return place;
}

bool
Orientation::join (const Triangle& corners, std::uint8_t clockwise)
{
  using Place = SignedSets::Place;
  const Place a = placeOf (corners, clockwise, 0), b = placeOf (corners, clockwise, 1),
              c = placeOf (corners, clockwise, 2);
  const auto contradict = [] (const Place& p, const Place& q) {
    return p.root == q.root && p.flipped != q.flipped;
  };
  if (contradict (a, b) || contradict (a, c) || contradict (b, c))
    return false;
  if (a.root != b.root)
    sides_.join (a.root, b.root, a.flipped != b.flipped);
  if (a.root != c.root)
    sides_.join (a.root, c.root, a.flipped != c.flipped);
  return true;
}

void
Orientation::vote (const std::vector<Candidate>& candidates, const Row& voters,
                   const RunContext& run)
{
  ProgressLoop progress (run);
  while (true) {
    // Of two sets, by their representatives: positive for the same side, negative for opposite ones.
    std::map<std::pair<Index, Index>, int> sums;
    for (const Index voter : voters) {
      progress.next ();
      const Candidate& c = candidates[voter];
      for (std::size_t i = 0; i < 3; ++i) {
        const SignedSets::Place a = placeOf (c.corners, c.clockwise, i),
                                b = placeOf (c.corners, c.clockwise, (i + 1U) % 3U);
        if (a.root != b.root)
          sums[std::minmax (a.root, b.root)] += a.flipped != b.flipped ? -c.votes : c.votes;
      }
    }
    if (sums.empty ())
      return;
    std::vector<std::pair<std::pair<Index, Index>, int>> votes (sums.begin (), sums.end ());
    std::stable_sort (votes.begin (), votes.end (), [] (const auto& one, const auto& other) {
      return std::abs (one.second) > std::abs (other.second);
    });
    std::unordered_set<Index> joined;
    for (const auto& [sets, weight] : votes) {
      progress.next ();
      const bool is_first_of_a = joined.insert (sets.first).second;
      const bool is_first_of_b = joined.insert (sets.second).second;
      if (is_first_of_a || is_first_of_b)
        sides_.join (sets.first, sets.second, weight < 0);
    }
  }
}

Triangle
Orientation::turned (Triangle corners, std::uint8_t clockwise)
{
  if (placeOf (corners, clockwise, 0).flipped)
    std::swap (corners[1], corners[2]);
  return corners;
}

void
Orientation::turn (Normals& normals, const RunContext& run)
{
  ProgressLoop progress (run);
  for (Index p = 0; p < normals.size (); ++p) {
    progress.next ();
    if (sides_.find (p).flipped)
      normals[p] = -normals[p];
  }
}

std::vector<Triangle>
findOrientationSeam (const std::vector<Triangle>& contradicting)
{
  // Scans of two-sided surfaces had rows of up to 5, Moebius strips 4 spacings wide rows of 8, and
  // strips 12 spacings wide rows of 37.
  constexpr std::size_t SHORTEST_SEAM = 8;
  DisjointSets rows (contradicting.size ());
  std::map<std::pair<Index, Index>, Index> triangle_at; // each edge
  for (Index t = 0; t < contradicting.size (); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto edge = std::minmax (contradicting[t][i], contradicting[t][(i + 1) % 3]);
      if (const auto [other, is_new] = triangle_at.emplace (edge, t); !is_new)
        rows.join (t, other->second);
    }
  std::vector<std::size_t> length (contradicting.size (), 0);
  for (Index t = 0; t < contradicting.size (); ++t)
    ++length[rows.find (t)];
  const auto longest = std::max_element (length.begin (), length.end ());
  std::vector<Triangle> row;
  // Of that length. Moebius strips, noisy or at random, have up to 4.1, glued leaves 6.4.
  constexpr std::size_t MOST_ROWS = 5;
  if (longest == length.end () || *longest < SHORTEST_SEAM ||
      MOST_ROWS * *longest < contradicting.size ())
    return row;
  const auto root = static_cast<Index> (longest - length.begin ());
  for (Index t = 0; t < contradicting.size (); ++t)
    if (rows.find (t) == root)
      row.push_back (contradicting[t]);
  return row;
}

} // namespace pcl::floater

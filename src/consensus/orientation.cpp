// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "consensus/orientation.h"

#include "core/disjoint_sets.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <unordered_set>
#include <utility>

namespace pcl::floater {
namespace {
bool
runsClockwise (std::uint8_t clockwise, std::size_t corner)
{
  return ((clockwise >> corner) & 1U) != 0;
}

} // namespace

bool
Orientation::join (const Triangle& corners, std::uint8_t clockwise)
{
  const bool a = runsClockwise (clockwise, 0), b = runsClockwise (clockwise, 1),
             c = runsClockwise (clockwise, 2);
  const SignedSets::Place at_a = sides_.find (corners[0]), at_b = sides_.find (corners[1]),
                          at_c = sides_.find (corners[2]);
  const auto contradicts = [] (const SignedSets::Place& p, const SignedSets::Place& q,
                               bool opposite) {
    return p.root == q.root && (p.flipped != q.flipped) != opposite;
  };
  if (contradicts (at_a, at_b, a != b) || contradicts (at_a, at_c, a != c) ||
      contradicts (at_b, at_c, b != c))
    return false;
  if (at_a.root != at_b.root)
    sides_.join (corners[0], corners[1], a != b);
  if (at_a.root != at_c.root)
    sides_.join (corners[0], corners[2], a != c);
  return true;
}

void
Orientation::vote (const Candidate* const* first, const Candidate* const* last,
                   const RunContext& run)
{
  ProgressLoop progress (run);
  while (true) {
    // Of two sets, by their representatives: positive for the same side, negative for opposite ones.
    std::map<std::pair<Index, Index>, int> sums;
    for (const Candidate* const* candidate = first; candidate != last; ++candidate) {
      progress.next ();
      const Candidate& c = **candidate;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1U) % 3U;
        const SignedSets::Place a = sides_.find (c.corners[i]), b = sides_.find (c.corners[j]);
        const bool opposite = (runsClockwise (c.clockwise, i) != runsClockwise (c.clockwise, j)) !=
                              (a.flipped != b.flipped);
        if (a.root != b.root)
          sums[std::minmax (a.root, b.root)] += opposite ? -c.votes : c.votes;
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
  if (runsClockwise (clockwise, 0) != sides_.find (corners[0]).flipped)
    std::swap (corners[1], corners[2]);
  return corners;
}

void
Orientation::turn (std::vector<Eigen::Vector3f>& normals, const RunContext& run)
{
  ProgressLoop progress (run);
  for (Index p = 0; p < normals.size (); ++p) {
    progress.next ();
    if (sides_.find (p).flipped)
      normals[p] = -normals[p];
  }
}

std::vector<Triangle>
findOrientationSeam (const std::vector<Triangle>& contradicting, std::size_t shortest_seam)
{
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
  if (longest == length.end () || *longest < shortest_seam ||
      MOST_ROWS * *longest < contradicting.size ())
    return row;
  const auto root = static_cast<Index> (longest - length.begin ());
  for (Index t = 0; t < contradicting.size (); ++t)
    if (rows.find (t) == root)
      row.push_back (contradicting[t]);
  return row;
}

} // namespace pcl::floater

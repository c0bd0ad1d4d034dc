// SPDX-License-Identifier: GPL-3.0-or-later
// Union-find over elements with signs.
#pragma once

#include "common/types.h"

#include <numeric>
#include <utility>
#include <vector>

namespace pcl
{
namespace floater
{
/// Disjoint sets in which every element has a sign relative to its set's representative.
class SignedSets
{
public:
  explicit SignedSets (std::size_t size) : parent_ (size), flipped_ (size, 0), rank_ (size, 0)
  {
    std::iota (parent_.begin (), parent_.end (), Index{0});
  }

  struct Place
  {
    Index root;
    bool flipped; ///< sign differs from the representative's
  };

  Place find (Index element)
  {
    Index root = element;
    bool flipped = false;
    while (parent_[root] != root) {
      flipped = flipped != (flipped_[root] != 0);
      root = parent_[root];
    }
    // Path compression: everything on the way hangs on the root.
    bool sign = flipped;
    for (Index at = element; at != root;) {
      const Index up = parent_[at];
      const bool next = sign != (flipped_[at] != 0);
      parent_[at] = root;
      flipped_[at] = sign ? 1 : 0;
      sign = next;
      at = up;
    }
    return {root, flipped};
  }

  /// Joins the sets of a and b so that their signs are equal, or opposite.
  /// \return false if they are in one set already and their signs contradict
  bool join (Index a, Index b, bool opposite)
  {
    Place at_a = find (a), at_b = find (b);
    const bool flip = (at_a.flipped != at_b.flipped) != opposite;
    if (at_a.root == at_b.root)
      return !flip;
    if (rank_[at_a.root] < rank_[at_b.root])
      std::swap (at_a, at_b);
    if (rank_[at_a.root] == rank_[at_b.root])
      ++rank_[at_a.root];
    parent_[at_b.root] = at_a.root;
    flipped_[at_b.root] = flip ? 1 : 0;
    return true;
  }

private:
  std::vector<Index> parent_;
  std::vector<std::uint8_t> flipped_; // relative to the parent
  std::vector<std::uint8_t> rank_;
};

} // namespace floater
} // namespace pcl

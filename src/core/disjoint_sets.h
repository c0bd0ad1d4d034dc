// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Disjoint sets (union-find), and disjoint sets of elements with signs.
#pragma once

#include "core/types.h"

namespace pcl::floater {
/// Disjoint sets of the elements 0 to size - 1. The smallest element of a set represents it,
/// whatever the order of joins. Amortized O(log size) for each call.
///
/// Threads may use it concurrently if each one joins elements of a range of its own that share no
/// set with elements outside.
class DisjointSets
{
public:
  explicit DisjointSets (std::size_t size) : parent_ (indicesBelow (size)) {}

  /// The representative of an element's set.
  Index find (Index element)
  {
    while (parent_[element] != element)
      element = parent_[element] = parent_[parent_[element]];
    return element;
  }

  /// Joins the sets of two elements.
  /// \return false if they already were in one set
  bool join (Index a, Index b)
  {
    a = find (a);
    b = find (b);
    parent_[std::max (a, b)] = std::min (a, b);
    return a != b;
  }

  /// The number of each element's set, from 0 in the order of their smallest elements; NONE for
  /// sets that are left out. Consumes the sets. O(size).
  /// \param is_numbered called with the smallest element of each set, ascending; false leaves the
  ///     set out
  template <typename IsNumbered>
  std::vector<Index> number (IsNumbered&& is_numbered) &&
  {
    Index sets = 0;
    // Parents are smaller than their children, so they are numbered first.
    for (Index element = 0; element < parent_.size (); ++element)
      if (parent_[element] != element)
        parent_[element] = parent_[parent_[element]];
      else
        parent_[element] = is_numbered (element) ? sets++ : NONE;
    return std::move (parent_);
  }

private:
  std::vector<Index> parent_;
};

/// Disjoint sets in which every element has a sign relative to its set's representative (union-find
/// with parity). Amortized almost O(1) for each call.
class SignedSets
{
public:
  explicit SignedSets (std::size_t size)
      : parent_ (indicesBelow (size)), flipped_ (size, 0), rank_ (size, 0)
  {
  }

  struct Place
  {
    Index root;
    bool flipped; ///< the sign differs from that of the representative

    bool operator== (const Place& p) const { return root == p.root && flipped == p.flipped; }
  };

  Place find (Index element)
  {
    bool flipped = false;
    for (; parent_[element] != element; element = parent_[element]) {
      // Halves the path; the representative itself is not flipped.
      flipped_[element] ^= flipped_[parent_[element]];
      parent_[element] = parent_[parent_[element]];
      flipped = flipped != (flipped_[element] != 0);
    }
    return {element, flipped};
  }

  /// Joins the sets of a and b so that their signs are equal, or opposite.
  /// \return false if they already were in one set with contradicting signs
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
  Flags flipped_; // relative to the parent
  Flags rank_;
};

} // namespace pcl::floater

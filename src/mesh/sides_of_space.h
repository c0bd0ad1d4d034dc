// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Which tetrahedra are on one side of a surface.
#pragma once

#include "core/tetrahedra.h"

#include <numeric>
#include <utility>
#include <vector>

namespace pcl::floater {
/// Sets of tetrahedra on the same or on opposite sides: disjoint sets with parity, whose last step
/// can be undone. O(log n) for a step, plus the free points of the smaller set.
class SidesOfSpace
{
public:
  struct Side
  {
    Index root;
    bool is_other; // opposite to the root

    bool operator== (const Side& s) const { return root == s.root && is_other == s.is_other; }
    bool operator!= (const Side& s) const { return !(*this == s); }
  };

  SidesOfSpace (const Tetrahedra& tetrahedra, const std::vector<std::uint8_t>& is_free)
      : tetrahedra_ (tetrahedra), parent_ (tetrahedra.size ()), is_other_ (tetrahedra.size (), 0),
        free_points_ (tetrahedra.size ())
  {
    std::iota (parent_.begin (), parent_.end (), Index{0});
    for (Index t = 0; t < tetrahedra.size (); ++t)
      for (const Index p : tetrahedra.corners[t])
        if (p != NONE && is_free[p] != 0)
          free_points_[t].push_back (p);
  }

  Side of (Index t) const
  {
    bool is_other = false;
    for (; parent_[t] != t; t = parent_[t])
      is_other = is_other != (is_other_[t] != 0);
    return {t, is_other};
  }

  /// Puts two tetrahedra on the same side or on opposite ones.
  /// \return false if a free point would have one side only, or two tetrahedra contradicting sides;
  ///     nothing has changed then
  bool put (Index a, Index b, bool opposite)
  {
    steps_.clear ();
    to_check_.clear ();
    bool is_possible = link (a, b, opposite);
    for (std::size_t i = 0; is_possible && i < to_check_.size (); ++i)
      is_possible = hasTwoSides (to_check_[i]);
    for (; !is_possible && !steps_.empty (); steps_.pop_back ()) {
      const Step& step = steps_.back ();
      parent_[step.small] = step.small;
      is_other_[step.small] = 0;
      free_points_[step.large].resize (step.points_before);
    }
    return is_possible;
  }

private:
  struct Step
  {
    Index small, large; // set that was joined to another one
    std::size_t points_before;
  };

  bool link (Index a, Index b, bool opposite)
  {
    const Side of_a = of (a), of_b = of (b);
    const bool flips = (of_a.is_other != of_b.is_other) != opposite;
    if (of_a.root == of_b.root)
      return !flips;
    Index small = of_a.root, large = of_b.root;
    if (free_points_[small].size () > free_points_[large].size ())
      std::swap (small, large);
    std::vector<Index>& points = free_points_[large];
    steps_.push_back ({small, large, points.size ()});
    parent_[small] = large;
    is_other_[small] = flips ? 1 : 0;
    to_check_.insert (to_check_.end (), free_points_[small].begin (), free_points_[small].end ());
    points.insert (points.end (), free_points_[small].begin (), free_points_[small].end ());
    return true;
  }

  // False if all tetrahedra around a point are on one side. If there are two sets left, they are
  // opposite.
  bool hasTwoSides (Index p)
  {
    const Row around = tetrahedra_.around.row (p);
    const Side first = of (around[0]);
    Side second = first;
    for (const Index t : around) {
      const Side side = of (t);
      if (side == first || side == second)
        continue;
      if (second != first)
        return true;
      second = side;
    }
    if (second == first)
      return false;
    return first.root == second.root ||
           link (first.root, second.root, first.is_other == second.is_other);
  }

  const Tetrahedra& tetrahedra_;
  std::vector<Index> parent_;
  std::vector<std::uint8_t> is_other_;          // opposite to the parent
  std::vector<std::vector<Index>> free_points_; // of each set, possibly repeated
  std::vector<Step> steps_;
  std::vector<Index> to_check_;
};

} // namespace pcl::floater

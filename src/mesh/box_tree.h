// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Bounding volume hierarchy: finds overlapping boxes.
#pragma once

#include "core/parallel.h"

namespace pcl::floater {
/// Boxes in leaves of LEAF_SIZE, in nodes of FAN nodes each. Consecutive boxes should be near in
/// space. 28 bytes per box. Boxes are rounded outwards to single precision, so a few more may seem
/// to overlap. Const functions are thread-safe.
class BoxTree
{
public:
  static constexpr std::size_t LEAF_SIZE = 8, LOG_FAN = 2, FAN = std::size_t{1} << LOG_FAN;

  /// \param box_of (i): box of type Eigen::AlignedBox3d
  template <typename BoxOf>
  BoxTree (std::size_t count, BoxOf&& box_of, const RunContext& run)
      : boxes_ (count), levels_{std::vector<Box> ((count + LEAF_SIZE - 1) / LEAF_SIZE)}
  {
    parallelPoints (run, leaves (), [&] (std::size_t leaf) {
      for (std::size_t i = leaf * LEAF_SIZE; i < endOf (leaf); ++i) {
        boxes_[i] = roundOutwards (box_of (i));
        levels_.front ()[leaf].extend (boxes_[i]);
      }
    });
    while (levels_.back ().size () > FAN) {
      const std::vector<Box>& below = levels_.back ();
      std::vector<Box> around ((below.size () + FAN - 1) / FAN);
      for (std::size_t i = 0; i < below.size (); ++i)
        around[i / FAN].extend (below[i]);
      levels_.push_back (std::move (around));
    }
  }

  std::size_t leaves () const { return levels_.front ().size (); }

  /// Calls visit (i, j) for all boxes i of some consecutive leaves and j that overlap or touch, i < j.
  /// All leaves together give each pair once.
  template <typename Visit>
  void forOverlaps (std::size_t first, std::size_t last, Visit&& visit) const
  {
    Box around;
    for (std::size_t leaf = first; leaf < last; ++leaf)
      around.extend (levels_.front ()[leaf]);
    std::vector<std::size_t> near;
    const auto add = [&near] (std::size_t other) {
      near.push_back (other);
      return false;
    };
    forNodes ([&around] (const Box& node) { return overlap (around, node); }, add, first);
    for (std::size_t leaf = first; leaf < last; ++leaf)
      for (const std::size_t other : near)
        if (other >= leaf && overlap (levels_.front ()[leaf], levels_.front ()[other]))
          compare (leaf, other, visit);
  }

  /// Calls visit (j) for all boxes j that overlap or touch a given box, ascending, until it returns
  /// true.
  /// \return whether it has
  template <typename Visit>
  bool forOverlaps (const Eigen::AlignedBox3d& exact, Visit&& visit) const
  {
    const Box box = roundOutwards (exact);
    return forMet ([&box] (const Box& other) { return overlap (box, other); }, visit);
  }

  /// Calls visit (j) for all boxes j that a ray meets, unsorted, until it returns true. O(log n)
  /// for boxes that hardly overlap.
  /// \param direction not zero, any length
  /// \return whether it has
  template <typename Visit>
  bool forAlongRay (const Vector3d& origin, const Vector3d& direction, Visit&& visit) const
  {
    const Ray ray (origin, direction);
    return forMet ([&ray] (const Box& box) { return ray.meets (box); }, visit);
  }

  /// Replaces box i. Nodes around it only grow: many distant changes make searches slower.
  void set (std::size_t i, const Eigen::AlignedBox3d& exact)
  {
    const Box box = boxes_[i] = roundOutwards (exact);
    std::size_t node = i / LEAF_SIZE;
    for (std::vector<Box>& level : levels_) {
      level[node].extend (box);
      node /= FAN;
    }
  }

private:
  using Box = Eigen::AlignedBox3f;

  // Without branches: which comparison decides is unpredictable.
  static bool overlap (const Box& a, const Box& b)
  {
    const Vector3f &low_a = a.min (), &low_b = b.min (), &high_a = a.max (), &high_b = b.max ();
    return (static_cast<int> (low_a[0] <= high_b[0]) & static_cast<int> (low_b[0] <= high_a[0]) &
            static_cast<int> (low_a[1] <= high_b[1]) & static_cast<int> (low_b[1] <= high_a[1]) &
            static_cast<int> (low_a[2] <= high_b[2]) & static_cast<int> (low_b[2] <= high_a[2])) !=
           0;
  }

  // A ray, and which planes of a box it meets first.
  struct Ray
  {
    Ray (const Vector3d& from, const Vector3d& direction) : origin (from)
    {
      constexpr double NOT_ZERO = 1e-300; // avoids infinity times zero
      for (int axis = 0; axis < 3; ++axis) {
        const double d = direction[axis];
        inverse[axis] = 1.0 / (std::abs (d) < NOT_ZERO ? NOT_ZERO : d);
      }
    }

    bool meets (const Box& box) const
    {
      double begin = 0.0, end = std::numeric_limits<double>::infinity ();
      for (int axis = 0; axis < 3; ++axis) {
        const bool ascends = inverse[axis] > 0.0;
        const auto first = static_cast<double> ((ascends ? box.min () : box.max ())[axis]);
        const auto last = static_cast<double> ((ascends ? box.max () : box.min ())[axis]);
        begin = std::max (begin, (first - origin[axis]) * inverse[axis]);
        end = std::min (end, (last - origin[axis]) * inverse[axis]);
      }
      return begin <= end;
    }

    Vector3d origin, inverse;
  };

  // Calls visit (i, j) for all boxes i of a leaf and j of another one, or of the same, i < j.
  template <typename Visit>
  void compare (std::size_t leaf, std::size_t other, Visit&& visit) const
  {
    for (std::size_t i = leaf * LEAF_SIZE; i < endOf (leaf); ++i)
      if (overlap (boxes_[i], levels_.front ()[other]))
        for (std::size_t k = other == leaf ? i + 1 : other * LEAF_SIZE; k < endOf (other); ++k)
          if (overlap (boxes_[i], boxes_[k]))
            visit (i, k);
  }

  // Calls visit for the boxes that satisfy is_met, until it returns true.
  template <typename IsMet, typename Visit>
  bool forMet (const IsMet& is_met, Visit&& visit) const
  {
    return forNodes (is_met, [&] (std::size_t leaf) {
      for (std::size_t i = leaf * LEAF_SIZE; i < endOf (leaf); ++i)
        if (is_met (boxes_[i]) && visit (i))
          return true;
      return false;
    });
  }

  // Calls visit for the leaves from `first` on whose nodes all satisfy is_met, ascending, until it
  // returns true.
  template <typename IsMet, typename Visit>
  bool forNodes (IsMet&& is_met, Visit&& visit, std::size_t first = 0) const
  {
    struct Node
    {
      std::size_t level, index;
    };
    constexpr std::size_t DEPTH = 32; // exceeds the levels of any tree in memory
    std::array<Node, DEPTH * FAN> stack;
    std::size_t left = 0;
    for (std::size_t i = levels_.back ().size (); i-- > 0;)
      stack[left++] = {levels_.size () - 1, i};
    while (left > 0) {
      const Node node = stack[--left];
      // All its leaves are before the first one, or it is not met.
      if (((node.index + 1) << (LOG_FAN * node.level)) <= first ||
          !is_met (levels_[node.level][node.index]))
        continue;
      if (node.level == 0) {
        if (visit (node.index))
          return true;
        continue;
      }
      const std::size_t begin = node.index * FAN;
      for (std::size_t i = std::min (levels_[node.level - 1].size (), begin + FAN); i-- > begin;)
        stack[left++] = {node.level - 1, i};
    }
    return false;
  }

  // One past the last box of a leaf.
  std::size_t endOf (std::size_t leaf) const
  {
    return std::min (boxes_.size (), (leaf + 1) * LEAF_SIZE);
  }

  static Box roundOutwards (const Eigen::AlignedBox3d& exact)
  {
    constexpr float FAR = std::numeric_limits<float>::infinity ();
    Box box = exact.cast<float> ();
    for (int axis = 0; axis < 3; ++axis) {
      float &low = box.min ()[axis], &high = box.max ()[axis];
      if (static_cast<double> (low) > exact.min ()[axis])
        low = std::nextafter (low, -FAR);
      if (static_cast<double> (high) < exact.max ()[axis])
        high = std::nextafter (high, FAR);
    }
    return box;
  }

  std::vector<Box> boxes_;
  std::vector<std::vector<Box>> levels_; // boxes of the leaves, then of the nodes above
};

} // namespace pcl::floater

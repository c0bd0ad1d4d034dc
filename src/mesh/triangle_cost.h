// SPDX-License-Identifier: GPL-3.0-or-later
// What triangles and the edges between them cost: what flips and moves of vertices minimize.
#pragma once

#include "core/types.h"

#include <algorithm>
#include <vector>

namespace pcl
{
namespace floater
{
/// How bad a triangle is: the sum of the cotangents of its angles, which Delaunay flips minimize in
/// the plane, and penalties where it is turned away from the normals of its corners, or larger than
/// triangles between neighbours are: where sheets are near, that tells the wrong one.
class TriangleCost
{
public:
  /// \param normals oriented like the mesh (see orientNormals)
  /// \param spacing of each point (see localSpacing); nullptr: large triangles cost no more
  TriangleCost (const std::vector<Eigen::Vector3d>& positions,
                const std::vector<Eigen::Vector3f>& normals,
                const std::vector<float>* spacing = nullptr)
      : positions_ (positions), normals_ (normals), spacing_ (spacing)
  {
  }

  struct Value
  {
    Eigen::Vector3d unit_normal; ///< zero without area
    double cost;                 ///< 0 or more
  };

  /// Neither depends, not even by rounding, on the corner from which the triangle is named.
  Value value (Index a, Index b, Index c) const;

  double operator() (Index a, Index b, Index c) const { return value (a, b, c).cost; }
  double operator() (const Triangle& corners) const
  {
    return (*this) (corners[0], corners[1], corners[2]);
  }

  /// True if a triangle is penalized for its direction.
  bool isTurned (const Triangle& corners) const;

  /// Cost of an edge between two triangles: nothing up to a right angle, then it grows.
  static double ofFold (const Eigen::Vector3d& unit_normal,
                        const Eigen::Vector3d& other_unit_normal)
  {
    return FOLD_COST * std::max (0.0, -unit_normal.dot (other_unit_normal));
  }

private:
  // Cosine between the area vector and the sum of the corners' normals; 0 without area.
  double agreement (Index a, Index b, Index c, const Eigen::Vector3d& area_vector,
                    double double_area) const;

  static constexpr double FOLD_COST = 1000.0; // per unit of negative cosine

  const std::vector<Eigen::Vector3d>& positions_;
  const std::vector<Eigen::Vector3f>& normals_;
  const std::vector<float>* spacing_;
};

/// The same values, cached: local search asks for those of a few thousand triangles again and
/// again. A table of 400 kB, where a triangle takes the place of another that falls on it; what it
/// returns is what the cost would. For one thread.
class CachedCost
{
public:
  explicit CachedCost (const TriangleCost& cost)
      : cost_ (cost), entries_ (ENTRIES, Entry{{NONE, NONE, NONE}, {Eigen::Vector3d::Zero (), 0.0}})
  {
  }

  const TriangleCost& plain () const { return cost_; }

  /// Valid until the next call.
  const TriangleCost::Value& operator() (Index a, Index b, Index c)
  {
    // From the smallest corner.
    if (b < a && b < c)
      return find (b, c, a);
    if (c < a && c < b)
      return find (c, a, b);
    return find (a, b, c);
  }
  const TriangleCost::Value& operator() (const Triangle& corners)
  {
    return (*this) (corners[0], corners[1], corners[2]);
  }

private:
  struct Entry
  {
    Triangle corners;
    TriangleCost::Value value;
  };

  const TriangleCost::Value& find (Index a, Index b, Index c)
  {
    // Multiplicative hashing; the high bits are the best mixed.
    const std::uint64_t mixed =
        a * 0x9E3779B97F4A7C15ULL + b * 0xC2B2AE3D27D4EB4FULL + c * 0x165667B19E3779F9ULL;
    Entry& entry = entries_[mixed >> (64 - BITS)];
    if (entry.corners[0] != a || entry.corners[1] != b || entry.corners[2] != c) {
      entry.corners = {a, b, c};
      entry.value = cost_.value (a, b, c);
    }
    return entry.value;
  }

  static constexpr int BITS = 13;
  static constexpr std::size_t ENTRIES = std::size_t{1} << BITS;

  const TriangleCost& cost_;
  std::vector<Entry> entries_;
};

} // namespace floater
} // namespace pcl

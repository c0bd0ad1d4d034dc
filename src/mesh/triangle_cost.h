// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Cost of triangles and edges, which flips and moves of vertices minimize.
#pragma once

#include "core/run_context.h"
#include "core/types.h"
#include "mesh/triangle_mesh.h"

namespace pcl::floater {
/// The cost of a triangle: the sum of the cotangents of its angles, which Delaunay flips minimize
/// in the plane, less for needles, plus penalties if it is turned away from the normals of its
/// corners or is much larger than usual. Where sheets are close to each other, the penalties reveal
/// triangles that join the wrong points.
///
/// The unit of cost is that of cotangents: a right isosceles triangle costs 2, an equilateral one
/// 1.73. All penalties were chosen by hand, large compared with the cost of a good triangle; no
/// measurement is recorded.
class TriangleCost
{
public:
  /// Between a triangle's normal and the mean normal of its corners; below, it counts as turned.
  static constexpr double TURNED_COSINE = 0.2;
  /// Of an edge whose triangles are more than 90 degrees apart, per unit of negative cosine between
  /// their normals.
  static constexpr double FOLD_COST = 1000.0;
  /// In spacings of the corners; with a longer edge, a triangle is long.
  static constexpr double LONGEST_EDGE = 3.0;

  /// \param normals unit length, oriented like the mesh (see orientNormals)
  /// \param spacing of each point (see localSpacing); nullptr: large triangles have no penalty
  TriangleCost (const Positions& positions, const Normals& normals,
                const std::vector<float>* spacing = nullptr)
      : positions_ (positions), normals_ (normals), spacing_ (spacing)
  {
  }

  struct Value
  {
    Vector3d unit_normal; ///< zero if the triangle has no area
    double cost;          ///< 0 or more
  };

  /// Exactly the same for each choice of the first corner.
  Value operator() (Index a, Index b, Index c) const;

  /// True if a triangle is turned (see TURNED_COSINE).
  bool isTurned (const Triangle& corners) const;

  /// True if the corners of a triangle are on one line in single precision.
  bool isFlat (const Triangle& corners) const;

  /// True if a triangle is long (see LONGEST_EDGE); false without spacings.
  bool isLong (const Triangle& corners) const;

  /// Cost of an edge between two triangles: 0 up to an angle of 90 degrees between their normals,
  /// growing beyond; 0 if one of the normals is zero.
  static double ofEdge (const Vector3d& unit_normal, const Vector3d& other_unit_normal)
  {
    return FOLD_COST * std::max (0.0, -unit_normal.dot (other_unit_normal));
  }

private:
  // Cosine between the area vector and the sum of the corners' normals; 0 if there is no area.
  double agreement (Index a, Index b, Index c, const Vector3d& area_vector,
                    double double_area) const;

  const Positions& positions_;
  const Normals& normals_;
  const std::vector<float>* spacing_; // nullptr: there is none
};

/// TriangleCost with a cache. A local search needs the costs of a few thousand triangles again and
/// again. A hash table of 8192 entries (400 kB), where a triangle replaces another one with the
/// same hash. The results are bitwise equal. For one thread.
struct CachedCost
{
  struct Entry
  {
    Triangle corners = {NONE, NONE, NONE};
    TriangleCost::Value value = {Vector3d::Zero (), 0.0};
  };

  static constexpr int BITS = 13;

  const TriangleCost& plain;
  std::vector<Entry> entries = std::vector<Entry> (std::size_t{1} << BITS);

  /// Valid until the next call.
  const TriangleCost::Value& operator() (const Triangle& triangle)
  {
    const auto [a, b, c] = triangle;
    const Triangle corners = b < a && b < c   ? Triangle{b, c, a}
                             : c < a && c < b ? Triangle{c, a, b}
                                              : Triangle{a, b, c};
    // Multiplicative hashing; the high bits are the best mixed.
    const std::uint64_t mixed = corners[0] * 0x9E3779B97F4A7C15ULL +
                                corners[1] * 0xC2B2AE3D27D4EB4FULL +
                                corners[2] * 0x165667B19E3779F9ULL;
    Entry& entry = entries[mixed >> (64 - BITS)];
    if (entry.corners[0] != corners[0] || entry.corners[1] != corners[1] ||
        entry.corners[2] != corners[2]) // inline, unlike the comparison of arrays
      entry = {corners, plain (corners[0], corners[1], corners[2])};
    return entry.value;
  }
};

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/self_intersections.h"

#include "core/exact.h"
#include "core/geometry.h"
#include "core/parallel.h"
#include "mesh/box_tree.h"
#include "mesh/vertex_stars.h"

#include <algorithm>
#include <array>

namespace pcl::floater {
namespace {
using Positions = std::vector<Eigen::Vector3d>;

// Relative rounding bound. The error of a product of three coordinate differences is some 20 units
// in the last place of the product of their lengths; larger values have the right sign.
constexpr double ROUNDING = 1e-13;

// Corners of two triangles, common ones first.
struct Corners
{
  Triangle one, other;
  int common = 0;
};

Corners
commonFirst (Triangle one, Triangle other)
{
  int common = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (auto j = static_cast<std::size_t> (common); j < 3; ++j)
      if (one[i] == other[j]) {
        // Keeps the order of the common corners equal in both.
        std::swap (one[static_cast<std::size_t> (common)], one[i]);
        std::swap (other[static_cast<std::size_t> (common)], other[j]);
        ++common;
        break;
      }
  return {one, other, common};
}

// Whether a plane separates two triangles without a common corner, beyond rounding: a plane along
// one of the triangles, or through one of their edges and across it.
class SeparatingPlane
{
public:
  SeparatingPlane (const Triangle& one, const Triangle& other, const Positions& positions)
  {
    const Eigen::Vector3d& origin = positions[one[0]];
    double sqr_reach = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      one_[i] = positions[one[i]] - origin;
      other_[i] = positions[other[i]] - origin;
      sqr_reach = std::max ({sqr_reach, one_[i].squaredNorm (), other_[i].squaredNorm ()});
    }
    sqr_precision_ = ROUNDING * ROUNDING * sqr_reach;
  }

  bool exists () const
  {
    const Eigen::Vector3d normal = areaVector (one_[0], one_[1], one_[2]);
    const Eigen::Vector3d other_normal = areaVector (other_[0], other_[1], other_[2]);
    if (isAcross (normal) || isAcross (other_normal))
      return true;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = i == 2 ? 0 : i + 1;
      if (isAcross (normal.cross (one_[j] - one_[i])) ||
          isAcross (other_normal.cross (other_[j] - other_[i])))
        return true;
    }
    return false;
  }

private:
  // Whether a plane across this direction separates the triangles.
  bool isAcross (const Eigen::Vector3d& direction) const
  {
    const auto [low, high] = range (one_, direction);
    const auto [other_low, other_high] = range (other_, direction);
    const double gap = std::max (other_low - high, low - other_high);
    return gap > 0.0 && gap * gap > sqr_precision_ * direction.squaredNorm ();
  }

  static std::pair<double, double> range (const std::array<Eigen::Vector3d, 3>& corners,
                                          const Eigen::Vector3d& direction)
  {
    const double a = corners[0].dot (direction), b = corners[1].dot (direction),
                 c = corners[2].dot (direction);
    return {std::min ({a, b, c}), std::max ({a, b, c})};
  }

  std::array<Eigen::Vector3d, 3> one_, other_;
  double sqr_precision_;
};

// Two triangles with a common corner, which is the first of both.
class TrianglesAtCorner
{
public:
  TrianglesAtCorner (const Triangle& one, const Triangle& other, const Positions& positions)
  {
    for (std::size_t i = 0; i < 2; ++i) {
      one_[i] = positions[one[i + 1]] - positions[one[0]];
      other_[i] = positions[other[i + 1]] - positions[one[0]];
    }
  }

  // Whether they certainly share only the corner: the plane of one of them, or one through its
  // edges at the corner and across it, has the other one on one side.
  bool areSeparate () const { return isBeside (one_, other_) || isBeside (other_, one_); }

  // The same for triangles with a common edge, the first of both: the last corner of the other one is
  // off the plane of the first, or beyond the edge.
  bool shareOnlyEdge () const
  {
    const double a = one_[0].norm (), b = one_[1].norm ();
    const Eigen::Vector3d normal = one_[0].cross (one_[1]);
    return sideOf (normal, a * b, other_[1]) != 0 ||
           sideOf (normal.cross (one_[0]), a * a * b, other_[1]) < 0;
  }

private:
  using Edges = std::array<Eigen::Vector3d, 2>; // from the common corner

  static bool isBeside (const Edges& own, const Edges& other)
  {
    const double a = own[0].norm (), b = own[1].norm ();
    const Eigen::Vector3d normal = own[0].cross (own[1]);
    const int side = sideOf (normal, a * b, other[0]);
    if (side != 0 && side == sideOf (normal, a * b, other[1]))
      return true;
    const auto areOut = [&other] (const Eigen::Vector3d& inwards, double size) {
      return sideOf (inwards, size, other[0]) < 0 && sideOf (inwards, size, other[1]) < 0;
    };
    return areOut (normal.cross (own[0]), a * a * b) || areOut (own[1].cross (normal), a * b * b);
  }

  // Sign of a product of a direction and an edge; 0 if rounding might change it.
  // \param size product of the lengths of the edges that define the direction
  static int sideOf (const Eigen::Vector3d& direction, double size, const Eigen::Vector3d& edge)
  {
    const double product = direction.dot (edge);
    if (!(product * product > ROUNDING * ROUNDING * size * size * edge.squaredNorm ()))
      return 0;
    return product > 0.0 ? 1 : -1;
  }

  Edges one_, other_;
};

// Whether a triangle is degenerate. Uses exact numbers only where rounding might decide.
bool
isOnLine (const Triangle& triangle, const Positions& positions)
{
  const Eigen::Vector3d& p = positions[triangle[0]];
  const Eigen::Vector3d a = positions[triangle[1]] - p, b = positions[triangle[2]] - p;
  if (a.cross (b).squaredNorm () > ROUNDING * ROUNDING * a.squaredNorm () * b.squaredNorm ())
    return false;
  return areCollinear (p, positions[triangle[1]], positions[triangle[2]]);
}

} // namespace

bool
doCross (const Triangle& one, const Triangle& other, const Positions& positions,
         std::size_t* exact_tests)
{
  const Corners corners = commonFirst (one, other);
  if (corners.common == 0 && SeparatingPlane (one, other, positions).exists ())
    return false;
  const TrianglesAtCorner at_corner (corners.one, corners.other, positions);
  if ((corners.common == 1 && at_corner.areSeparate ()) ||
      (corners.common == 2 && at_corner.shareOnlyEdge ()))
    return false;
  if (exact_tests != nullptr)
    ++*exact_tests;
  if (isOnLine (corners.one, positions) || isOnLine (corners.other, positions))
    return false;
  const auto at = [&positions] (const Triangle& t) {
    return std::array<Eigen::Vector3d, 3>{positions[t[0]], positions[t[1]], positions[t[2]]};
  };
  const std::array<Eigen::Vector3d, 3> a = at (corners.one), b = at (corners.other);
  if (corners.common == 3)
    return true;
  if (corners.common == 2)
    return areOnOneSide (a[0], a[1], a[2], b[2]);
  if (corners.common == 0)
    return doMeet (a, b);
  // Any other common point implies one on the edge opposite to the corner, in one of them.
  return doMeet (a, b[1], b[2]) || doMeet (b, a[1], a[2]);
}

CrossingPairs
findSelfIntersections (const std::vector<Triangle>& triangles, const Positions& positions,
                       const RunContext& run)
{
  constexpr std::size_t LEAVES_AT_ONCE = 8;
  const PairSearchLimits limits;
  const std::vector<Index> order = orderByPoints (triangles, positions.size ()); // along the curve
  const BoxTree tree (
      triangles.size (), [&] (std::size_t i) { return boxOf (triangles[order[i]], positions); },
      run);
  std::vector<CrossingPairs> found ((tree.leaves () + RANGE_LENGTH - 1) / RANGE_LENGTH);
  parallelRanges (run, tree.leaves (), [&] (std::size_t first, std::size_t last) {
    CrossingPairs& pairs = found[first / RANGE_LENGTH];
    const std::size_t most = limits.work * (last - first) * BoxTree::LEAF_SIZE;
    std::size_t work = 0;
    for (std::size_t begin = first; begin < last; begin += LEAVES_AT_ONCE) {
      const std::size_t end = std::min (begin + LEAVES_AT_ONCE, last);
      if (work < most)
        tree.forOverlaps (begin, end, [&] (std::size_t i, std::size_t j) {
          if (work >= most)
            return;
          const auto [t, u] = std::minmax (order[i], order[j]);
          std::size_t exact_tests = 0;
          if (doCross (triangles[t], triangles[u], positions, &exact_tests))
            pairs.push_back ({t, u});
          work += 1 + limits.test + exact_tests * limits.exact_test;
        });
      if (work >= most)
        for (std::size_t i = begin * BoxTree::LEAF_SIZE;
             i < std::min (triangles.size (), end * BoxTree::LEAF_SIZE); ++i)
          pairs.untested.push_back (order[i]);
    }
  });
  CrossingPairs all;
  for (const CrossingPairs& pairs : found) {
    all.insert (all.end (), pairs.begin (), pairs.end ());
    all.untested.insert (all.untested.end (), pairs.untested.begin (), pairs.untested.end ());
  }
  std::sort (all.begin (), all.end ());
  std::sort (all.untested.begin (), all.untested.end ());
  return all;
}

} // namespace pcl::floater

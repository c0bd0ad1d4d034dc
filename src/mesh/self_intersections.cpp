// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/self_intersections.h"

#include "core/exact.h"
#include "core/geometry.h"
#include "mesh/box_tree.h"
#include "mesh/vertex_stars.h"

namespace pcl::floater {
namespace {

// Relative rounding bound. The error of a product of three coordinate differences is some 20 units
// in the last place of the product of their lengths; larger values have the right sign.
constexpr double ROUNDING = 1e-13;

// Limit of the search for pairs, against quadratic work: where points lie along lines, each triangle
// may overlap a large share of all others. Work on consecutive triangles, for each of them. One unit
// is some 5 nanoseconds, so that a triangle may take 40 microseconds; three times as long if many
// tests need exact numbers. And work of the tests of a pair, measured.
constexpr std::size_t MOST_PAIR_WORK = 8000, TEST_WORK = 30, EXACT_TEST_WORK = 500;

// Moves the common corners of two triangles to the front, in the same order in both.
// \return their number
std::size_t
moveCommonFirst (Triangle& one, Triangle& other)
{
  std::size_t common = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = common; j < 3; ++j)
      if (one[i] == other[j]) {
        std::swap (one[common], one[i]);
        std::swap (other[common], other[j]);
        ++common;
        break;
      }
  return common;
}

// Whether a plane separates two triangles without a common corner, beyond rounding: a plane along
// one of the triangles, or through one of their edges and across it.
bool
areSeparate (const Triangle& one, const Triangle& other, const Positions& positions)
{
  using Corner3 = std::array<Vector3d, 3>;
  Corner3 a, b; // from a corner of the first
  double sqr_reach = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    a[i] = positions[one[i]] - positions[one[0]];
    b[i] = positions[other[i]] - positions[one[0]];
    sqr_reach = std::max ({sqr_reach, a[i].squaredNorm (), b[i].squaredNorm ()});
  }
  const double sqr_precision = ROUNDING * ROUNDING * sqr_reach;
  const auto range = [] (const Corner3& corners, const Vector3d& direction) {
    const double x = corners[0].dot (direction), y = corners[1].dot (direction),
                 z = corners[2].dot (direction);
    return std::make_pair (std::min ({x, y, z}), std::max ({x, y, z}));
  };
  // Whether a plane across this direction separates the triangles.
  const auto isAcross = [&] (const Vector3d& direction) {
    const auto [low, high] = range (a, direction);
    const auto [other_low, other_high] = range (b, direction);
    const double gap = std::max (other_low - high, low - other_high);
    return gap > 0.0 && gap * gap > sqr_precision * direction.squaredNorm ();
  };
  const Vector3d normal = areaVector (a[0], a[1], a[2]);
  const Vector3d other_normal = areaVector (b[0], b[1], b[2]);
  if (isAcross (normal) || isAcross (other_normal))
    return true;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = i == 2 ? 0 : i + 1;
    if (isAcross (normal.cross (a[j] - a[i])) || isAcross (other_normal.cross (b[j] - b[i])))
      return true;
  }
  return false;
}

// The edges of a triangle at its first corner.
using Edges = std::array<Vector3d, 2>;

Edges
edgesOf (const Triangle& t, const Positions& positions)
{
  return {positions[t[1]] - positions[t[0]], positions[t[2]] - positions[t[0]]};
}

// Sign of a product of a direction and an edge; 0 if rounding might change it.
// \param sqr_size squared product of the lengths of the edges that define the direction
int
sideOf (const Vector3d& direction, double sqr_size, const Vector3d& edge)
{
  const double product = direction.dot (edge);
  if (!(product * product > ROUNDING * ROUNDING * sqr_size * edge.squaredNorm ()))
    return 0;
  return product > 0.0 ? 1 : -1;
}

// Whether a plane through the common first corner certainly has two triangles on its two sides, so that
// they share no more: the plane across the difference of their directions. Most pairs in a fan are so.
bool
areOpposite (const Edges& own, const Edges& other)
{
  const Vector3d across = own[0] + own[1] - other[0] - other[1];
  // At least the square of the sum of the four lengths, which bounds the rounding.
  const double sqr_size = 4.0 * (own[0].squaredNorm () + own[1].squaredNorm () +
                                 other[0].squaredNorm () + other[1].squaredNorm ());
  return sideOf (across, sqr_size, own[0]) > 0 && sideOf (across, sqr_size, own[1]) > 0 &&
         sideOf (across, sqr_size, other[0]) < 0 && sideOf (across, sqr_size, other[1]) < 0;
}

// Whether two triangles with a common first corner, and perhaps the second one, certainly share no
// more, since the plane of one of them, or one through its edges at the corner and across it, has
// the other one on one side.
bool
isBeside (const Edges& own, const Edges& other, std::size_t common)
{
  const double sqr_a = own[0].squaredNorm (), sqr_b = own[1].squaredNorm ();
  const Vector3d normal = own[0].cross (own[1]);
  const int side = sideOf (normal, sqr_a * sqr_b, other[1]);
  if (common == 2 || (side != 0 && side == sideOf (normal, sqr_a * sqr_b, other[0])))
    return side != 0;
  const auto areOut = [&other] (const Vector3d& inwards, double sqr_size) {
    return sideOf (inwards, sqr_size, other[0]) < 0 && sideOf (inwards, sqr_size, other[1]) < 0;
  };
  return areOut (normal.cross (own[0]), sqr_a * sqr_a * sqr_b) ||
         areOut (own[1].cross (normal), sqr_a * sqr_b * sqr_b);
}

} // namespace

bool
doCross (Triangle one, Triangle other, const Positions& positions, std::size_t* exact_tests)
{
  const std::size_t common = moveCommonFirst (one, other);
  if (common == 0 && areSeparate (one, other, positions))
    return false;
  if (common == 1 || common == 2) {
    const Edges own = edgesOf (one, positions), others = edgesOf (other, positions);
    if ((common == 1 && areOpposite (own, others)) || isBeside (own, others, common) ||
        isBeside (others, own, common))
      return false;
  }
  if (exact_tests != nullptr)
    ++*exact_tests;
  const auto at = [&positions] (const Triangle& t) {
    return std::array<Vector3d, 3>{positions[t[0]], positions[t[1]], positions[t[2]]};
  };
  const std::array<Vector3d, 3> a = at (one), b = at (other);
  if (areCollinear (a[0], a[1], a[2]) || areCollinear (b[0], b[1], b[2]))
    return false;
  if (common == 3)
    return true;
  if (common == 2)
    return areOnOneSide (a[0], a[1], a[2], b[2]);
  if (common == 0)
    return doMeet (a, b);
  // Any other common point implies one on the edge opposite to the corner, in one of them.
  return doMeet (a, b[1], b[2]) || doMeet (b, a[1], a[2]);
}

CrossingPairs
findSelfIntersections (const std::vector<Triangle>& triangles, const Positions& positions,
                       const RunContext& run)
{
  const std::vector<Index> order = orderByPoints (triangles, positions.size ());
  const BoxTree tree (
      triangles.size (), [&] (std::size_t i) { return boxOf (triangles[order[i]], positions); },
      run);
  constexpr std::size_t LEAVES_AT_ONCE = 8; // consecutive leaves, with mostly the same near boxes
  RangeLists<CrossingPair> found (tree.leaves ());
  RangeLists<Index> untested (tree.leaves ());
  parallelRanges (run, tree.leaves (), [&] (std::size_t first, std::size_t last) {
    const std::size_t most = MOST_PAIR_WORK * (last - first) * BoxTree::LEAF_SIZE;
    std::size_t work = 0;
    for (std::size_t begin = first; begin < last; begin += LEAVES_AT_ONCE) {
      const std::size_t end = std::min (begin + LEAVES_AT_ONCE, last);
      if (work < most)
        tree.forOverlaps (begin, end, [&] (std::size_t i, std::size_t j) {
          const auto [t, u] = std::minmax (order[i], order[j]);
          if (work >= most)
            return;
          std::size_t exact_tests = 0;
          if (doCross (triangles[t], triangles[u], positions, &exact_tests))
            found.of (first).emplace_back (t, u);
          work += TEST_WORK + exact_tests * EXACT_TEST_WORK;
        });
      if (work >= most)
        for (std::size_t i = begin * BoxTree::LEAF_SIZE;
             i < std::min (triangles.size (), end * BoxTree::LEAF_SIZE); ++i)
          untested.of (first).push_back (order[i]);
    }
  });
  CrossingPairs all{found.join (), untested.join ()};
  std::sort (all.begin (), all.end ());
  std::sort (all.untested.begin (), all.untested.end ());
  return all;
}

} // namespace pcl::floater

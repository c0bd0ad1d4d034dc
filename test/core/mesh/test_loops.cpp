// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes of boundary loops, evidence of what they are, and which of them are kept open.
#include "mesh/loops.h"

#include "mesh/known_meshes.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;

TEST (BoundaryLoops, TheWidthIsExactUpTo256PointsAndThenShortByTwoStepsAtMost)
{
  RandomStream random (5);
  for (const std::size_t count : {3U, 100U, 256U, 257U, 300U, 1000U, 5001U}) {
    SCOPED_TRACE (count);
    Positions positions;
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = 2.0 * PI * static_cast<double> (i) / static_cast<double> (count);
      const double radius = 1.0 + 0.3 * std::sin (3.0 * angle) + 0.01 * random.uniform ();
      positions.push_back (polar (radius, angle));
    }
    double exact = 0.0, step = 0.0; // of the places that are measured, at the most
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d& p = positions[i];
      step = std::max (step, std::ceil (count / 256.0) * (positions[(i + 1) % count] - p).norm ());
      for (const Eigen::Vector3d& q : positions)
        exact = std::max (exact, (p - q).norm ());
    }
    const BoundaryLoop loop =
        measureLoop (indices (count), positions, std::vector<float> (count, 0.1F));
    EXPECT_LE (loop.width, exact);
    EXPECT_GE (loop.width, count <= 256 ? exact : exact - 2.0 * step);
  }
}

// A loop of a length, of a component.
BoundaryLoop
loopOf (double length, const LoopJudgement& judgement, Index component = 0)
{
  BoundaryLoop loop;
  loop.judgement = judgement;
  loop.points.resize (10);
  loop.length = length;
  loop.component = component;
  return loop;
}

using Indices = std::vector<Index>;

Indices
kept (std::vector<BoundaryLoop> loops, const HoleOptions& holes, double unit = 1.0)
{
  chooseOpenLoops (loops, holes, unit);
  return indicesWhere (loops.size (), [&] (Index i) { return loops[i].keep_open; });
}

TEST (OpenLoops, AreKeptIfTheyExceedTheSizeGivenInItsUnit)
{
  std::vector<BoundaryLoop> loops (9); // 1 to 9 wide
  for (std::size_t i = 0; i < loops.size (); ++i) {
    loops[i].width = static_cast<double> (i + 1);
    loops[i].spacing = 0.5;
  }
  const auto keptAbove = [&loops] (double largest_hole, LengthUnit length_unit, double unit) {
    return kept (loops, {HolePolicy::BY_SIZE, 1, largest_hole, length_unit}, unit);
  };
  EXPECT_EQ (keptAbove (14.0, LengthUnit::SPACINGS, 1.0), (Indices{7, 8}));
  EXPECT_EQ (keptAbove (14.0, LengthUnit::SPACINGS, 0.1), (Indices{7, 8}));
  EXPECT_EQ (keptAbove (6.0, LengthUnit::CLOUD, 1.0), (Indices{6, 7, 8}));
  EXPECT_EQ (keptAbove (3.0, LengthUnit::CLOUD, 2.0), (Indices{6, 7, 8}));
  EXPECT_EQ (keptAbove (14.0, LengthUnit::CLOUD, 1.0), Indices{});
}

TEST (OpenLoops, PoliciesGoByTheOdds)
{
  // Two boundaries, of which the shorter is surer, a longer gap, and a gap of another component.
  const std::vector<BoundaryLoop> loops = {
      loopOf (30.0, {5.0, 9.0, false}), loopOf (40.0, {3.0, 40.0, false}),
      loopOf (90.0, {-2.0, 20.0, false}), loopOf (8.0, {-4.0, 8.0, false}, 1)};
  EXPECT_EQ (kept (loops, {HolePolicy::AUTO}), (Indices{0, 1}));
  EXPECT_EQ (kept (loops, {HolePolicy::CLOSE_ALL}), Indices{});
  EXPECT_EQ (kept (loops, {HolePolicy::KEEP_LARGEST}), (Indices{1, 3}));
  const std::vector<Indices> by_count = {{}, {0}, {0, 1}, {0, 1, 2}, {0, 1, 2, 3}, {0, 1, 2, 3}};
  for (int i = 0; i < 6; ++i)
    EXPECT_EQ (kept (loops, {HolePolicy::KEEP_COUNT, i}), by_count[static_cast<std::size_t> (i)]);
}

TEST (OpenLoops, OfUnlikelyBoundariesThoseWithMostEmptinessBeyondAreKept)
{
  std::vector<BoundaryLoop> loops = {loopOf (30.0, {-1.0, 10.0, false}),
                                     loopOf (90.0, {-2.0, 30.0, false}),
                                     loopOf (40.0, {-3.0, 20.0, false})};
  EXPECT_EQ (kept (loops, {HolePolicy::KEEP_COUNT, 2}), (Indices{1, 2}));
  EXPECT_EQ (kept (loops, {HolePolicy::KEEP_LARGEST}), Indices{1});
  // A gap too deep to be filled stays open, unless the policy says otherwise.
  loops[0].judgement.is_too_deep = true;
  EXPECT_EQ (kept (loops, {HolePolicy::AUTO}), Indices{0});
  EXPECT_EQ (kept (loops, {HolePolicy::CLOSE_ALL}), Indices{});
}

TEST (OpenLoops, DecisionsNearEvenOddsAreDoubtful)
{
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_TRUE (isDoubtful ({sign * 2.19, 0.0, false})); // nine in ten: log (9) is 2.197
    EXPECT_FALSE (isDoubtful ({sign * 2.20, 0.0, false}));
  }
  EXPECT_TRUE (isDoubtful ({-9.0, 0.0, true}));
  EXPECT_FALSE (isDoubtful ({9.0, 0.0, true}));
  EXPECT_NEAR ((LoopJudgement{std::log (9.0), 0.0, false}.probability ()), 0.9, 1e-12);
}

// A sheet of equilateral triangles of side 1 without those that have a corner nearer to the middle
// than `inside`. Its first loop is that of the hole.
struct TriangularSheet : UprightMesh
{
  LocalGeometry geometry; // neighbours share an edge

  static Mesh made (Index half, double inside)
  {
    Mesh sheet = cells (2 * half, 2 * half, [half] (Index x, Index y) {
      return Eigen::Vector3d (x - 0.5 * y - 0.5 * half, std::sqrt (0.75) * (1.0 * y - half), 0.0);
    });
    const auto isInside = [&] (const Triangle& t) {
      return anyCorner (t, [&] (Index p) { return sheet.positions[p].norm () < inside; });
    };
    Triangles& all = sheet.triangles;
    all.erase (std::remove_if (all.begin (), all.end (), isInside), all.end ());
    return sheet;
  }

  TriangularSheet (Index half, double inside) : UprightMesh (made (half, inside))
  {
    EXPECT_EQ (loops.size (), 2U);
    if (loops.size () == 2 && loops[1].length < loops[0].length)
      std::swap (loops[0], loops[1]);
    geometry.stars.normals = normals;
    geometry.neighbors = makeCsrLists (positions.size (), [&] (auto&& emit) {
      for (const Triangle& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
          emit (t[k], t[(k + 1) % 3]);
          emit (t[k], t[(k + 2) % 3]);
        }
    });
  }

  std::vector<LoopEvidence> evidence () { return judgeLoops (mesh, loops, positions, geometry, 1); }
};

TEST (LoopEvidence, OfAHexagonalHoleInAnEvenSheetIsExact)
{
  // The six neighbours of the missing point: a regular hexagon of side 1.
  TriangularSheet sheet (10, 0.5);
  const LoopEvidence hole = sheet.evidence ()[0], border = sheet.evidence ()[1];
  ASSERT_EQ (sheet.loops[0].points.size (), 6U);
  const double area = 1.5 * std::sqrt (3.0);
  EXPECT_NEAR (hole.compactness, 4.0 * PI * area / 36.0, 1e-12);
  EXPECT_NEAR (hole.depth, 1.5, 1e-12); // three corners are cut off: a triangle of side sqrt (3)
  EXPECT_NEAR (hole.irregularity, 0.0, 1e-6);
  EXPECT_NEAR (hole.growth, 0.0, 1e-12);
  EXPECT_NEAR (hole.turning, -1.0, 1e-12);
  EXPECT_NEAR (hole.line_distance, 1.0, 1e-12);
  EXPECT_FALSE (hole.is_last_line); // in one plane
  // A point of the hexagon misses one of six neighbours: a sector of 120 degrees.
  EXPECT_EQ (hole.open_share, 0.0);
  // The border turns the other way.
  EXPECT_NEAR (border.turning, 1.0, 1e-9);
  EXPECT_EQ (border.open_share, 1.0); // half a turn, or more at the corners
}

TEST (LoopEvidence, OfLoopsOfOneWidthIsJudgedTogether)
{
  // Loops of these widths and log odds. Their spacings differ, which does not matter.
  const auto oddsTogether = [] (const std::vector<std::pair<double, double>>& loops) {
    std::vector<BoundaryLoop> all (loops.size ());
    std::vector<BoundaryLoop*> judged;
    for (std::size_t i = 0; i < loops.size (); ++i) {
      all[i].width = loops[i].first;
      all[i].spacing = 1.0 + static_cast<double> (i);
      all[i].judgement.log_odds = loops[i].second;
      judged.push_back (&all[i]);
    }
    judgeTogether (judged);
    std::vector<double> odds;
    for (const BoundaryLoop& loop : all)
      odds.push_back (loop.judgement.log_odds);
    return odds;
  };
  EXPECT_EQ (oddsTogether ({{8.0, 0.5}, {10.0, -0.7}, {5.0, 2.0}}),
             (std::vector<double>{0.5, -0.7, 2.0}));
  EXPECT_EQ (oddsTogether ({{8.0, 1.25}, {8.1, -0.5}, {7.6, 1.0}, {8.3, 0.25}}),
             (std::vector<double>{1.0, 1.0, 1.0, 1.0}));
  // What is certain stays as it is, and counts for 3; a loop without a width is left out.
  EXPECT_EQ (oddsTogether ({{8.0, 9.0}, {8.0, -0.5}, {8.0, 8.0}, {8.0, -3.5}, {0.0, 1.0}}),
             (std::vector<double>{9.0, 1.25, 8.0, -3.5, 1.0}));
  EXPECT_EQ (oddsTogether ({{8.0, -9.0}, {8.0, 1.0}}),
             (std::vector<double>{-9.0, -2.0 / std::sqrt (2.0)}));
  // Windows that are certain together leave no gap between them; gaps fill no certain window.
  EXPECT_EQ (oddsTogether ({{8.0, 9.0}, {8.0, 9.0}, {8.0, -9.0}, {8.0, 9.0}}),
             (std::vector<double>{9.0, 9.0, -9.0, 9.0}));
  EXPECT_EQ (oddsTogether ({{8.0, 9.0}, {8.0, 9.0}, {8.0, 9.0}, {8.0, -9.0}, {8.0, 3.0}}),
             (std::vector<double>{9.0, 9.0, 9.0, 9.0 / std::sqrt (5.0), 3.0}));
  EXPECT_EQ (oddsTogether ({{8.0, -9.0}, {8.0, -9.0}, {8.0, -9.0}, {8.0, 9.0}, {8.0, -3.0}}),
             (std::vector<double>{-9.0, -9.0, -9.0, 9.0, -3.0}));
}

// Profiles of two rows along both axes, with 36 gaps of 8 by 8 spacings between them: all are open, or
// none. 4 of these 10 are alike if loops that are certain by themselves follow no others.
TEST (LoopEvidence, OfGapsBetweenProfilesIsAlike)
{
  constexpr int GAP = 8, GAPS = 6, SIDE = GAPS * (GAP + 1) + 2;
  int alike = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    RandomStream random (seed);
    Positions points;
    for (int x = 0; x < SIDE; ++x)
      for (int y = 0; y < SIDE; ++y)
        if (x % (GAP + 1) < 2 || y % (GAP + 1) < 2)
          points.emplace_back (Eigen::Vector3d (x, y, 0.2 * x) + 0.08 * normalVector (random));
    const std::size_t loops = reconstruct (asInput (points), {}).report.check.loops.size ();
    alike += loops == 1 || loops == GAPS * GAPS + 1 ? 1 : 0;
  }
  EXPECT_GE (alike, 8);
}

// Slices of a body of revolution, some steps apart. A ball is closed though no slice meets its ends; the
// end of a bowl or of a tube is open.
TEST (LoopEvidence, OfTheLastSliceShowsWhetherABodyEndsThere)
{
  const auto loopsOf = [] (double apart, std::uint64_t seed, double top, bool is_tube) {
    RandomStream random (seed);
    Positions points;
    for (double z = -30.0 + apart * random.uniform (); z < top; z += apart) {
      const double radius = is_tube ? 12.0 : std::sqrt (900.0 - z * z),
                   count = std::ceil (6.28 * radius);
      for (double i = random.uniform (); i < count; ++i)
        points.push_back (polar (radius, 2.0 * PI * i / count, z));
    }
    return reconstruct (asInput (points), {}).report.check.loops.size ();
  };
  for (const double apart : {1.5, 3.0, 6.0})
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      EXPECT_EQ (loopsOf (apart, seed, 30.0, false), 0U) << apart << " " << seed;
      EXPECT_EQ (loopsOf (apart, seed, 10.0, false), 1U) << apart << " " << seed;
      EXPECT_EQ (loopsOf (apart, seed, 30.0, true), 2U) << apart << " " << seed;
    }
}

TEST (LoopEvidence, PointsOnAnotherSheetDoNotCloseABoundary)
{
  // Across the border of an even sheet, points whose normals are turned by 90 degrees.
  TriangularSheet sheet (6, 0.5);
  const std::size_t count = sheet.positions.size ();
  EXPECT_EQ (sheet.evidence ()[1].open_share, 1.0);
  for (std::size_t p = 0; p < count; ++p) {
    sheet.positions.push_back (1.2 * sheet.positions[p]);
    sheet.geometry.stars.normals.push_back (Eigen::Vector3f::UnitX ());
  }
  sheet.mesh.triangle_of.resize (2 * count, NONE);
  const CsrLists own = sheet.geometry.neighbors;
  sheet.geometry.neighbors = makeCsrLists (2 * count, [&] (auto&& emit) {
    for (std::size_t p = 0; p < count; ++p) {
      for (const Index q : own.row (p))
        emit (p, q);
      emit (p, static_cast<Index> (p + count));
    }
  });
  EXPECT_EQ (sheet.evidence ()[1].open_share, 1.0);
  EXPECT_LT (sheet.evidence ()[1].empty_share, 0.5);
  for (std::size_t p = count; p < 2 * count; ++p)
    sheet.geometry.stars.normals[p] = Eigen::Vector3f::UnitZ ();
  EXPECT_LT (sheet.evidence ()[1].open_share, 0.5);
}

} // namespace
} // namespace pcl::floater

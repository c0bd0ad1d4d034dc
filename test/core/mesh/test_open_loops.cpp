// SPDX-License-Identifier: GPL-3.0-or-later
// Which boundary loops are kept open.
#include "mesh/open_loops.h"

#include "samples.h"

#include <gtest/gtest.h>

namespace pcl
{
namespace floater
{
namespace
{
using samples::PI;

HoleOptions
policy (HolePolicy kind)
{
  HoleOptions holes;
  holes.policy = kind;
  return holes;
}

// Widths of the loops that are kept open, of loops 1 to 9 wide with spacings of 0.5.
std::vector<double>
widthsKept (double largest_hole, double largest_hole_length, double unit)
{
  std::vector<BoundaryLoop> loops;
  for (int width = 1; width <= 9; ++width) {
    BoundaryLoop loop;
    loop.width = width;
    loop.spacing = 0.5;
    loops.push_back (loop);
  }
  HoleOptions holes = policy (HolePolicy::BY_SIZE);
  holes.largest_hole = largest_hole;
  holes.largest_hole_length = largest_hole_length;
  chooseOpenLoops (loops, std::vector<LoopEvidence> (loops.size ()), {100}, holes, unit, {});
  std::vector<double> widths;
  for (const BoundaryLoop& loop : loops)
    if (loop.keep_open)
      widths.push_back (loop.width);
  return widths;
}

TEST (OpenLoops, AreKeptIfTheyExceedAnyOfTheSizesGiven)
{
  EXPECT_EQ (widthsKept (14.0, 0.0, 1.0), (std::vector<double>{8.0, 9.0}));
  EXPECT_EQ (widthsKept (0.0, 6.0, 1.0), (std::vector<double>{7.0, 8.0, 9.0}));
  EXPECT_EQ (widthsKept (0.0, 3.0, 2.0), (std::vector<double>{7.0, 8.0, 9.0}));
  EXPECT_EQ (widthsKept (14.0, 6.0, 1.0), (std::vector<double>{7.0, 8.0, 9.0}));
  EXPECT_EQ (widthsKept (12.0, 8.0, 1.0), (std::vector<double>{7.0, 8.0, 9.0}));
}

// The boundary of a regular polygon with steps of 1.
BoundaryLoop
polygon (std::size_t sides, Index component = 0)
{
  BoundaryLoop loop;
  loop.points.resize (sides);
  loop.length = static_cast<double> (sides);
  loop.width = 1.0 / std::sin (PI / static_cast<double> (sides));
  loop.component = component;
  return loop;
}

bool
isKept (std::size_t sides, double open_share, std::size_t component_points,
        const OpenLoopLimits& limits = {})
{
  std::vector<BoundaryLoop> loops = {polygon (sides)};
  chooseOpenLoops (loops, {{open_share, open_share}}, {component_points}, {}, 1.0, limits);
  return loops.front ().keep_open;
}

TEST (OpenLoops, TheAutomaticPolicyGoesByEvidenceWidthAndLength)
{
  constexpr std::size_t LARGE = 1'000'000; // points of the component
  // Four in five points, and 6 steps wide, which takes 19 sides ...
  EXPECT_TRUE (isKept (19, 0.8, LARGE));
  EXPECT_FALSE (isKept (18, 0.8, LARGE));
  EXPECT_FALSE (isKept (19, 0.79, LARGE));
  // ... or the whole boundary of a small component.
  EXPECT_TRUE (isKept (10, 0.8, 100));
  EXPECT_FALSE (isKept (10, 0.8, 101));
  // All points, and 4 steps wide, which takes 13 sides.
  EXPECT_TRUE (isKept (13, 0.97, LARGE));
  EXPECT_FALSE (isKept (12, 0.97, LARGE));
  EXPECT_FALSE (isKept (13, 0.96, LARGE));
  // Half of the points of a very long loop.
  EXPECT_TRUE (isKept (200, 0.5, 10'000));
  EXPECT_FALSE (isKept (199, 0.5, 10'000));
  EXPECT_FALSE (isKept (200, 0.49, 10'000));
}

TEST (OpenLoops, LimitsAreThoseGiven)
{
  OpenLoopLimits limits;
  limits.wide_steps = 5.0;
  EXPECT_TRUE (isKept (18, 0.8, 1'000'000, limits));
  limits.open_share = 0.7;
  EXPECT_TRUE (isKept (18, 0.75, 1'000'000, limits));
}

TEST (OpenLoops, PoliciesThatCountPreferBoundaries)
{
  // Two boundaries, a longer defect, and a defect of another component.
  const std::vector<BoundaryLoop> loops = {polygon (30), polygon (40), polygon (90),
                                           polygon (8, 1)};
  const std::vector<LoopEvidence> evidence = {{1.0, 1.0}, {1.0, 0.5}, {0.1, 0.1}, {0.1, 0.1}};
  const auto kept = [&] (const HoleOptions& holes) {
    std::vector<BoundaryLoop> chosen = loops;
    chooseOpenLoops (chosen, evidence, {1'000'000, 1000}, holes, 1.0, {});
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < chosen.size (); ++i)
      if (chosen[i].keep_open)
        indices.push_back (i);
    return indices;
  };
  using Indices = std::vector<std::size_t>;
  EXPECT_EQ (kept (policy (HolePolicy::AUTO)), (Indices{0, 1}));
  EXPECT_EQ (kept (policy (HolePolicy::CLOSE_ALL)), Indices{});
  EXPECT_EQ (kept (policy (HolePolicy::KEEP_LARGEST)), (Indices{0, 3}));
  HoleOptions count = policy (HolePolicy::KEEP_COUNT);
  const std::vector<Indices> by_count = {{}, {0}, {0, 1}, {0, 1, 2}, {0, 1, 2, 3}, {0, 1, 2, 3}};
  for (int i = 0; i < 6; ++i) {
    count.kept_loops = i;
    EXPECT_EQ (kept (count), by_count[static_cast<std::size_t> (i)]);
  }
}

TEST (OpenLoops, ABoundarySeesNothingBeyondIt)
{
  // The border of a round sheet, and points around its middle.
  const samples::Sheet sheet = samples::disc (0.1, 3);
  const samples::Neighborhoods made = samples::makeNeighborhoods (sheet.positions);
  const std::vector<Eigen::Vector3d>& positions = made.points.positions;
  BoundaryLoop boundary, inside;
  for (Index p = 0; p < positions.size (); ++p)
    if (made.points.cloud_index[p] < sheet.border)
      boundary.points.push_back (p);
    else if (positions[p].norm () < 0.2)
      inside.points.push_back (p);
  ASSERT_FALSE (inside.points.empty ());
  const std::vector<LoopEvidence> evidence = findEvidence (
      {boundary, inside}, positions, made.geometry.neighbors, made.geometry.stars.normals, {}, 1);
  ASSERT_EQ (evidence.size (), 2U);
  EXPECT_GT (evidence[0].open_share, 0.95);
  EXPECT_GT (evidence[0].empty_share, 0.95);
  EXPECT_EQ (evidence[1].open_share, 0.0);
  EXPECT_EQ (evidence[1].empty_share, 0.0);
}

TEST (OpenLoops, PointsOnAnotherSheetDoNotCloseABoundary)
{
  // A fan of neighbours on one side of point 0, and others whose normals are turned by 90 degrees
  // on the other side.
  std::vector<Eigen::Vector3d> positions = {{0, 0, 0}};
  std::vector<Eigen::Vector3f> normals = {Eigen::Vector3f::UnitZ ()};
  CsrLists neighbors;
  neighbors.offsets = {0};
  for (int i = 0; i < 12; ++i) {
    const double angle = 2.0 * PI * i / 12.0;
    positions.emplace_back (std::cos (angle), std::sin (angle), 0.0);
    normals.push_back (i < 6 ? Eigen::Vector3f::UnitZ () : Eigen::Vector3f::UnitX ());
    neighbors.ids.push_back (static_cast<Index> (i + 1));
  }
  neighbors.offsets.resize (positions.size () + 1, 12);
  BoundaryLoop loop;
  loop.points = {0};
  const LoopEvidence evidence = findEvidence ({loop}, positions, neighbors, normals, {}, 1)[0];
  EXPECT_EQ (evidence.open_share, 1.0);
  EXPECT_EQ (evidence.empty_share, 0.0);
}

} // namespace
} // namespace floater
} // namespace pcl

// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/boundary/boundary.h"

#include "samples.h"

#include <gtest/gtest.h>

#include <limits>

namespace pcl
{
namespace floater
{
namespace
{
using samples::makeNeighborhoods;
using samples::Neighborhoods;
using samples::Positions;
using samples::Sheet;

Boundary
find (const Neighborhoods& made, const Options& options)
{
  return findBoundary (made.points, made.geometry.neighbors, made.geometry.stars, options);
}

std::vector<Index>
inCloud (const Neighborhoods& made, const Boundary& boundary)
{
  std::vector<Index> loop;
  for (const Index p : boundary.loop)
    loop.push_back (made.points.cloud_index[p]);
  return loop;
}

void
expectInvalid (const Neighborhoods& made, const std::vector<Index>& loop, const std::string& why)
{
  Options options;
  options.boundary.loop = loop;
  const Boundary boundary = find (made, options);
  EXPECT_EQ (boundary.problem.status, Status::INVALID_LOOP);
  EXPECT_NE (boundary.problem.message.find (why), std::string::npos) << boundary.problem.message;
  EXPECT_TRUE (boundary.loop.empty ());
}

TEST (LongestLoop, EveryMethodFindsTheBorderOfADisc)
{
  const Sheet sheet = samples::disc (0.06, 1);
  const Neighborhoods made = makeNeighborhoods (sheet.positions);
  for (const BoundaryMethod method :
       {BoundaryMethod::SPANNING_TREE, BoundaryMethod::CONSENSUS, BoundaryMethod::TWO_SEGMENTS}) {
    Options options;
    options.boundary.method = method;
    const Boundary boundary = find (made, options);
    EXPECT_FALSE (boundary.problem);
    EXPECT_EQ (samples::canonicalCycle (inCloud (made, boundary)), samples::indices (sheet.border));
    EXPECT_GE (boundary.candidates, sheet.border);
  }
}

// A hole in the sheet is no border, however it is sampled.
TEST (LongestLoop, TheComplexTellsTheBorderFromAHole)
{
  samples::Outline hole = samples::circle (0.4, 0.06);
  const Sheet sheet = samples::fillOutlines ({samples::circle (1.0, 0.06), hole}, 0.06, 0.35, 6);
  const Neighborhoods made = makeNeighborhoods (sheet.positions);
  Options options;
  options.boundary.method = BoundaryMethod::CONSENSUS;
  const std::vector<Eigen::Vector3f> normals = made.geometry.stars.normals;
  const Boundary boundary = find (made, options);
  EXPECT_EQ (samples::canonicalCycle (inCloud (made, boundary)), samples::indices (sheet.border));
  EXPECT_GE (boundary.candidates, sheet.border + hole.size ());
  EXPECT_LT (boundary.largest_step, 2.0);
  EXPECT_EQ (made.geometry.stars.normals, normals);
}

TEST (LongestLoop, TheUsersLoopIsTakenAsItIs)
{
  const Sheet sheet = samples::disc (0.06, 2);
  const Neighborhoods made = makeNeighborhoods (sheet.positions);
  Options options;
  for (Index p = 0; p < sheet.border; p += 2)
    options.boundary.loop.push_back (static_cast<Index> (sheet.border) - 1 - p);
  const Boundary boundary = find (made, options);
  EXPECT_FALSE (boundary.problem);
  EXPECT_EQ (inCloud (made, boundary), options.boundary.loop);
  EXPECT_EQ (boundary.candidates, options.boundary.loop.size ());
}

TEST (LongestLoop, ADuplicateMeansThePointThatStandsForIt)
{
  Sheet sheet = samples::disc (0.1, 3);
  const auto copy = static_cast<Index> (sheet.positions.size ());
  sheet.positions.push_back (sheet.positions[7]);
  const Neighborhoods made = makeNeighborhoods (sheet.positions);
  Options options;
  options.boundary.loop = {0, copy, 14, 21};
  EXPECT_EQ (inCloud (made, find (made, options)), (std::vector<Index>{0, 7, 14, 21}));
  expectInvalid (made, {0, 7, copy, 14}, "twice through point " + std::to_string (copy));
}

TEST (LongestLoop, WhatIsWrongWithTheUsersLoop)
{
  Sheet sheet = samples::disc (0.1, 4);
  const auto bad = static_cast<Index> (sheet.positions.size ());
  sheet.positions.emplace_back (std::numeric_limits<double>::quiet_NaN (), 0, 0);
  const Neighborhoods made = makeNeighborhoods (sheet.positions);
  expectInvalid (made, {0, 5, 10, 5}, "twice through point 5");
  expectInvalid (made, {0, 5}, "fewer than 3");
  expectInvalid (made, {0, 5, 10, bad}, "point " + std::to_string (bad));
  expectInvalid (made, {0, 5, 10, 4000000000U}, "point 4000000000");
}

TEST (LongestLoop, NamesItsLongestStep)
{
  const Sheet sheet = samples::disc (0.06, 5);
  const Neighborhoods made = makeNeighborhoods (sheet.positions);
  Options options;
  for (Index p = 0; p < sheet.border; ++p)
    if (p < 40 || p >= 60)
      options.boundary.loop.push_back (p);
  const Boundary boundary = find (made, options);
  ASSERT_LT (boundary.longest_from, made.points.cloud_index.size ());
  EXPECT_EQ (made.points.cloud_index[boundary.longest_from], 39U);
  EXPECT_GT (boundary.largest_step, 15.0);
  EXPECT_LT (boundary.largest_step, 22.0);
}

TEST (LongestLoop, NoneAroundAClosedSurface)
{
  Positions sphere (1500);
  for (std::size_t i = 0; i < sphere.size (); ++i) {
    const double z = 1.0 - 2.0 * (static_cast<double> (i) + 0.5) / 1500.0;
    const double angle = samples::PI * (3.0 - std::sqrt (5.0)) * static_cast<double> (i);
    sphere[i] = {std::sqrt (1.0 - z * z) * std::cos (angle),
                 std::sqrt (1.0 - z * z) * std::sin (angle), z};
  }
  const Neighborhoods made = makeNeighborhoods (sphere);
  for (const BoundaryMethod method :
       {BoundaryMethod::SPANNING_TREE, BoundaryMethod::CONSENSUS, BoundaryMethod::TWO_SEGMENTS}) {
    Options options;
    options.boundary.method = method;
    const Boundary boundary = find (made, options);
    EXPECT_EQ (boundary.problem.status, Status::NO_BOUNDARY);
    EXPECT_FALSE (boundary.problem.message.empty ());
    EXPECT_TRUE (boundary.loop.empty ());
  }
}

} // namespace
} // namespace floater
} // namespace pcl

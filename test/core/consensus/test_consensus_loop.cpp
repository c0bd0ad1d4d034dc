// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary loop of a disc as a loop of the triangles that stars agree on.
#include "consensus/consensus_method.h"

#include "samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::makeNeighborhoods;
using samples::Neighborhoods;
using samples::Positions;
using samples::Sheet;

Boundary
find (const Neighborhoods& made)
{
  Boundary boundary = consensusLoop (made.points.positions, made.geometry, 1);
  checkBoundary (made.points, made.geometry.spacing, false, boundary);
  return boundary;
}

std::vector<Index>
inCloud (const Neighborhoods& made, const Boundary& boundary)
{
  std::vector<Index> loop;
  for (const Index p : boundary.loop)
    loop.push_back (made.points.cloud_index[p]);
  return loop;
}

TEST (ConsensusLoop, IsTheBorderOfADisc)
{
  const Sheet sheet = samples::disc (0.06, 1);
  const Neighborhoods made = makeNeighborhoods (sheet.positions);
  const Boundary boundary = find (made);
  EXPECT_FALSE (boundary.problem);
  EXPECT_EQ (samples::canonicalCycle (inCloud (made, boundary)), samples::indices (sheet.border));
  EXPECT_GE (boundary.candidates, sheet.border);
}

// A hole in the sheet is no border, however it is sampled.
TEST (ConsensusLoop, IsTheBorderAndNotAHole)
{
  const samples::Outline hole = samples::circle (0.4, 0.06);
  const Sheet sheet = samples::fillOutlines ({samples::circle (1.0, 0.06), hole}, 0.06, 0.35, 6);
  const Neighborhoods made = makeNeighborhoods (sheet.positions);
  const std::vector<Eigen::Vector3f> normals = made.geometry.stars.normals;
  const Boundary boundary = find (made);
  EXPECT_EQ (samples::canonicalCycle (inCloud (made, boundary)), samples::indices (sheet.border));
  EXPECT_GE (boundary.candidates, sheet.border + hole.size ());
  EXPECT_LT (boundary.largest_step, 2.0);
  EXPECT_EQ (made.geometry.stars.normals, normals);
}

TEST (ConsensusLoop, OfAClosedSurfaceIsEmpty)
{
  Positions sphere (1500);
  for (std::size_t i = 0; i < sphere.size (); ++i) {
    const double z = 1.0 - 2.0 * (static_cast<double> (i) + 0.5) / 1500.0;
    const double angle = samples::PI * (3.0 - std::sqrt (5.0)) * static_cast<double> (i);
    sphere[i] = {std::sqrt (1.0 - z * z) * std::cos (angle),
                 std::sqrt (1.0 - z * z) * std::sin (angle), z};
  }
  const Boundary boundary = find (makeNeighborhoods (sphere));
  EXPECT_EQ (boundary.problem.status, RunStatus::NO_BOUNDARY);
  EXPECT_FALSE (boundary.problem.message.empty ());
  EXPECT_TRUE (boundary.loop.empty ());
}

} // namespace
} // namespace pcl::floater

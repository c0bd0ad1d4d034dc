// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes of boundary loops.
#include "mesh/loops.h"

#include "samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::Positions;

// A loop of all points in order, measured.
BoundaryLoop
measured (const Positions& positions, const std::vector<float>& spacing)
{
  BoundaryLoop loop;
  loop.points = samples::indices (positions.size ());
  measureLoop (loop, positions, spacing);
  return loop;
}

double
widthByAllPairs (const Positions& positions)
{
  double width = 0.0;
  for (const Eigen::Vector3d& p : positions)
    for (const Eigen::Vector3d& q : positions)
      width = std::max (width, (p - q).norm ());
  return width;
}

TEST (BoundaryLoops, LengthWidthAndSpacing)
{
  const Positions rectangle = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}};
  const BoundaryLoop loop = measured (rectangle, {1.0F, 2.0F, 3.0F, 2.0F});
  EXPECT_DOUBLE_EQ (loop.length, 14.0);
  EXPECT_DOUBLE_EQ (loop.width, 5.0);
  EXPECT_DOUBLE_EQ (loop.spacing, 2.0);
}

TEST (BoundaryLoops, TheWidthIsExactUpTo256Points)
{
  for (const std::size_t count : {3U, 100U, 255U, 256U}) {
    const Positions positions = samples::randomPoints (count, count);
    const std::vector<float> spacing (count, 0.1F);
    EXPECT_EQ (measured (positions, spacing).width, widthByAllPairs (positions)) << count;
  }
}

TEST (BoundaryLoops, TheWidthOfALongLoopIsShortByTwoStepsAtMost)
{
  RandomStream random (5);
  for (const std::size_t count : {257U, 300U, 1000U, 5001U}) {
    Positions positions;
    for (std::size_t i = 0; i < count; ++i) {
      const double angle =
          2.0 * samples::PI * static_cast<double> (i) / static_cast<double> (count);
      const double radius = 1.0 + 0.3 * std::sin (3.0 * angle) + 0.01 * random.uniform ();
      positions.emplace_back (radius * std::cos (angle), radius * std::sin (angle), 0.0);
    }
    // From each point along the loop to the next one that is measured.
    const std::size_t stride = (count + 255) / 256;
    double step = 0.0;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 1; j <= stride; ++j)
        step = std::max (step, (positions[(i + j) % count] - positions[i]).norm ());
    const double exact = widthByAllPairs (positions);
    const double width = measured (positions, std::vector<float> (count, 0.1F)).width;
    EXPECT_LE (width, exact) << count;
    EXPECT_GE (width, exact - 2.0 * step) << count;
  }
}

TEST (BoundaryLoops, AreFoundInOrderWithTheirComponents)
{
  // Two triangles apart from each other; point 3 is no vertex.
  const Positions positions = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {9, 9, 9},
                               {5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
  TriangleMesh mesh;
  mesh.triangles = {{5, 6, 4}, {0, 1, 2}};
  ASSERT_TRUE (mesh.connect (positions.size (), 1));
  const MeshComponents components = findComponents (mesh, 1);
  EXPECT_EQ (countPoints (mesh, components), (std::vector<std::size_t>{3, 3}));
  const std::vector<BoundaryLoop> loops =
      findBoundaryLoops (mesh, components, positions, std::vector<float> (7, 0.5F), 1);
  ASSERT_EQ (loops.size (), 2U);
  EXPECT_EQ (loops[0].points, (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ (loops[0].component, 1U);
  EXPECT_DOUBLE_EQ (loops[0].length, 12.0);
  EXPECT_EQ (loops[1].points, (std::vector<Index>{4, 5, 6}));
  EXPECT_EQ (loops[1].component, 0U);
}

} // namespace
} // namespace pcl::floater

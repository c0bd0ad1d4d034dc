// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/outliers.h"

#include "mesh_oracle.h"
#include "points/point_samples.h"

#include <gtest/gtest.h>

#include <limits>

namespace pcl::floater {
namespace {
using samples::asInput;
using samples::indices;
using samples::ON_A_MAP;
using samples::placed;
using samples::Positions;
using samples::surface;
using IndexList = std::vector<Index>;

constexpr double LARGEST_FLOAT = std::numeric_limits<float>::max ();
constexpr double LARGEST = std::numeric_limits<double>::max ();

Positions
operator+ (Positions a, const Positions& b)
{
  a.insert (a.end (), b.begin (), b.end ());
  return a;
}

// Rows from the first on that is no more of the surface.
IndexList
rowsFrom (std::size_t first, const Positions& cloud)
{
  const IndexList all = indices (cloud.size ());
  return {all.begin () + static_cast<std::ptrdiff_t> (first), all.end ()};
}

TEST (GrossOutliers, PointsOrdersOfMagnitudeAway)
{
  const Positions torus = placed (surface (SurfaceKind::TORUS, 1000), ON_A_MAP);
  const Positions cloud = torus + Positions{{1e10, 0, 0}, {0, 0, 0}, {5e5, 5.5e6, -1e8}, {0, 0, 0}};
  const GrossOutliers found = findGrossOutliers (cloud, 1);
  EXPECT_EQ (found.isolated, rowsFrom (1000, cloud));
  EXPECT_TRUE (found.unbearable.empty ());
}

TEST (GrossOutliers, PointsThatDoublePrecisionCannotHold)
{
  const Positions torus = surface (SurfaceKind::TORUS, 1000);
  Positions far;
  for (int i = 0; i < 50; ++i) // an object of their own, but for the distance
    far.emplace_back (LARGEST_FLOAT, i % 7, i);
  far.emplace_back (LARGEST, -LARGEST, 0.0);
  far.emplace_back (-LARGEST, 0.0, 0.0);
  const Positions cloud = torus + far;
  const GrossOutliers found = findGrossOutliers (cloud, 1);
  EXPECT_TRUE (found.isolated.empty ());
  EXPECT_EQ (found.unbearable, rowsFrom (1000, cloud));
}

TEST (GrossOutliers, ObjectsAndWidePartsAreNone)
{
  const Positions torus = surface (SurfaceKind::TORUS, 2000);
  const Positions terrain = surface (SurfaceKind::HEIGHT_FIELD, 2000);
  // A terrain around it that is a thousand times as wide and has a tenth of the points, and one
  // that is ten thousand times as wide.
  for (const Positions& cloud :
       {torus + placed (surface (SurfaceKind::HEIGHT_FIELD, 200), {0, 0, 0}, 3e3),
        torus + placed (surface (SurfaceKind::HEIGHT_FIELD, 2000), {0, 0, 0}, 1e4),
        terrain + torus}) {
    const GrossOutliers found = findGrossOutliers (cloud, 1);
    EXPECT_TRUE (found.isolated.empty ());
    EXPECT_TRUE (found.unbearable.empty ());
  }
  // Objects a million times their size apart, alike and not.
  for (const std::size_t points : {60U, 500U, 2000U})
    for (const double scale : {0.1, 1.0, 10.0}) {
      const Positions cloud =
          torus + placed (surface (SurfaceKind::TORUS, points), {-3e7, 1e7, 2e7}, scale);
      const GrossOutliers found = findGrossOutliers (cloud, 1);
      EXPECT_TRUE (found.isolated.empty ()) << points << " " << scale;
      EXPECT_TRUE (found.unbearable.empty ());
    }
}

TEST (GrossOutliers, MoreThanHalfMayBeCopiesOfOne)
{
  // Pixels without depth are (0, 0, 0): equal points, which are one point.
  const Positions cloud = Positions (3000, Eigen::Vector3d (0, 0, 0)) +
                          placed (surface (SurfaceKind::HEIGHT_FIELD, 1000), ON_A_MAP) +
                          Positions{{1e11, 0, 0}};
  const GrossOutliers found = findGrossOutliers (cloud, 1);
  EXPECT_EQ (found.isolated, (IndexList{4000}));
  EXPECT_TRUE (found.unbearable.empty ());
}

TEST (GrossOutliers, NoneInFewOrEqualPoints)
{
  for (const Positions& cloud :
       {Positions{}, Positions{{0, 0, 0}, {1, 0, 0}, {0, 1e30, 0}},
        Positions (100, Eigen::Vector3d (3, 4, 5)), Positions (100, Eigen::Vector3d (NAN, 0, 0)),
        Positions (100, Eigen::Vector3d (3, 4, 5)) + Positions{{1e10, 0, 0}}}) {
    const GrossOutliers found = findGrossOutliers (cloud, 1);
    EXPECT_TRUE (found.isolated.empty ());
    EXPECT_TRUE (found.unbearable.empty ());
  }
}

// The whole way: the mesh is that of the cloud without them.
TEST (GrossOutliers, LeaveTheMeshAsItIs)
{
  const Positions strays{{1e10, 2, 3}, {LARGEST_FLOAT, 0, 0}, {0, 0, 0}, {-LARGEST, LARGEST, 0}};
  for (const SurfaceKind kind : {SurfaceKind::TORUS, SurfaceKind::HEIGHT_FIELD}) {
    const Positions clean = placed (surface (kind, 3000), ON_A_MAP);
    const Positions cloud = clean + strays;
    const Result expected = reconstruct (asInput (clean), {});
    const Result result = reconstruct (asInput (cloud), {});
    ASSERT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
    EXPECT_EQ (result.triangles, expected.triangles);
    EXPECT_EQ (result.report.outliers, rowsFrom (3000, cloud));
    EXPECT_EQ (result.report.statistics.outlier_points, 4U);
    EXPECT_EQ (result.report.statistics.working_points, 3000U);
    ASSERT_EQ (result.report.warnings.size (), expected.report.warnings.size () + 1);
    EXPECT_EQ (result.report.warnings.front (),
               "4 points are over a thousand times as far away as all others, among them point "
               "3000: they were left out");
  }
}

TEST (GrossOutliers, AreAddedToTheOthers)
{
  Positions cloud = surface (SurfaceKind::TORUS, 3000);
  cloud.emplace_back (0, 0, 200);
  cloud.insert (cloud.begin (), {1e10, 0, 0});
  const Result result = reconstruct (asInput (cloud), {});
  ASSERT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
  EXPECT_EQ (result.report.outliers, (IndexList{0, 3001}));
  EXPECT_EQ (result.report.statistics.outlier_points, 2U);
  EXPECT_EQ (result.report.statistics.working_points, 3000U);
  EXPECT_EQ (result.report.warnings.size (), 2U);
}

TEST (GrossOutliers, StayIfOutliersAreToStay)
{
  Options options;
  options.remove_outliers = false;
  const Positions torus = surface (SurfaceKind::TORUS, 3000);
  const Result failed = reconstruct (asInput (torus + Positions{{LARGEST_FLOAT, 0, 0}}), options);
  EXPECT_EQ (failed.report.status, RunStatus::DEGENERATE);
  EXPECT_NE (failed.report.message.find ("point 3000"), std::string::npos);
  EXPECT_TRUE (failed.triangles.empty ());
  // Double precision can hold these.
  const Result result =
      reconstruct (asInput (torus + Positions{{1e8, 2e8, 0}, {-1e10, 0, 1e9}}), options);
  ASSERT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
  const samples::Topology topology = samples::topologyOf (result.triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_GE (topology.vertices, 3000U);
  EXPECT_TRUE (result.report.outliers.empty ());
}

TEST (GrossOutliers, AreNoQuarterOfTheCloud)
{
  const Positions cloud = surface (SurfaceKind::TORUS, 1000) +
                          placed (surface (SurfaceKind::TORUS, 600), {0, 0, 0}, 1e30);
  const Result result = reconstruct (asInput (cloud), {});
  EXPECT_EQ (result.report.status, RunStatus::DEGENERATE);
  EXPECT_NE (result.report.message.find ("double precision"), std::string::npos);
}

} // namespace
} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Points far away, alone, and those that are no measurements.
#include "points/outliers.h"

#include "points/neighbors.h"
#include "samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;
using IndexList = std::vector<Index>;

constexpr double LARGEST_FLOAT = std::numeric_limits<float>::max ();
constexpr double LARGEST = std::numeric_limits<double>::max ();

IndexList
lastOf (const Positions& positions, std::size_t count)
{
  const IndexList all = indices (positions.size ());
  return {all.end () - static_cast<std::ptrdiff_t> (count), all.end ()};
}

void
expectGross (const Positions& cloud, const IndexList& isolated, const IndexList& unbearable)
{
  const GrossOutliers found = findGrossOutliers (cloud, 1);
  EXPECT_EQ (found.isolated, isolated);
  EXPECT_EQ (found.unbearable, unbearable);
}

TEST (GrossOutliers, AreOrdersOfMagnitudeAway)
{
  const Positions cloud = joined (placed (surface (SurfaceKind::TORUS, 1000), ON_A_MAP),
                                  {{1e10, 0, 0}, {0, 0, 0}, {5e5, 5.5e6, -1e8}, {0, 0, 0}});
  expectGross (cloud, lastOf (cloud, 4), {});
  // Those that double precision cannot hold; some would be an object of their own.
  Positions far = surface (SurfaceKind::TORUS, 1000);
  for (int i = 0; i < 50; ++i)
    far.emplace_back (LARGEST_FLOAT, i % 7, i);
  far.emplace_back (LARGEST, -LARGEST, 0.0);
  far.emplace_back (-LARGEST, 0.0, 0.0);
  expectGross (far, {}, lastOf (far, 52));
  // Pixels without depth are (0, 0, 0): equal points, which are one point, even if they are most.
  expectGross (joined (joined (Positions (3000, Eigen::Vector3d (0, 0, 0)),
                               placed (surface (SurfaceKind::HEIGHT_FIELD, 1000), ON_A_MAP)),
                       Positions{{1e11, 0, 0}}),
               {4000}, {});
}

TEST (GrossOutliers, ObjectsAndWidePartsAreNone)
{
  const Positions torus = surface (SurfaceKind::TORUS, 2000);
  const Positions terrain = surface (SurfaceKind::HEIGHT_FIELD, 2000);
  const Eigen::Vector3d here (0, 0, 0), there (-3e7, 1e7, 2e7);
  // A terrain around it that is a thousand times as wide and has a tenth of the points, and one
  // that is ten thousand times as wide.
  std::vector<Positions> clouds{
      joined (torus, placed (surface (SurfaceKind::HEIGHT_FIELD, 200), here, 3e3)),
      joined (torus, placed (terrain, here, 1e4)), joined (terrain, torus)};
  // Objects a million times their size apart, alike and not.
  for (const std::size_t points : {60U, 500U, 2000U})
    for (const double scale : {0.1, 1.0, 10.0})
      clouds.push_back (
          joined (torus, placed (surface (SurfaceKind::TORUS, points), there, scale)));
  // Few or equal points.
  clouds.insert (clouds.end (),
                 {{},
                  {{0, 0, 0}, {1, 0, 0}, {0, 1e30, 0}},
                  Positions (100, Eigen::Vector3d (3, 4, 5)),
                  Positions (100, Eigen::Vector3d (NAN, 0, 0)),
                  joined (Positions (100, Eigen::Vector3d (3, 4, 5)), Positions{{1e10, 0, 0}})});
  for (std::size_t cloud = 0; cloud < clouds.size (); ++cloud) {
    SCOPED_TRACE (cloud);
    expectGross (clouds[cloud], {}, {});
  }
}

// The whole way: the mesh is that of the cloud without them. Other outliers are added to the list.
TEST (GrossOutliers, LeaveTheMeshAsItIs)
{
  const Positions strays{{1e10, 2, 3}, {LARGEST_FLOAT, 0, 0}, {0, 0, 0}, {-LARGEST, LARGEST, 0}};
  const Positions clean = placed (surface (SurfaceKind::HEIGHT_FIELD, 3000), ON_A_MAP);
  const Positions with_outlier =
      joined (clean, Positions{ON_A_MAP + Eigen::Vector3d (20, 20, 200)});
  for (const Positions& usual : {clean, with_outlier}) {
    const Positions cloud = joined (usual, strays);
    const Result expected = reconstruct (asInput (usual), {});
    const Result result = meshOf (cloud);
    EXPECT_EQ (result.triangles, expected.triangles);
    EXPECT_EQ (topologyOf (result.triangles).vertices, 3000U);
    EXPECT_EQ (result.report.outliers, lastOf (cloud, cloud.size () - 3000));
    EXPECT_EQ (result.report.statistics.outlier_points, cloud.size () - 3000);
    EXPECT_EQ (result.report.statistics.working_points, 3000U);
    ASSERT_EQ (result.report.warnings.size (), expected.report.warnings.size () + 1);
    EXPECT_EQ (result.report.warnings.front (),
               "4 points are over a thousand times as far away as all others, among them point " +
                   std::to_string (usual.size ()) + ": they were left out");
  }
}

TEST (GrossOutliers, StayIfOutliersAreToStay)
{
  Options options;
  options.remove_outliers = false;
  const Positions torus = surface (SurfaceKind::TORUS, 3000);
  // Double precision can hold these.
  const Result result = meshOf (joined (torus, {{1e8, 2e8, 0}, {-1e10, 0, 1e9}}), options);
  const MeshTopology topology = topologyOf (result.triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_GE (topology.vertices, 3000U);
  EXPECT_TRUE (result.report.outliers.empty ());
}

// The outliers in cloud indices.
IndexList
outliersOf (const Positions& positions, int k = 20, int threads = 1)
{
  Points points = workingPoints (positions);
  const CsrLists neighbors =
      findNearestNeighbors (points.positions, Rows::all (points.size ()), k, threads);
  return removePoints (points, findOutliers (points.positions, neighbors, threads));
}

// A square of points about 1 apart.
Positions
square (int side, std::uint64_t seed)
{
  RandomStream random (seed);
  return jitteredGrid (side, side, 1.0, 0.4, random);
}

// That there are none on surfaces of known topology is tested with the whole method. A dense side and a
// sparse side, in one plane, or with the sparse side upright on the border of
// the dense one. Then its lowest points have neighbours on the dense side only.
TEST (Outliers, NoneWhereTheDensityChangesAbruptly)
{
  for (const double ratio : {3.0, 5.5, 15.0})
    for (const bool upright : {false, true})
      for (const double jitter : {0.0, 0.3}) {
        SCOPED_TRACE (testing::Message () << ratio << ' ' << upright << ' ' << jitter);
        RandomStream random (3);
        const Positions dense =
            placed (jitteredGrid (29, 90, 1.0, jitter, random), {-29.0, 0.0, 0.0});
        Positions sparse = placed (
            jitteredGrid (7, static_cast<int> (std::ceil (90.0 / ratio)), ratio, jitter, random),
            {ratio, 0.0, 0.0});
        for (Eigen::Vector3d& p : sparse)
          if (upright)
            std::swap (p.x (), p.z ());
        EXPECT_TRUE (outliersOf (joined (dense, sparse)).empty ());
      }
}

TEST (Outliers, FlyingPixels)
{
  Positions points = square (60, 1);
  RandomStream random (7);
  std::size_t flying = 0;
  for (int x = 5; x < 60; x += 10)
    for (int y = 5; y < 60; y += 10, ++flying)
      points.emplace_back (x + random.uniform (), y + random.uniform (),
                           (flying % 2 == 0 ? 1.0 : -1.0) * (3.5 + 3.0 * random.uniform ()));
  EXPECT_EQ (outliersOf (points), lastOf (points, flying));
  EXPECT_EQ (outliersOf (points, 20, 3), lastOf (points, flying));
  EXPECT_EQ (outliersOf (points, 30), lastOf (points, flying));
  // The points of a whole second sheet at that height are no outliers.
  const std::size_t before = points.size ();
  for (const Index p : outliersOf (joined (points, placed (square (60, 2), {0.0, 0.0, 2.5}))))
    EXPECT_LT (p, before);
}

TEST (Outliers, SmallClustersFarAwayButNotSmallComponents)
{
  const Positions sheet = square (50, 1);
  for (const std::size_t count : {1U, 2U, 4U, 7U}) {
    SCOPED_TRACE (count);
    RandomStream random (count);
    Positions points = sheet;
    // Round lumps of points, the second in the plane of the sheet.
    for (const Eigen::Vector3d& centre :
         Positions{{25.0, 25.0, 20.0}, {80.0, 25.0, 0.0}, {-500.0, -300.0, 0.0}})
      for (std::size_t i = 0; i < count; ++i)
        points.emplace_back (centre + 0.3 * normalVector (random));
    EXPECT_EQ (outliersOf (points), lastOf (points, 3 * count));
  }
  // In the plane of the sheet, from 5 reaches of 1.3 spacings on.
  for (const double away : {4.5, 9.0}) {
    const Positions points = joined (sheet, {{49.0 + away, 25.0, 0.0}});
    EXPECT_EQ (outliersOf (points), lastOf (points, away > 6.5 ? 1 : 0)) << away;
  }
  for (const int rows : {3, 4, 5}) // of 4 points
    for (const double size : {1.0, 10.0, 100.0}) {
      SCOPED_TRACE (testing::Message () << rows << ' ' << size);
      RandomStream random (3);
      EXPECT_TRUE (outliersOf (joined (sheet, placed (jitteredGrid (4, rows, size, 0.3, random),
                                                      {100.0, 0.0, 7.0})))
                       .empty ());
    }
}

constexpr double NO_VALUE = -9999.0;

// A grid of heights around `level`, in map coordinates, of which some cells have another value.
Positions
heights (double level, double value)
{
  Positions points;
  for (int i = 0; i < 2500; ++i) {
    const int x = i % 50, y = i / 50;
    const bool is_lake = (x - 30) * (x - 30) + (y - 20) * (y - 20) < 60;
    points.emplace_back (451000.0 + 10.0 * x, 5273000.0 + 10.0 * y,
                         is_lake ? value : level + 8.0 * std::sin (0.1 * x) * std::cos (0.13 * y));
  }
  return points;
}

void
expectInvalid (const Positions& points, std::size_t pixels, std::size_t cells,
               const Eigen::Vector3d& shift = Eigen::Vector3d::Zero ())
{
  const InvalidPoints found = findInvalidPoints (points, shift);
  EXPECT_EQ (found.pixels.size (), pixels);
  EXPECT_EQ (found.cells.size (), cells);
}

TEST (InvalidPoints, PixelsWithoutReturn)
{
  const Eigen::Vector3d origin (0, 0, 0);
  for (const std::size_t side : {12U, 40U, 160U}) {
    SCOPED_TRACE (side);
    const Positions all = wallInView (side);
    Positions at_origin = all, near_it = all; // every fifth point
    RandomStream random (3);
    for (std::size_t i = 0; i < all.size (); i += 5) {
      at_origin[i] = origin;
      near_it[i] = 5e-3 * uniformVector (random);
    }
    const std::size_t fifth = (all.size () + 4) / 5;
    expectInvalid (all, 0, 0);
    expectInvalid (at_origin, fifth, 0);
    expectInvalid (near_it, fifth, 0);
    expectInvalid (placed (at_origin, ON_A_MAP), fifth, 0); // where the sensor was
    expectInvalid (placed (at_origin, -ON_A_MAP), fifth, 0, ON_A_MAP);
  }
  // Most points are.
  expectInvalid (joined (Positions (9000, origin), wallInView (40)), 9000, 0);
}

// The origin is on the surface, or a point of many is on a coarse lattice.
TEST (InvalidPoints, RepeatedPointsOfASurface)
{
  Positions disc, lattice, cone;
  for (int i = 0; i < 3000; ++i) {
    const double angle = i % 60 * 0.10472, radius = i / 60 * 0.02;
    disc.push_back (polar (radius, angle, 0.1 * radius));
    cone.emplace_back (Eigen::Vector3d (5, 5, 5) + disc.back ());
    lattice.emplace_back (std::round (3.0 * disc.back ().x ()),
                          std::round (3.0 * disc.back ().y ()), 0.0);
  }
  for (const Positions& points : {disc, cone, lattice})
    expectInvalid (points, 0, 0);
  // A cloud around the origin, and one in a file twice.
  const Positions torus = surface (SurfaceKind::TORUS, 1000);
  expectInvalid (torus, 0, 0);
  expectInvalid (joined (torus, torus), 0, 0);
  // A small thing in the middle of a large one.
  const Positions small = placed (surface (SurfaceKind::TORUS, 3000), {0, 0, 0}, 1e-4);
  expectInvalid (joined (small, torus), 0, 0);
  expectInvalid (joined (wallInView (100), placed (small, {0, 0, 0}, 30.0)), 0, 0);
}

TEST (InvalidPoints, CellsWithoutData)
{
  for (const double value : {NO_VALUE, -32767.0, -3.4028234663852886e38, 99999.0}) {
    SCOPED_TRACE (value);
    const InvalidPoints found = findInvalidPoints (heights (412.0, value), {0, 0, 0});
    EXPECT_GT (found.cells.size (), 100U);
    EXPECT_EQ (found.height, value);
  }
  EXPECT_GT (findInvalidPoints (heights (412.0, 0.0), {0, 0, 0}).cells.size (), 100U);
  const Eigen::Vector3d shift (451000.123, 5273000.7, -4700.3);
  EXPECT_GT (findInvalidPoints (placed (heights (412.0, NO_VALUE), -shift), shift).cells.size (),
             100U);
  // A lake at its own height, one at 0 near the sea, and boxes on a floor.
  expectInvalid (heights (412.0, 400.0), 0, 0);
  expectInvalid (heights (12.0, 0.0), 0, 0);
  Positions boxes = heights (0.0, 0.0);
  for (Eigen::Vector3d& p : boxes)
    p.z () = p.z () > 3.0 ? 500.0 : 0.0;
  expectInvalid (boxes, 0, 0);
}

} // namespace
} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Scans after a voxel filter: no rays are left that tell of the sensor.
#include "real_clouds.h"
#include "scan_samples.h"
#include "view/ray_evidence.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;

// The mean of the points in each cell of a grid.
Positions
filtered (const Positions& points, double side)
{
  std::map<std::array<long, 3>, std::pair<Eigen::Vector3d, double>> cells;
  for (const Eigen::Vector3d& point : points) {
    const auto cell = [&] (int axis) { return std::lround (point[axis] / side); };
    auto& [sum, count] =
        cells.try_emplace ({cell (0), cell (1), cell (2)}, Eigen::Vector3d::Zero (), 0.0)
            .first->second;
    sum += point;
    count += 1.0;
  }
  Positions means;
  for (const auto& entry : cells)
    means.emplace_back (entry.second.first / entry.second.second);
  return means;
}

TEST (FilteredScans, ASensorInTheFileDecidesWhereThePointsDoNotTell)
{
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Scan scan = scanScene (Raster::CAMERA, {0.01, 0.0}, seed);
    const Positions positions = filtered (scan.points, 0.12);
    Input input = asInput (positions);
    Eigen::Map<Eigen::Vector3d> (input.sensor_origin.data ()) = scan.viewpoint;
    const Result result = reconstruct (std::move (input), {});
    ASSERT_EQ (result.report.status, RunStatus::SUCCESS);
    Eigen::Vector2d area = Eigen::Vector2d::Zero (); // away from the sensor, towards it
    for (const auto& [a, b, c] : result.triangles) {
      const Eigen::Vector3d normal = areaVector (positions[a], positions[b], positions[c]);
      area[normal.dot (scan.viewpoint - positions[a]) > 0.0 ? 1 : 0] += normal.norm ();
    }
    EXPECT_GT (area[1], 0.95 * area.sum ()) << seed;
  }
}

// The yard around a sensor, moved.
Positions
filteredYard (std::uint64_t seed, const Eigen::Vector3d& aside)
{
  RandomStream random (seed);
  const std::vector<ScanRay> rays = raysInRings (Eigen::Vector3d::Zero (), 60, 500, -24.0, 0.7);
  return filtered (placed (castRays (courtyard (), rays, {}, random).points, aside), 0.12);
}

// Where the file does not tell, outlines do: from beside the sensor, balls and posts cover points behind them.
TEST (FilteredScans, OutlinesTellOfASensorInTheOrigin)
{
  const Viewpoint origin;
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    for (const Eigen::Vector3d& aside :
         {Eigen::Vector3d (0.0, 0.0, 0.0), Eigen::Vector3d (1.0, 0.0, 0.0),
          Eigen::Vector3d (0.0, 0.5, 0.5)}) {
      SCOPED_TRACE (testing::Message () << "seed " << seed << ", aside " << aside.transpose ());
      const bool is_there = aside.isZero ();
      const Positions points = filteredYard (seed, aside);
      EXPECT_EQ (areOutlinesClear (points, findRayPatches (points, origin, 1), origin, 1),
                 is_there);
      if (!is_there)
        continue;
      const Report report = meshOf (points).report;
      EXPECT_TRUE (report.is_view);
      EXPECT_TRUE (Eigen::Vector3d (report.viewpoint.data ()).isZero ());
    }
}

// Frames of depth cameras in the frame of the camera, one point for some 16 of them.
TEST (FilteredScans, OutlinesTellOfRealSensors)
{
  for (const auto& [name, side] : {std::pair{"sensor_table_rgb", 0.013},
                                   {"sensor_office", 0.037},
                                   {"sensor_desktop", 0.0063},
                                   {"raw_milk", 0.0029},
                                   {"raw_kinect_table", 0.0025},
                                   {"raw_kinect_table", 0.005}}) {
    const Positions frame = realCloud (name);
    if (frame.empty ())
      GTEST_SKIP () << NO_REAL_CLOUD;
    const Report report = meshOf (filtered (frame, side)).report;
    EXPECT_TRUE (report.is_view) << name;
    EXPECT_TRUE (Eigen::Vector3d (report.viewpoint.data ()).isZero ()) << name;
  }
}

// Rows on the ground look like one surface behind the other, but are lines.
TEST (FilteredScans, RowsAreNoOutlines)
{
  Positions rows;
  RandomStream random (1);
  for (double x = 3.0; x < 80.0; x *= 1.5)
    for (const Eigen::Vector3d& p : jitteredGrid (1, 200, 0.1, 0.3, random))
      rows.emplace_back (x + p.x (), p.y () - 10.0, -1.0);
  const Viewpoint origin;
  EXPECT_FALSE (areOutlinesClear (rows, findRayPatches (rows, origin, 1), origin, 1));
}

// What has no outline tells nothing.
TEST (FilteredScans, WithoutOutlinesNothingIsTold)
{
  const Viewpoint origin;
  const Positions wave = placed (surface (SurfaceKind::HEIGHT_FIELD, 5000), {0.0, 0.0, 100.0});
  EXPECT_FALSE (areOutlinesClear (wave, findRayPatches (wave, origin, 1), origin, 1));
}

} // namespace
} // namespace pcl::floater

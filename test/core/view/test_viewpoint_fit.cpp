// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The place of a sensor, from its rays alone.
#include "view/viewpoint_fit.h"

#include "scan_samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::Raster;
using samples::Scan;

// The room has a diagonal of 9: this is a three hundredth.
constexpr double NEAR_BY = 0.03;

TEST (ViewpointFit, AllRastersAreFittedToTheirPlace)
{
  for (const Raster raster :
       {Raster::CAMERA, Raster::RINGS, Raster::SPHERE, Raster::PARALLEL, Raster::LINES})
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const Scan scan = samples::scanScene (raster, {0.002, 0.0}, seed);
      RandomStream random (seed);
      Viewpoint viewpoint{scan.viewpoint, scan.is_far};
      const Eigen::Vector3d off (random.normal (), random.normal (), random.normal ());
      if (scan.is_far)
        viewpoint.place = (viewpoint.place + 0.01 * off.normalized ()).normalized ();
      else
        viewpoint.place += NEAR_BY * off.normalized ();
      for (int round = 0; round < 6; ++round)
        viewpoint = fitViewpoint (scan.points, findRayPatches (scan.points, viewpoint, {}, 1),
                                  viewpoint, round == 0, 1);
      EXPECT_LT ((viewpoint.place - scan.viewpoint).norm (), 1e-3)
          << static_cast<int> (raster) << ", seed " << seed;
    }
}

} // namespace
} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/ray_evidence.h"

#include "scan_samples.h"
#include "view/view_method.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::DepthNoise;
using samples::Positions;
using samples::Raster;
using samples::Scan;

Points
pointsOf (const Positions& positions)
{
  return makePoints (positions, samples::indices (positions.size ()), 1);
}

Viewpoint
inPoints (const Points& points, const Eigen::Vector3d& viewpoint, bool is_far)
{
  return {is_far ? viewpoint : Eigen::Vector3d ((viewpoint - points.centre) / points.scale),
          is_far};
}

bool
isSeen (const Positions& positions, const Eigen::Vector3d& viewpoint, bool is_far = false)
{
  const Points points = pointsOf (positions);
  return isSeenFrom (points, inPoints (points, viewpoint, is_far), {}, 2);
}

class RastersAndSeeds : public testing::TestWithParam<std::tuple<Raster, std::uint64_t>>
{
protected:
  Scan scan (DepthNoise noise) const
  {
    return samples::scanScene (std::get<0> (GetParam ()), noise, std::get<1> (GetParam ()));
  }
};

TEST_P (RastersAndSeeds, AScanIsSeenFromItsSensor)
{
  const Scan made = scan ({0.003, 0.0});
  EXPECT_TRUE (isSeen (made.points, made.viewpoint, made.is_far));
}

TEST_P (RastersAndSeeds, AScanIsNotSeenFromElsewhere)
{
  const Scan made = scan ({0.003, 0.0});
  if (made.is_far) {
    const Eigen::Vector3d aslant = made.viewpoint + 0.5 * made.viewpoint.unitOrthogonal ();
    EXPECT_FALSE (isSeen (made.points, aslant.normalized (), true));
  }
  else
    for (const Eigen::Vector3d& axis :
         {Eigen::Vector3d (1.5, 0.0, 0.0), Eigen::Vector3d (0.0, 1.5, 0.0),
          Eigen::Vector3d (0.0, 0.0, 1.5)})
      EXPECT_FALSE (isSeen (made.points, made.viewpoint + axis)) << axis.transpose ();
}

TEST_P (RastersAndSeeds, TheViewpointIsFound)
{
  // Areas must tell roughly where to look: noise of up to one and a half spacings of a camera's
  // pixels, or a third of those of rays in a ring.
  const Raster raster = std::get<0> (GetParam ());
  const bool is_hard = raster == Raster::RINGS || raster == Raster::PARALLEL;
  const Scan made = scan ({is_hard ? 0.001 : 0.01, 0.0});
  const Points points = pointsOf (made.points);
  StarSettings settings;
  settings.reach_beyond = true;
  const LocalPlanes planes =
      fitLocalPlanes (points, findNeighbors (points, {}, 2), std::nullopt, settings, 2);
  const std::vector<AreaSample> samples =
      takeAreaSamples (points, planes, settings, SearchLimits{}.samples, 2);
  std::optional<Viewpoint> found = findViewpoint (points, planes.neighbors, samples, {}, {}, 2);
  if (!found)
    found = findViewpointOfEven (points, planes.neighbors, samples, {}, {}, 2);
  ASSERT_TRUE (found);
  if (found->is_far)
    EXPECT_GT (std::abs (found->place.dot (made.viewpoint)), 0.999);
  else if (made.is_far) { // so far away that it makes no difference
    const Eigen::Vector3d offset =
        found->place - inPoints (points, made.points.front (), false).place;
    EXPECT_GT (offset.norm (), 5.0);
    EXPECT_GT (std::abs (offset.normalized ().dot (made.viewpoint)), 0.99);
  }
  else
    // Along rings, only the spacing within each tells.
    EXPECT_LT ((found->place - inPoints (points, made.viewpoint, false).place).norm (),
               raster == Raster::RINGS ? 0.06 : 0.01);
}

INSTANTIATE_TEST_SUITE_P (Scans, RastersAndSeeds,
                          testing::Combine (testing::Values (Raster::CAMERA, Raster::RINGS,
                                                             Raster::SPHERE, Raster::PARALLEL),
                                            testing::Range<std::uint64_t> (1, 6)));

TEST (RayEvidence, PointsAtRandomAreNotSeenFromAnywhere)
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random (seed);
    Positions points = samples::randomPoints (10000, seed);
    for (Eigen::Vector3d& p : points)
      p.z () = 0.1 * std::sin (6.0 * p.x ());
    const Eigen::Vector3d above (random.uniform (), random.uniform (), 0.5 + random.uniform ());
    EXPECT_FALSE (isSeen (points, above)) << seed;
  }
}

TEST (RayEvidence, AnEvenBallIsNotSeenFromItsCentre)
{
  constexpr int POINTS = 20000;
  Positions points;
  for (int i = 0; i < POINTS; ++i) {
    const double z = 1.0 - (2 * i + 1.0) / POINTS, angle = i * PI * (3.0 - std::sqrt (5.0));
    points.emplace_back (std::sqrt (1.0 - z * z) * std::cos (angle),
                         std::sqrt (1.0 - z * z) * std::sin (angle), z);
  }
  EXPECT_FALSE (isSeen (points, Eigen::Vector3d::Zero ()));
}

TEST (RayEvidence, APointAtTheViewpointDoesNotDisturb)
{
  Scan scan = samples::scanScene (Raster::CAMERA, {0.003, 0.0}, 1);
  scan.points.push_back (scan.viewpoint);
  EXPECT_TRUE (isSeen (scan.points, scan.viewpoint));
}

TEST (RayEvidence, FewPointsAreNoEvidence)
{
  for (const std::size_t count : {4U, 10U, 100U, 500U}) {
    const Positions points = samples::randomPoints (count, count);
    EXPECT_FALSE (isSeen (points, Eigen::Vector3d (0.5, 0.5, 3.0))) << count;
  }
}

} // namespace
} // namespace pcl::floater

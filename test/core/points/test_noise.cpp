// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/noise.h"

#include "points/nearest_neighbors.h"
#include "samples.h"
#include "surfaces.h"

#include <gtest/gtest.h>

namespace pcl
{
namespace floater
{
namespace
{
using samples::Positions;

Positions
surface (SurfaceKind kind, std::size_t points, double noise)
{
  SurfaceSpec spec;
  spec.kind = kind;
  spec.points = points;
  spec.noise = noise;
  return generateSurface (spec);
}

struct Cloud
{
  Points points;
  CsrLists neighbors;

  explicit Cloud (const Positions& positions, int k = 20)
      : points (makePoints (positions, samples::indices (positions.size ()), 1)),
        neighbors (findNearestNeighbors (points.positions, Rows::all (points.size ()), k, 1, 1))
  {
  }

  double noise (int threads = 1) const
  {
    return measureNoise (points.positions, neighbors, threads);
  }
  Positions projected (int threads = 1) const
  {
    return projectOntoPlanes (points.positions, neighbors, threads);
  }
};

TEST (Noise, TellsStrongNoiseFromNone)
{
  for (const SurfaceKind kind : surfaceKinds ()) {
    SCOPED_TRACE (surfaceName (kind));
    EXPECT_LT (Cloud (surface (kind, 3000, 0.0)).noise (), 0.05);
    EXPECT_LT (Cloud (surface (kind, 3000, 0.1)).noise (), 0.11);
    EXPECT_GT (Cloud (surface (kind, 3000, 0.3)).noise (), 0.19);
    EXPECT_GT (Cloud (surface (kind, 3000, 0.5)).noise (), 0.28);
  }
  EXPECT_TRUE (isStrongNoise (0.19, 3000));
  EXPECT_FALSE (isStrongNoise (0.11, 3000));
  EXPECT_FALSE (isStrongNoise (0.3, 200));
}

TEST (Noise, CurvatureAndEdgesAreNone)
{
  EXPECT_LT (Cloud (surface (SurfaceKind::SPHERE, 200, 0.0)).noise (), 0.02);
  Positions cube; // 9 points a side, no point farther than 4 spacings from an edge
  for (int x = 0; x <= 8; ++x)
    for (int y = 0; y <= 8; ++y)
      for (int z = 0; z <= 8; ++z)
        if (x % 8 == 0 || y % 8 == 0 || z % 8 == 0)
          cube.emplace_back (x, y, z);
  EXPECT_LT (Cloud (cube).noise (), 0.1);
}

TEST (Noise, DependsOnNothingElse)
{
  Positions positions = surface (SurfaceKind::TORUS, 5000, 0.2);
  const double noise = Cloud (positions).noise ();
  EXPECT_EQ (Cloud (positions).noise (3), noise);
  EXPECT_NEAR (Cloud (positions, 60).noise (), noise, 1e-12); // it takes the 20 nearest only
  std::reverse (positions.begin (), positions.end ());
  EXPECT_EQ (Cloud (positions).noise (), noise);
  const Eigen::AngleAxisd turn (1.0, Eigen::Vector3d (1.0, 2.0, 3.0).normalized ());
  for (Eigen::Vector3d& p : positions)
    p = 1e6 * (turn * p) + Eigen::Vector3d (1e5, 0.0, -1e6);
  EXPECT_NEAR (Cloud (positions).noise (), noise, 0.02 * noise); // other points are sampled
}

TEST (Noise, DegenerateClouds)
{
  EXPECT_EQ (measureNoise ({}, {}, 1), 0.0);
  EXPECT_TRUE (projectOntoPlanes ({}, {}, 1).empty ());
  for (const std::size_t count : {1U, 2U, 3U, 4U, 5U, 9U, 10U, 30U}) {
    Positions line;
    for (std::size_t i = 0; i < count; ++i)
      line.emplace_back (static_cast<double> (i), 0.0, 0.0);
    const Cloud cloud (line);
    EXPECT_NEAR (cloud.noise (), 0.0, 1e-6);
    const Positions projected = cloud.projected ();
    for (std::size_t p = 0; p < count; ++p)
      EXPECT_LT ((projected[p] - cloud.points.positions[p]).norm (), 1e-9);
    const double noise = Cloud (samples::randomPoints (count, count)).noise ();
    EXPECT_TRUE (std::isfinite (noise) && noise >= 0.0);
    for (const Eigen::Vector3d& p : Cloud (samples::randomPoints (count, count)).projected ())
      EXPECT_TRUE (p.allFinite ());
  }
}

// Root mean square distance to the unit sphere.
double
offSphere (const Positions& positions, const Points& points)
{
  double sum = 0.0;
  for (const Eigen::Vector3d& p : positions) {
    const double off = (points.centre + points.scale * p).norm () - 1.0;
    sum += off * off;
  }
  return std::sqrt (sum / static_cast<double> (positions.size ()));
}

TEST (Projection, TakesMostOfTheNoiseOut)
{
  RandomStream random (5);
  Positions sphere = surface (SurfaceKind::SPHERE, 4000, 0.0);
  const double spacing = std::sqrt (4.0 * samples::PI / 4000.0);
  for (Eigen::Vector3d& p : sphere)
    p = p.normalized () +
        0.4 * spacing * Eigen::Vector3d (random.normal (), random.normal (), random.normal ());
  const Cloud cloud (sphere);
  EXPECT_LT (offSphere (cloud.projected (), cloud.points),
             0.5 * offSphere (cloud.points.positions, cloud.points));
  EXPECT_EQ (cloud.projected (3), cloud.projected (1));
}

TEST (Projection, LeavesPlanesAndSharpEdges)
{
  Positions edge; // two walls of 40 by 20
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 20; ++j) {
      edge.emplace_back (i, j, 0.0);
      edge.emplace_back (i, 0.0, j + 1.0);
    }
  const Cloud cloud (edge);
  const Positions projected = cloud.projected ();
  for (std::size_t p = 0; p < projected.size (); ++p) {
    const Eigen::Vector3d before =
        cloud.points.centre + cloud.points.scale * cloud.points.positions[p];
    const double move = cloud.points.scale * (projected[p] - cloud.points.positions[p]).norm ();
    EXPECT_LT (move, std::max (before.y (), before.z ()) > 5.5 ? 1e-9 : 1.5);
  }
}

TEST (Projection, AnotherSheetDoesNotPull)
{
  RandomStream random (2);
  Positions sheets; // 2.5 spacings apart
  for (int x = 0; x < 30; ++x)
    for (int y = 0; y < 30; ++y) {
      sheets.emplace_back (x + 0.2 * random.uniform (), y, 0.1 * random.normal ());
      sheets.emplace_back (x, y + 0.2 * random.uniform (), 2.5 + 0.1 * random.normal ());
    }
  const Cloud cloud (sheets);
  for (const Eigen::Vector3d& projected : cloud.projected ()) {
    const Eigen::Vector3d p = cloud.points.centre + cloud.points.scale * projected;
    const bool at_border = p.head<2> ().minCoeff () < 2.5 || p.head<2> ().maxCoeff () > 26.5;
    EXPECT_LT (std::min (std::abs (p.z ()), std::abs (p.z () - 2.5)), at_border ? 1.25 : 0.25);
  }
}

TEST (Noise, SurfaceOfNoisyPoints)
{
  Options options;
  options.topology = Topology::SURFACE;
  const Positions torus = surface (SurfaceKind::TORUS, 4000, 0.5);
  const Result plain = [&] {
    Options without = options;
    without.denoise = false;
    return reconstruct (samples::asInput (torus), without);
  }();
  EXPECT_FALSE (plain.report.denoised);
  EXPECT_GT (plain.report.statistics.noise, 0.28);
  const Result result = reconstruct (samples::asInput (torus), options);
  EXPECT_TRUE (result.report.denoised);
  EXPECT_EQ (result.report.statistics.noise, plain.report.statistics.noise);
  EXPECT_FALSE (result.report.warnings.empty ());
  const samples::Topology topology = samples::topologyOf (result.triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (topology.vertices, torus.size ());
  EXPECT_EQ (topology.euler, 0);
  EXPECT_TRUE (topology.loops.empty ());
  EXPECT_FALSE (reconstruct (samples::asInput (surface (SurfaceKind::TORUS, 1000, 0.05)), options)
                    .report.denoised);
}

} // namespace
} // namespace floater
} // namespace pcl

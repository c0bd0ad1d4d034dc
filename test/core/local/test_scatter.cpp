// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Scatter: what is no surface is found, whatever its kind, and no point of a surface is.
#include "samples.h"

#include <pcl/surface/floater/reconstruct.h>

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;

// Strewn into a box, into a ball with the most in the middle, into clumps, on small leaves, and a
// jittered lattice.
enum class Strewn
{
  BOX,
  BALL,
  CLUMPS,
  LEAVES,
  LATTICE,
  COUNT
};

Positions
strewn (Strewn kind, std::size_t count, std::uint64_t seed)
{
  RandomStream random (seed);
  const auto normal = [&random] { return normalVector (random); };
  Positions positions = randomPoints (count, seed);
  const Positions centres = randomPoints (count / 8, seed + 1);
  const auto side = static_cast<std::size_t> (std::cbrt (static_cast<double> (count)));
  Eigen::Vector3d along = Eigen::Vector3d::UnitX (), across = Eigen::Vector3d::UnitY ();
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Vector3d& p = positions[i];
    if (kind == Strewn::BALL)
      p = normal ();
    else if (kind == Strewn::CLUMPS)
      p = centres[i % (count / 100)] + 0.05 * normal ();
    else if (kind == Strewn::LEAVES) {
      if (i % 8 == 0) {
        along = normal ().normalized ();
        across = along.cross (normal ()).normalized ();
      }
      p = centres[i / 8] + 0.01 * (random.normal () * along + random.normal () * across);
    }
    else if (kind == Strewn::LATTICE) {
      const std::size_t row = i / side, layer = row / side;
      p = Eigen::Vector3d (static_cast<double> (i % side), static_cast<double> (row % side),
                           static_cast<double> (layer)) +
          0.02 * normal ();
    }
  }
  return positions;
}

Report
reportOn (const Positions& positions, ScatterPolicy policy = ScatterPolicy::KEEP)
{
  Options options;
  options.threads = 1;
  options.scatter = policy;
  options.view.use = ViewUse::NEVER;
  options.remove_self_intersections = options.flip_edges = false; // nothing to be seen here
  return reconstruct (positions, options).report;
}

// Points on and around a sphere of radius 1, far enough apart that neither sees the other.
Positions
sphereAndBush (std::size_t on_sphere, std::size_t in_bush)
{
  return joined (surface (SurfaceKind::SPHERE, on_sphere),
                 placed (strewn (Strewn::BOX, in_bush, 4), {2.0, 0.0, 0.0}, 0.3));
}

TEST (Scatter, IsFoundWhateverItsKind)
{
  for (std::size_t kind = 0; kind < static_cast<std::size_t> (Strewn::COUNT); ++kind)
    for (const std::uint64_t seed : {1U, 2U}) {
      SCOPED_TRACE (kind);
      const std::size_t found =
          reportOn (strewn (static_cast<Strewn> (kind), 8000, seed)).scatter.size ();
      EXPECT_GE (found, 8000U * 97 / 100);
    }
}

TEST (Scatter, IsLeftOutUnlessItIsToBeKept)
{
  const Positions positions = sphereAndBush (6000, 1500);
  const Report kept = reportOn (positions, ScatterPolicy::KEEP);
  EXPECT_GE (kept.scatter.size (), 1450U);
  EXPECT_GE (kept.scatter.front (), 6000U); // all of the bush
  EXPECT_EQ (kept.statistics.scatter_points, kept.scatter.size ());
  EXPECT_GT (kept.statistics.used_points, 7000U);
  const auto isTold = [] (const Report& report) {
    return std::any_of (report.findings.begin (), report.findings.end (),
                        [] (const Finding& f) { return f.id == FindingId::SCATTER; });
  };
  EXPECT_FALSE (isTold (kept));
  for (const ScatterPolicy policy : {ScatterPolicy::AUTO, ScatterPolicy::DROP}) {
    const Report report = reportOn (positions, policy);
    EXPECT_EQ (report.scatter, kept.scatter); // it certainly is scatter
    EXPECT_EQ (report.statistics.working_points + report.scatter.size () + report.outliers.size (),
               positions.size ());
    EXPECT_LE (report.statistics.used_points, report.statistics.working_points);
    EXPECT_EQ (isTold (report), policy == ScatterPolicy::AUTO); // the other was asked for
  }
}

// Unless it is to be left out, what may be a detail stays.
TEST (Scatter, SmallBushesStay)
{
  EXPECT_TRUE (reportOn (sphereAndBush (6000, 120)).scatter.empty ());
  const Positions positions = sphereAndBush (6000, 400);
  EXPECT_TRUE (reportOn (positions, ScatterPolicy::AUTO).scatter.empty ());
  EXPECT_GT (reportOn (positions, ScatterPolicy::DROP).scatter.size (), 350U);
}

TEST (Scatter, SurfacesAreNoneHoweverNoisyOrThin)
{
  std::vector<std::pair<const char*, Positions>> clouds{
      {"small sphere", surface (SurfaceKind::SPHERE, 400)}};
  // Below its spacing, a wall is uneven, but stars agree. Of many, the balls between them tell the sides.
  RandomStream jitter (9);
  for (const auto& [thick, sheets] : {std::pair (0.5, 2), {1.0, 2}, {2.0, 2}, {1.6, 8}}) {
    clouds.push_back ({"walls", jitteredGrid (40, 40 * sheets, 1.0, 0.6, jitter)});
    for (Eigen::Vector3d& p : clouds.back ().second)
      p += std::floor (p.y () / 40.0) * Eigen::Vector3d (0.0, -40.0, thick);
  }
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    RandomStream random (seed);
    for (const double noise : {0.0, 0.3, 1.0}) {
      clouds.emplace_back ("plane", randomPoints (8000, seed));
      for (Eigen::Vector3d& p : clouds.back ().second)
        p.z () = noise / std::sqrt (8000.0) * random.normal ();
    }
    // Two balls, one in the other, look as uneven as leaves, but have two dimensions.
    clouds.push_back ({"shells", {}});
    for (const double radius : {1.0, 0.85})
      for (const Eigen::Vector3d& p : surface (SurfaceKind::SPHERE, 1000))
        clouds.back ().second.emplace_back (radius * (p + 0.3 * normalVector (random)));
    // In a ball of 320 points around any of theirs, three plates are hardly less than a volume.
    clouds.emplace_back ("plates", randomPoints (1500, seed));
    for (std::size_t i = 0; i < 1500; ++i) {
      Eigen::Vector3d& p = clouds.back ().second[i];
      p = Eigen::Vector3d (std::sqrt (500.0) * p.x (), std::sqrt (500.0) * p.y (),
                           2.5 * static_cast<double> (i % 3)) +
          0.3 * normalVector (random);
    }
  }
  for (const auto& [name, positions] : clouds)
    EXPECT_TRUE (reportOn (positions, ScatterPolicy::AUTO).scatter.empty ()) << name;
}

// A few points far behind a ball, ever farther apart, have most of the area; a coarse wall is one, and so is a
// noisy sheet that grows coarser.
TEST (Scatter, FarPointsAreUnlessTheyAreASurface)
{
  const Positions ball =
      placed (surface (SurfaceKind::SPHERE, 2000), Eigen::Vector3d::Zero (), 0.08); // radius 1
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    RandomStream random (seed);
    Positions strewn = ball, wall = ball;
    for (int i = 0; i < 200; ++i) {
      const double distance = 3.0 * std::pow (10.0, random.uniform ());
      strewn.emplace_back (distance * random.normal (), distance * random.normal (),
                           4.0 + distance);
      wall.emplace_back (i % 16 + 0.2 * random.uniform (), i / 16, 4.0 + 0.1 * random.normal ());
    }
    const Report report = reportOn (strewn, ScatterPolicy::AUTO);
    EXPECT_GE (report.scatter.size () + report.outliers.size (), 190U);
    EXPECT_TRUE (report.scatter.empty () || report.scatter.front () >= ball.size ());
    EXPECT_TRUE (reportOn (wall, ScatterPolicy::AUTO).scatter.empty ());
    Positions graded;
    for (int i = 0; i < 4000; ++i) { // noise of half a spacing
      const double distance = std::pow (100.0, random.uniform ()),
                   angle = 2.0 * PI * random.uniform ();
      graded.push_back (polar (distance, angle, 0.04 * distance * random.normal ()));
    }
    EXPECT_TRUE (reportOn (graded, ScatterPolicy::AUTO).scatter.empty ());
  }
}

} // namespace
} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The sample clouds that other tests rely on: points on their surface, evenly dense, the right
// number.
#include "surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace pcl::floater {
namespace {
using Points = std::vector<Eigen::Vector3d>;

constexpr double PI = 3.14159265358979323846;
constexpr double TOLERANCE = 1e-9; // of coordinates of up to about 100

SurfaceSpec
specOf (SurfaceKind kind, std::size_t points = 1500)
{
  SurfaceSpec spec;
  spec.kind = kind;
  spec.points = points;
  return spec;
}

// Distance from each point to its nearest other point.
std::vector<double>
nearestDistances (const Points& points)
{
  std::vector<double> nearest (points.size (), std::numeric_limits<double>::infinity ());
  for (std::size_t i = 0; i < points.size (); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double distance = (points[i] - points[j]).norm ();
      nearest[i] = std::min (nearest[i], distance);
      nearest[j] = std::min (nearest[j], distance);
    }
  return nearest;
}

TEST (Surfaces, AreSampledAsAskedForAndTheSameForTheSameSeedOnly)
{
  for (const SurfaceKind kind : surfaceKinds ()) {
    SCOPED_TRACE (surfaceName (kind));
    for (const std::size_t points : {1000U, 1001U, 1499U})
      EXPECT_EQ (generateSurface (specOf (kind, points)).size (), points);
    SurfaceSpec spec = specOf (kind);
    std::vector<double> nearest = nearestDistances (generateSurface (spec));
    EXPECT_GT (*std::min_element (nearest.begin (), nearest.end ()), 0.25);
    EXPECT_LT (*std::max_element (nearest.begin (), nearest.end ()), 1.6);

    spec.density_ratio = 25.0;
    nearest = nearestDistances (generateSurface (spec));
    std::sort (nearest.begin (), nearest.end ());
    const double dense = nearest[nearest.size () / 20];
    const double sparse = nearest[nearest.size () - 1 - nearest.size () / 200];
    EXPECT_GT (dense, 0.2);
    EXPECT_GT (sparse / dense, 3.0); // the spacings' ratio is 5 from end to end

    spec.noise = 0.1;
    const Points first = generateSurface (spec);
    EXPECT_EQ (generateSurface (spec), first);
    spec.seed = 2;
    EXPECT_NE (generateSurface (spec), first);
  }
}

// Of 1500 points, with a unit of area each.
TEST (Surfaces, PointsLieOnThem)
{
  const double sphere = std::sqrt (1500.0 / (4.0 * PI)),
               hemisphere = std::sqrt (1500.0 / (2.0 * PI)),
               finger = std::sqrt (1500.0 / (2.0 * PI * (1.0 + 6.0))),
               tube = std::sqrt (1500.0 / (10.0 * PI * PI));
  const auto check = [] (SurfaceKind kind, bool is_upper_half, const auto& off) {
    SCOPED_TRACE (surfaceName (kind));
    SurfaceSpec spec = specOf (kind);
    spec.length = 6.0;
    for (const Eigen::Vector3d& p : generateSurface (spec)) {
      EXPECT_NEAR (off (p), 0.0, TOLERANCE);
      EXPECT_TRUE (!is_upper_half || p.z () > -0.5);
    }
  };
  using Point = Eigen::Vector3d;
  check (SurfaceKind::SPHERE, false, [=] (const Point& p) { return p.norm () - sphere; });
  check (SurfaceKind::HEMISPHERE, true, [=] (const Point& p) { return p.norm () - hemisphere; });
  check (SurfaceKind::FINGER, true, [=] (const Point& p) { // a cylinder under a hemisphere
    return std::hypot (p.x (), p.y (), std::max (0.0, p.z () - 6.0 * finger)) - finger;
  });
  check (SurfaceKind::TORUS, false, [=] (const Point& p) {
    return std::hypot (std::hypot (p.x (), p.y ()) - 2.5 * tube, p.z ()) - tube;
  });
}

TEST (Surfaces, RefuseWhatMakesNoSense)
{
  const double nan = std::numeric_limits<double>::quiet_NaN ();
  const auto refuses = [] (auto SurfaceSpec::*member, auto value, SurfaceKind kind) {
    SurfaceSpec spec = specOf (kind);
    EXPECT_TRUE (surfaceSpecError (spec).empty ());
    spec.*member = value;
    EXPECT_FALSE (surfaceSpecError (spec).empty ()) << value;
    EXPECT_THROW (generateSurface (spec), std::invalid_argument);
  };
  refuses (&SurfaceSpec::points, MIN_SURFACE_POINTS - 1, SurfaceKind::SPHERE);
  for (const double ratio : {0.9, 101.0, nan})
    refuses (&SurfaceSpec::density_ratio, ratio, SurfaceKind::SPHERE);
  for (const double noise : {-0.1, nan})
    refuses (&SurfaceSpec::noise, noise, SurfaceKind::SPHERE);
  for (const double length : {-1.0, 1000.0})
    refuses (&SurfaceSpec::length, length, SurfaceKind::FINGER);
  for (const double gap : {0.0, 100.0})
    refuses (&SurfaceSpec::gap, gap, SurfaceKind::FOLDED_SHEET);
  for (const int holes : {-1, 200})
    refuses (&SurfaceSpec::holes, holes, SurfaceKind::CUT_OUT);
}

} // namespace
} // namespace pcl::floater

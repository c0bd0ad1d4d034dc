// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/invalid_points.h"

#include "points/point_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pcl::floater {
namespace {
using samples::joined;
using samples::ON_A_MAP;
using samples::placed;
using samples::Positions;
using samples::surface;

constexpr double NO_VALUE = -9999.0;

// What a sensor at the origin sees of a wavy wall.
Positions
frame (std::size_t side)
{
  Positions points;
  for (std::size_t i = 0; i < side * side; ++i) {
    const double x = static_cast<double> (i % side) / static_cast<double> (side) - 0.5;
    const double y = static_cast<double> (i / side) / static_cast<double> (side) - 0.5;
    points.push_back ((2.0 + 0.3 * std::sin (9.0 * x + 5.0 * y)) *
                      Eigen::Vector3d (x, y, 1.0).normalized ());
  }
  return points;
}

// Every fifth point is at a place, or near it.
Positions
withPlace (Positions points, const Eigen::Vector3d& place, double radius = 0.0)
{
  RandomStream random (3);
  for (std::size_t i = 0; i < points.size (); i += 5)
    points[i] = place + radius * Eigen::Vector3d (random.uniform (), random.uniform (), 0.0);
  return points;
}

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
    const Positions all = frame (side);
    const std::size_t fifth = (all.size () + 4) / 5;
    expectInvalid (all, 0, 0);
    expectInvalid (withPlace (all, origin), fifth, 0);
    expectInvalid (withPlace (all, origin, 5e-3), fifth, 0);
    expectInvalid (placed (withPlace (all, origin), ON_A_MAP), fifth, 0); // where the sensor was
    expectInvalid (placed (withPlace (all, origin), -ON_A_MAP), fifth, 0, ON_A_MAP);
  }
  // Most points are.
  expectInvalid (joined (Positions (9000, origin), frame (40)), 9000, 0);
}

// The origin is on the surface, or a point of many is on a coarse lattice.
TEST (InvalidPoints, RepeatedPointsOfASurface)
{
  Positions disc, lattice, cone;
  for (int i = 0; i < 3000; ++i) {
    const double angle = i % 60 * 0.10472, radius = i / 60 * 0.02;
    disc.emplace_back (radius * std::cos (angle), radius * std::sin (angle), 0.1 * radius);
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
  Positions small = surface (SurfaceKind::TORUS, 3000);
  for (Eigen::Vector3d& p : small)
    p *= 1e-4;
  expectInvalid (joined (small, torus), 0, 0);
  Positions room = frame (100);
  for (const Eigen::Vector3d& p : surface (SurfaceKind::TORUS, 3000))
    room.push_back (0.003 * p);
  expectInvalid (room, 0, 0);
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

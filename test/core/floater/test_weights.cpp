// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/weights.h"

#include "core/geometry.h"
#include "random_stream.h"
#include "triangulated_grid.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace pcl::floater {
namespace {
using Star = std::vector<Eigen::Vector2d>;
constexpr Weighting ALL_WEIGHTINGS[] = {Weighting::UNIFORM, Weighting::INVERSE_DISTANCE,
                                        Weighting::SHAPE_PRESERVING, Weighting::MEAN_VALUE};

std::vector<double>
weigh (const Star& star, Weighting weighting, bool open = false)
{
  Stars stars;
  stars.neighbors.offsets = {0, static_cast<Index> (star.size ())};
  stars.neighbors.ids.resize (star.size ());
  std::iota (stars.neighbors.ids.begin (), stars.neighbors.ids.end (), Index{1});
  stars.offsets_in_plane = star;
  stars.open = {static_cast<std::uint8_t> (open)};
  return computeWeights (stars, weighting, 1);
}

Eigen::Vector2d
direction (double angle)
{
  return {std::cos (angle), std::sin (angle)};
}

// 3 neighbours or more; distances vary by two orders of magnitude, and no sector is nearly half a
// turn.
Star
randomClosedStar (RandomStream& random, std::size_t most)
{
  for (;;) {
    std::vector<double> angles (3 + random.below (most - 2));
    for (double& angle : angles)
      angle = 2.0 * PI * random.uniform ();
    std::sort (angles.begin (), angles.end ());
    double widest = angles.front () + 2.0 * PI - angles.back ();
    for (std::size_t i = 1; i < angles.size (); ++i)
      widest = std::max (widest, angles[i] - angles[i - 1]);
    if (widest > PI - 0.05)
      continue;
    Star star;
    for (const double angle : angles)
      star.push_back (std::pow (10.0, -2.0 * random.uniform ()) * direction (angle));
    return star;
  }
}

void
expectPositiveSummingToOne (const std::vector<double>& weights)
{
  double sum = 0.0;
  for (const double weight : weights) {
    EXPECT_GT (weight, 0.0);
    EXPECT_TRUE (std::isfinite (weight));
    sum += weight;
  }
  EXPECT_NEAR (sum, 1.0, 1e-15 * static_cast<double> (weights.size ()));
}

// Distance of the weighted mean of the neighbours from the centre, relative to the longest offset.
double
centreError (const Star& star, const std::vector<double>& weights)
{
  Eigen::Vector2d mean = Eigen::Vector2d::Zero ();
  double longest = 0.0;
  for (std::size_t i = 0; i < star.size (); ++i) {
    mean += weights[i] * star[i];
    longest = std::max (longest, star[i].norm ());
  }
  return mean.norm () / longest;
}

void
normalize (std::vector<double>& weights)
{
  const double sum = std::accumulate (weights.begin (), weights.end (), 0.0);
  for (double& weight : weights)
    weight /= sum;
}

// Equations (2) and (3) of TW 385 as they are printed.
std::vector<double>
meanValueAsPrinted (const Star& star, bool open)
{
  std::vector<double> weights (star.size (), 0.0);
  for (std::size_t i = 0; i < star.size () - (open ? 1 : 0); ++i) {
    const std::size_t j = (i + 1) % star.size ();
    const double cosine = star[i].dot (star[j]) / (star[i].norm () * star[j].norm ());
    const double tangent = std::sqrt ((1.0 - cosine) / (1.0 + cosine));
    weights[i] += tangent / star[i].norm ();
    weights[j] += tangent / star[j].norm ();
  }
  normalize (weights);
  return weights;
}

// Shape preserving weights (Floater 1997), found by trying every edge for every neighbour.
std::vector<double>
shapePreservingBySearch (const Star& star)
{
  std::vector<double> weights (star.size (), 0.0);
  for (std::size_t i = 0; i < star.size (); ++i) {
    double best = -std::numeric_limits<double>::max ();
    std::size_t best_r = 0;
    Eigen::Vector3d best_coordinates = Eigen::Vector3d::Zero ();
    for (std::size_t r = 0; r < star.size (); ++r) {
      const std::size_t s = (r + 1) % star.size ();
      if (r == i || s == i)
        continue;
      Eigen::Vector3d coordinates (cross (star[r], star[s]), cross (star[s], star[i]),
                                   cross (star[i], star[r]));
      coordinates /= coordinates.sum ();
      if (coordinates.minCoeff () > best) {
        best = coordinates.minCoeff ();
        best_r = r;
        best_coordinates = coordinates;
      }
    }
    weights[i] += best_coordinates[0];
    weights[best_r] += best_coordinates[1];
    weights[(best_r + 1) % star.size ()] += best_coordinates[2];
  }
  normalize (weights);
  return weights;
}

void
expectNear (const std::vector<double>& actual, const std::vector<double>& expected,
            double tolerance)
{
  ASSERT_EQ (actual.size (), expected.size ());
  for (std::size_t i = 0; i < actual.size (); ++i)
    EXPECT_NEAR (actual[i], expected[i], tolerance) << "neighbour " << i;
}

TEST (Weights, OfRandomStars)
{
  RandomStream random (1);
  for (int round = 0; round < 1000; ++round) {
    const Star star = randomClosedStar (random, round % 10 == 0 ? 120 : 12);
    const Eigen::Rotation2Dd turn (2.0 * PI * random.uniform ());
    for (const Weighting weighting : ALL_WEIGHTINGS) {
      const std::vector<double> weights = weigh (star, weighting);
      expectPositiveSummingToOne (weights);
      expectPositiveSummingToOne (weigh (star, weighting, true));
      for (const double scale : {1e-120, 3.0, 1e120}) {
        Star moved;
        for (const Eigen::Vector2d& offset : star)
          moved.emplace_back (turn * (scale * offset));
        expectNear (weigh (moved, weighting), weights, 1e-9);
      }
    }
    for (const bool open : {false, true})
      expectNear (weigh (star, Weighting::MEAN_VALUE, open), meanValueAsPrinted (star, open), 1e-9);
    const std::vector<double> preserving = weigh (star, Weighting::SHAPE_PRESERVING);
    expectNear (preserving, shapePreservingBySearch (star), 1e-9);
    EXPECT_LT (centreError (star, preserving), 1e-9);
    EXPECT_LT (centreError (star, weigh (star, Weighting::MEAN_VALUE)), 1e-9);
  }
}

TEST (Weights, UniformIgnoresLengthsAndInverseDistanceUsesThem)
{
  const Star star{{1.0, 0.0}, {0.0, 2.0}, {-4.0, 0.0}, {0.0, -8.0}};
  expectNear (weigh (star, Weighting::UNIFORM), {0.25, 0.25, 0.25, 0.25}, 0.0);
  expectNear (weigh (star, Weighting::INVERSE_DISTANCE),
              {8.0 / 15.0, 4.0 / 15.0, 2.0 / 15.0, 1.0 / 15.0}, 1e-15);
}

// The centre lies on the segment between two neighbours, or by rounding just beside it.
TEST (Weights, StayFiniteInASectorOfHalfATurn)
{
  for (const double lift : {0.0, 1e-17, -1e-17, 1e-12, -1e-12}) {
    const Star star{{1.0, 0.0}, {0.5, 1.0}, {-0.25, 0.75}, {-2.0, lift}};
    for (const Weighting weighting : {Weighting::MEAN_VALUE, Weighting::SHAPE_PRESERVING}) {
      const std::vector<double> weights = weigh (star, weighting);
      expectPositiveSummingToOne (weights);
      EXPECT_LT (centreError (star, weights), 1e-7) << lift;
      EXPECT_NEAR (weights[0], 2.0 / 3.0, 1e-7) << lift;
      EXPECT_NEAR (weights[3], 1.0 / 3.0, 1e-7) << lift;
      EXPECT_GE (*std::min_element (weights.begin (), weights.end ()), 1e-11) << lift;
    }
  }
}

TEST (Weights, GetNoTermFromTheGapOfAnOpenStar)
{
  // Half a regular octagon: three sectors of 45 degrees. Each end is in one of them, each other
  // neighbour in two.
  Star star;
  for (int i = 0; i < 4; ++i)
    star.push_back (direction (i * PI / 4.0));
  const std::vector<double> expected{1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
  expectNear (weigh (star, Weighting::MEAN_VALUE, true), expected, 1e-15);
  expectNear (weigh (star, Weighting::SHAPE_PRESERVING, true), expected, 1e-15);
}

TEST (Weights, OfDegenerateStarsArePositive)
{
  const double huge = 1e200, infinite = std::numeric_limits<double>::infinity ();
  const std::vector<Star> degenerate{
      {{1.0, 0.0}},                                       // one neighbour
      {{1.0, 0.0}, {-1.0, 0.0}},                          // two, opposite
      {{1.0, 0.0}, {2.0, 0.0}, {3.0, 0.0}},               // all in one direction
      {{1.0, 0.0}, {-1.0, 0.0}, {-2.0, 0.0}},             // all on one line
      {{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}},               // no extent
      {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {-1.0, -1.0}}, // one on the centre
      {{1e-300, 0.0}, {1.0, 1.0}, {-1.0, 0.5}, {0.0, -1.0}},
      {{1e-200, 0.0}, {0.0, 1e-200}, {-1e-200, -1e-200}}, // squares underflow
      {{huge, 0.0}, {0.0, huge}, {-huge, -huge}},         // squares overflow
      {{infinite, 0.0}, {0.0, 1.0}, {-1.0, -1.0}}};
  for (std::size_t i = 0; i < degenerate.size (); ++i)
    for (const Weighting weighting : ALL_WEIGHTINGS)
      for (const bool open : {false, true}) {
        SCOPED_TRACE (testing::Message () << "star " << i << " weighting "
                                          << static_cast<int> (weighting) << " open " << open);
        expectPositiveSummingToOne (weigh (degenerate[i], weighting, open));
      }
}

TEST (Weights, OfNoPointAndOnSeveralThreads)
{
  EXPECT_TRUE (weigh ({}, Weighting::MEAN_VALUE, true).empty ());
  EXPECT_TRUE (computeWeights (Stars{}, Weighting::MEAN_VALUE, 2).empty ());
  const TriangulatedGrid grid (60, 0.12, 6);
  for (const Weighting weighting : ALL_WEIGHTINGS)
    EXPECT_EQ (computeWeights (grid.stars, weighting, 1),
               computeWeights (grid.stars, weighting, 3));
}

// All points of a grid around its centre: up to three lie in one direction, and others are exactly
// opposite. The grid is rotated, so that rounding changes their order.
TEST (Weights, OfAllNeighborsOfAGridReproduceTheCentre)
{
  RandomStream random (7);
  for (int round = 0; round < 50; ++round) {
    const Eigen::Rotation2Dd turn (round == 0 ? 0.0 : 2.0 * PI * random.uniform ());
    Star star;
    for (int x = -3; x <= 3; ++x)
      for (int y = -3; y <= 3; ++y)
        if (x != 0 || y != 0)
          star.emplace_back (turn * Eigen::Vector2d (x, y));
    std::sort (star.begin (), star.end (), [] (const auto& a, const auto& b) {
      return std::atan2 (a.y (), a.x ()) < std::atan2 (b.y (), b.x ());
    });
    for (const Weighting weighting : {Weighting::MEAN_VALUE, Weighting::SHAPE_PRESERVING}) {
      const std::vector<double> weights = weigh (star, weighting);
      expectPositiveSummingToOne (weights);
      EXPECT_LT (centreError (star, weights), 1e-8) << round;
      EXPECT_GT (*std::min_element (weights.begin (), weights.end ()), 1e-3) << round;
    }
    // The weights of (1, 0), (2, 0) and (3, 0) are as one over their distances.
    const std::vector<double> weights = weigh (star, Weighting::MEAN_VALUE);
    for (std::size_t i = 0; i < star.size (); ++i)
      for (std::size_t j = 0; j < star.size (); ++j)
        if ((star[i] - 3.0 * star[j]).norm () < 1e-9) {
          EXPECT_NEAR (weights[j], 3.0 * weights[i], 1e-8);
        }
  }
}

} // namespace
} // namespace pcl::floater

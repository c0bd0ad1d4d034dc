// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Weights of stars in the linear system.
#include "floater/weights.h"

#include "core/geometry.h"
#include "samples.h"

#include <gtest/gtest.h>

#include <limits>

namespace pcl::floater {
namespace {
using Places = std::vector<Eigen::Vector2d>;

constexpr Weighting ALL_WEIGHTINGS[] = {Weighting::UNIFORM, Weighting::INVERSE_DISTANCE,
                                        Weighting::SHAPE_PRESERVING, Weighting::MEAN_VALUE};

std::vector<double>
weigh (const Places& star, Weighting weighting, bool open = false)
{
  Stars stars;
  stars.neighbors.offsets = {0, static_cast<Index> (star.size ())};
  stars.neighbors.ids = samples::indices (star.size ());
  stars.offsets_in_plane = star;
  stars.open = {static_cast<std::uint8_t> (open)};
  return computeWeights (stars, weighting, 1);
}

// 3 neighbours or more; distances vary by two orders of magnitude, and no sector is nearly half a
// turn.
Places
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
    Places star;
    for (const double angle : angles)
      star.push_back (std::pow (10.0, -2.0 * random.uniform ()) *
                      Eigen::Vector2d (std::cos (angle), std::sin (angle)));
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
centreError (const Places& star, const std::vector<double>& weights)
{
  Eigen::Vector2d mean = Eigen::Vector2d::Zero ();
  double longest = 0.0;
  for (std::size_t i = 0; i < star.size (); ++i) {
    mean += weights[i] * star[i];
    longest = std::max (longest, star[i].norm ());
  }
  return mean.norm () / longest;
}

// Equations (2) and (3) of TW 385 as they are printed.
std::vector<double>
meanValueAsPrinted (const Places& star, bool open)
{
  std::vector<double> weights (star.size (), 0.0);
  for (std::size_t i = 0; i < star.size () - (open ? 1 : 0); ++i) {
    const std::size_t j = (i + 1) % star.size ();
    const double cosine = star[i].dot (star[j]) / (star[i].norm () * star[j].norm ());
    const double tangent = std::sqrt ((1.0 - cosine) / (1.0 + cosine));
    weights[i] += tangent / star[i].norm ();
    weights[j] += tangent / star[j].norm ();
  }
  const double sum = std::accumulate (weights.begin (), weights.end (), 0.0);
  for (double& weight : weights)
    weight /= sum;
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
    const Places star = randomClosedStar (random, round % 10 == 0 ? 120 : 12);
    const Eigen::Rotation2Dd turn (2.0 * PI * random.uniform ());
    for (const Weighting weighting : ALL_WEIGHTINGS) {
      const std::vector<double> weights = weigh (star, weighting);
      expectPositiveSummingToOne (weights);
      expectPositiveSummingToOne (weigh (star, weighting, true));
      for (const double scale : {1e-120, 3.0, 1e120}) {
        Places moved;
        for (const Eigen::Vector2d& offset : star)
          moved.emplace_back (turn * (scale * offset));
        expectNear (weigh (moved, weighting), weights, 1e-9);
      }
    }
    for (const bool open : {false, true})
      expectNear (weigh (star, Weighting::MEAN_VALUE, open), meanValueAsPrinted (star, open), 1e-9);
    for (const Weighting weighting : {Weighting::SHAPE_PRESERVING, Weighting::MEAN_VALUE})
      EXPECT_LT (centreError (star, weigh (star, weighting)), 1e-9);
  }
}

TEST (Weights, OfKnownStars)
{
  const Places star{{1.0, 0.0}, {0.0, 2.0}, {-4.0, 0.0}, {0.0, -8.0}};
  expectNear (weigh (star, Weighting::UNIFORM), {0.25, 0.25, 0.25, 0.25}, 0.0);
  expectNear (weigh (star, Weighting::INVERSE_DISTANCE),
              {8.0 / 15.0, 4.0 / 15.0, 2.0 / 15.0, 1.0 / 15.0}, 1e-15);
  // Each neighbour has 0.8 or 0.2 of the centre, and the opposite one has the rest.
  expectNear (weigh (star, Weighting::SHAPE_PRESERVING), {0.4, 0.4, 0.1, 0.1}, 1e-9);
  // Three in one direction share their tangents, so that none of them is left out.
  const Places shared{{1.0, 0.0}, {2.0, 0.0}, {3.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}};
  expectNear (weigh (shared, Weighting::MEAN_VALUE),
              {6.0 / 65.0, 3.0 / 65.0, 2.0 / 65.0, 18.0 / 65.0, 18.0 / 65.0, 18.0 / 65.0}, 1e-9);
  const std::vector<double> preserving = weigh (shared, Weighting::SHAPE_PRESERVING);
  EXPECT_LT (centreError (shared, preserving), 1e-8);
  EXPECT_GT (*std::min_element (preserving.begin (), preserving.end ()), 1e-3);
  // Half a regular octagon: three sectors of 45 degrees. Each end is in one of them, each other
  // neighbour in two; the gap gives no term.
  const double half = std::sqrt (0.5);
  const Places open{{1.0, 0.0}, {half, half}, {0.0, 1.0}, {-half, half}};
  for (const Weighting weighting : {Weighting::MEAN_VALUE, Weighting::SHAPE_PRESERVING})
    expectNear (weigh (open, weighting, true), {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0}, 1e-15);
}

TEST (Weights, OfDegenerateStarsArePositive)
{
  const double huge = 1e200, infinite = std::numeric_limits<double>::infinity ();
  const std::vector<Places> degenerate{
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
  EXPECT_TRUE (weigh ({}, Weighting::MEAN_VALUE, true).empty ());
  EXPECT_TRUE (computeWeights (Stars{}, Weighting::MEAN_VALUE, 2).empty ());
}

} // namespace
} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Weights of stars in the linear system, and the triangulation of the parameters.
#include "floater/weights.h"

#include "core/geometry.h"
#include "floater/planar_delaunay.h"
#include "options/option_rows.h"
#include "samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;

using Places = std::vector<Eigen::Vector2d>;

std::vector<double>
weigh (const Places& star, Weighting weighting, bool open = false)
{
  Stars stars;
  stars.neighbors.offsets = {0, static_cast<Index> (star.size ())};
  stars.neighbors.ids = indices (star.size ());
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
    if (widestGap (angles) > PI - 0.05)
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
    for (const auto& [name, weighting] : WEIGHTING_CHOICES) {
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
    for (const bool open : {false, true}) {
      // Equations (2) and (3) of TW 385 as they are printed.
      std::vector<double> printed (star.size (), 0.0);
      for (std::size_t i = 0; i < star.size () - (open ? 1 : 0); ++i) {
        const std::size_t j = (i + 1) % star.size ();
        const double cosine = star[i].dot (star[j]) / (star[i].norm () * star[j].norm ());
        const double tangent = std::sqrt ((1.0 - cosine) / (1.0 + cosine));
        printed[i] += tangent / star[i].norm ();
        printed[j] += tangent / star[j].norm ();
      }
      const double sum = std::accumulate (printed.begin (), printed.end (), 0.0);
      for (double& weight : printed)
        weight /= sum;
      expectNear (weigh (star, Weighting::MEAN_VALUE, open), printed, 1e-9);
    }
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
    for (const auto& [name, weighting] : WEIGHTING_CHOICES)
      for (const bool open : {false, true}) {
        SCOPED_TRACE (testing::Message ()
                      << "star " << i << " weighting " << name << " open " << open);
        expectPositiveSummingToOne (weigh (degenerate[i], weighting, open));
      }
  EXPECT_TRUE (weigh ({}, Weighting::MEAN_VALUE, true).empty ());
  EXPECT_TRUE (computeWeights (Stars{}, Weighting::MEAN_VALUE, 2).empty ());
}

// First the points of the hull in order, then points inside.
struct Sites
{
  Places uv;
  std::vector<Index> loop;
};

Sites
inCircle (std::size_t hull, std::size_t inside, std::uint64_t seed)
{
  RandomStream random (seed);
  Sites sites;
  for (std::size_t i = 0; i < hull; ++i) {
    const double angle = 2.0 * PI * static_cast<double> (i) / static_cast<double> (hull);
    sites.uv.emplace_back (std::cos (angle), std::sin (angle));
    sites.loop.push_back (static_cast<Index> (i));
  }
  const double inner = 0.999 * std::cos (PI / static_cast<double> (hull));
  while (sites.uv.size () < hull + inside) {
    const Eigen::Vector2d p (2.0 * random.uniform () - 1.0, 2.0 * random.uniform () - 1.0);
    if (p.norm () < inner)
      sites.uv.push_back (p);
  }
  return sites;
}

// Expects a mesh of all points but so many, with the loop as its boundary. That circumcircles are
// empty is checked for the whole method (test_reconstruct.cpp).
void
expectMesh (const Sites& sites, const TriangleMesh& mesh, std::size_t dropped)
{
  TriangleMesh fresh;
  fresh.triangles = mesh.triangles;
  ASSERT_TRUE (fresh.connect (sites.uv.size (), 1));
  EXPECT_EQ (fresh.neighbors, mesh.neighbors);
  const std::size_t vertices = sites.uv.size () - dropped;
  const MeshTopology topology = expectTopology (mesh.triangles, vertices, 1, 1, 1);
  EXPECT_EQ (mesh.triangles.size (), 2 * vertices - 2 - sites.loop.size ());
  ASSERT_EQ (topology.loops.size (), 1U);
  std::vector<Index> loop = topology.loops.front (); // directed: the surface is on its left
  std::rotate (loop.begin (), std::find (loop.begin (), loop.end (), sites.loop.front ()),
               loop.end ());
  EXPECT_EQ (loop, sites.loop);
  for (const auto& [a, b, c] : mesh.triangles)
    EXPECT_GT (cross (sites.uv[b] - sites.uv[a], sites.uv[c] - sites.uv[a]), 0.0);
}

TEST (PlanarDelaunay, IsBoundedByTheLoop)
{
  for (const std::size_t hull : {3U, 4U, 5U, 40U, 100U})
    for (const std::size_t inside : {0U, 300U}) {
      const Sites sites = inCircle (hull, inside, hull);
      expectMesh (sites, triangulatePlane (sites.uv, sites.loop), 0);
      if (inside == 0)
        continue;
      // The same of the hull, whatever it is; a twin and a point that is nowhere have no triangle.
      Sites places = sites;
      places.uv.push_back (sites.uv.back ());
      places.uv.emplace_back (std::nan (""), 0.5);
      expectMesh (places, triangulateHull (places.uv), 2);
    }
}

TEST (PlanarDelaunay, OfCoincidentPointsOneIsAVertexAndThatOfTheLoopIfThereIs)
{
  Sites sites = inCircle (30, 100, 4);
  for (const std::size_t at : {50U, 50U, 77U, 0U, 12U, 29U})
    sites.uv.push_back (sites.uv[at]);
  const TriangleMesh mesh = triangulatePlane (sites.uv, sites.loop);
  expectMesh (sites, mesh, 6);
  EXPECT_EQ (std::count (mesh.triangle_of.begin (), mesh.triangle_of.end (), NONE), 6);
  // Also if it has the larger index.
  std::reverse (sites.uv.begin (), sites.uv.end ());
  for (Index& p : sites.loop)
    p = static_cast<Index> (sites.uv.size ()) - 1 - p;
  expectMesh (sites, triangulatePlane (sites.uv, sites.loop), 6);
}

TEST (PlanarDelaunay, PointsWithoutParametersAndOnOrBeyondTheLoopAreLeftOut)
{
  Sites sites = inCircle (20, 50, 7);
  const double nan = std::numeric_limits<double>::quiet_NaN ();
  sites.uv[33] = {nan, nan};
  sites.uv[60].y () = nan;
  sites.uv[30] = 1.001 * 0.5 * (sites.uv[3] + sites.uv[4]);
  sites.uv[40] = 1.5 * sites.uv[7];
  sites.uv[50] = {0.5 * (sites.uv[0].x () + sites.uv[10].x ()), 1.0};
  const TriangleMesh mesh = triangulatePlane (sites.uv, sites.loop);
  for (const std::size_t p : {30U, 33U, 40U, 50U, 60U}) {
    EXPECT_EQ (mesh.triangle_of[p], NONE);
    sites.uv[p].setConstant (nan);
  }
  expectMesh (sites, mesh, 5);
}

TEST (PlanarDelaunay, OfPointsOnALineIsEmpty)
{
  Places line;
  for (int i = 0; i < 10; ++i)
    line.emplace_back (i, 2 * i);
  const TriangleMesh mesh = triangulatePlane (line, {0, 9});
  EXPECT_TRUE (mesh.triangles.empty ());
  EXPECT_EQ (mesh.triangle_of, std::vector<Index> (10, NONE));
  EXPECT_TRUE (triangulatePlane ({}, {}).triangles.empty ());
  EXPECT_TRUE (triangulateHull ({}).triangles.empty ());
  EXPECT_TRUE (triangulateHull ({{0.0, 0.0}, {1.0, 1.0}, {2.0, 2.0}}).triangles.empty ());
}

} // namespace
} // namespace pcl::floater

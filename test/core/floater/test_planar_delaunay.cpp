// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/planar_delaunay.h"

#include "samples.h"

#include <gtest/gtest.h>

#include <limits>

namespace pcl::floater {
namespace {
using Places = std::vector<Eigen::Vector2d>;

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
// empty is checked for the whole method (test_published_method.cpp).
void
expectMesh (const Sites& sites, const TriangleMesh& mesh, std::size_t dropped)
{
  TriangleMesh fresh;
  fresh.triangles = mesh.triangles;
  ASSERT_TRUE (fresh.connect (sites.uv.size (), 1));
  EXPECT_EQ (fresh.neighbors, mesh.neighbors);
  const samples::Topology topology = samples::topologyOf (mesh.triangles);
  EXPECT_TRUE (topology.manifold);
  const std::size_t vertices = sites.uv.size () - dropped;
  EXPECT_EQ (topology.vertices, vertices);
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
  // On slanted sides rounding puts some of the points inside of the hull.
  Sites slanted;
  slanted.uv = samples::resample ({{-0.4, -0.5}, {0.5, -0.2}, {0.2, 0.5}, {-0.6, 0.3}}, 0.03);
  slanted.loop = samples::indices (slanted.uv.size ());
  for (const Eigen::Vector3d& p : samples::randomPoints (200, 3))
    slanted.uv.emplace_back (0.3 * p.head<2> () - Eigen::Vector2d (0.2, 0.15));
  expectMesh (slanted, triangulatePlane (slanted.uv, slanted.loop), 0);
  // Cocircular points in a grid.
  Sites grid;
  grid.uv = samples::resample ({{0, 0}, {12, 0}, {12, 12}, {0, 12}}, 1.0);
  grid.loop = samples::indices (grid.uv.size ());
  for (int x = 1; x < 12; ++x)
    for (int y = 1; y < 12; ++y)
      grid.uv.emplace_back (x, y);
  for (Eigen::Vector2d& p : grid.uv)
    p = (p - Eigen::Vector2d (6.0, 6.0)) / 16.0;
  expectMesh (grid, triangulatePlane (grid.uv, grid.loop), 0);
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

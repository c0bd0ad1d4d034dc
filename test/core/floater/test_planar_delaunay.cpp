// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/planar_delaunay.h"

#include "floater/domain.h"
#include "samples.h"

#include <gtest/gtest.h>

#include <limits>

namespace pcl::floater {
namespace {
using samples::PI;
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

// Positive if d is inside of the circle through a, b and c, which are anti-clockwise.
double
inCircleTest (Eigen::Vector2d a, Eigen::Vector2d b, Eigen::Vector2d c, const Eigen::Vector2d& d)
{
  a -= d;
  b -= d;
  c -= d;
  Eigen::Matrix3d rows;
  rows << a.x (), a.y (), a.squaredNorm (), b.x (), b.y (), b.squaredNorm (), c.x (), c.y (),
      c.squaredNorm ();
  return rows.determinant ();
}

// Expects a mesh of all points but so many, with empty circumcircles and the loop as its boundary.
void
expectDelaunay (const Sites& sites, const TriangleMesh& mesh, std::size_t dropped)
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
  for (const Triangle& t : mesh.triangles) {
    const Eigen::Vector2d a = sites.uv[t[0]], b = sites.uv[t[1]], c = sites.uv[t[2]];
    const Eigen::Vector2d ab = b - a, ac = c - a;
    EXPECT_GT (ab.x () * ac.y () - ab.y () * ac.x (), 0.0);
    for (const Eigen::Vector2d& d : sites.uv) {
      if (d.allFinite ()) {
        ASSERT_LT (inCircleTest (a, b, c, d), 1e-13);
      }
    }
  }
}

TEST (PlanarDelaunay, CirclesAreEmpty)
{
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Sites sites = inCircle (40, 300, seed);
    expectDelaunay (sites, triangulatePlane (sites.uv, sites.loop), 0);
  }
}

TEST (PlanarDelaunay, OfTheHullAlone)
{
  for (const std::size_t hull : {3U, 4U, 5U, 100U}) {
    const Sites sites = inCircle (hull, 0, 1);
    expectDelaunay (sites, triangulatePlane (sites.uv, sites.loop), 0);
  }
}

TEST (PlanarDelaunay, OfCocircularPointsInAGrid)
{
  Sites sites;
  const int side = 12;
  const auto add = [&sites] (int x, int y) {
    sites.uv.emplace_back ((x - 6) / 16.0, (y - 6) / 16.0);
  };
  for (int i = 0; i < side; ++i)
    add (i, 0);
  for (int i = 0; i < side; ++i)
    add (side, i);
  for (int i = 0; i < side; ++i)
    add (side - i, side);
  for (int i = 0; i < side; ++i)
    add (0, side - i);
  sites.loop = samples::indices (sites.uv.size ());
  for (int x = 1; x < side; ++x)
    for (int y = 1; y < side; ++y)
      add (x, y);
  expectDelaunay (sites, triangulatePlane (sites.uv, sites.loop), 0);
}

TEST (PlanarDelaunay, DomainsKeepTheirBoundary)
{
  const samples::Sheet sheet = samples::disc (0.08, 2);
  const std::vector<Index> loop = samples::indices (sheet.border);
  for (const Domain domain : {Domain::CIRCLE, Domain::SQUARE, Domain::POLYGON}) {
    Sites sites;
    sites.loop = loop;
    sites.uv = layLoop (sheet.positions, loop, {domain, 7});
    for (std::size_t p = sheet.border; p < sheet.positions.size (); ++p)
      sites.uv.emplace_back (0.6 * sheet.positions[p].head<2> ());
    expectDelaunay (sites, triangulatePlane (sites.uv, loop), 0);
  }
}

TEST (PlanarDelaunay, ASideThatIsNotExactlyStraightGetsNoSlivers)
{
  // On slanted sides rounding puts some of the points inside of the hull.
  Sites sites;
  const Places corners = {{-0.4, -0.5}, {0.5, -0.2}, {0.2, 0.5}, {-0.6, 0.3}};
  for (std::size_t c = 0; c < 4; ++c)
    for (int i = 0; i < 30; ++i)
      sites.uv.emplace_back (corners[c] + (corners[(c + 1) % 4] - corners[c]) * (i / 30.0));
  sites.loop = samples::indices (sites.uv.size ());
  RandomStream random (3);
  for (int i = 0; i < 200; ++i)
    sites.uv.emplace_back (0.3 * random.uniform () - 0.2, 0.3 * random.uniform () - 0.15);
  const TriangleMesh mesh = triangulatePlane (sites.uv, sites.loop);
  const samples::Topology topology = samples::topologyOf (mesh.triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (topology.vertices, sites.uv.size ());
  EXPECT_EQ (mesh.triangles.size (), 2 * sites.uv.size () - 2 - sites.loop.size ());
  ASSERT_EQ (topology.loops.size (), 1U);
  EXPECT_EQ (topology.loops.front (), sites.loop);
}

TEST (PlanarDelaunay, OfCoincidentPointsOneIsAVertex)
{
  Sites sites = inCircle (30, 100, 4);
  for (const std::size_t at : {50U, 50U, 77U})
    sites.uv.push_back (sites.uv[at]);
  const TriangleMesh mesh = triangulatePlane (sites.uv, sites.loop);
  expectDelaunay (sites, mesh, 3);
  EXPECT_EQ (std::count (mesh.triangle_of.begin (), mesh.triangle_of.end (), NONE), 3);
}

TEST (PlanarDelaunay, OfCoincidentPointsThatOfTheLoopIsTheVertex)
{
  Sites sites = inCircle (30, 100, 5);
  for (const std::size_t at : {0U, 12U, 29U})
    sites.uv.push_back (sites.uv[at]);
  const TriangleMesh mesh = triangulatePlane (sites.uv, sites.loop);
  expectDelaunay (sites, mesh, 3);
  for (std::size_t p = 130; p < 133; ++p)
    EXPECT_EQ (mesh.triangle_of[p], NONE);
  // Also if it has the larger index.
  std::reverse (sites.uv.begin (), sites.uv.end ());
  for (Index& p : sites.loop)
    p = static_cast<Index> (sites.uv.size ()) - 1 - p;
  expectDelaunay (sites, triangulatePlane (sites.uv, sites.loop), 3);
}

TEST (PlanarDelaunay, PointsWithoutParametersAreLeftOut)
{
  Sites sites = inCircle (20, 50, 6);
  const double nan = std::numeric_limits<double>::quiet_NaN ();
  sites.uv[33] = {nan, nan};
  sites.uv[60].y () = nan;
  const TriangleMesh mesh = triangulatePlane (sites.uv, sites.loop);
  expectDelaunay (sites, mesh, 2);
  EXPECT_EQ (mesh.triangle_of[33], NONE);
  EXPECT_EQ (mesh.triangle_of[60], NONE);
}

TEST (PlanarDelaunay, PointsOnOrBeyondTheLoopAreLeftOut)
{
  Sites sites = inCircle (20, 50, 7);
  const Eigen::Vector2d middle = 0.5 * (sites.uv[3] + sites.uv[4]);
  sites.uv[30] = 1.001 * middle;
  sites.uv[40] = 1.5 * sites.uv[7];
  sites.uv[50] = {0.5 * (sites.uv[0].x () + sites.uv[10].x ()), 1.0};
  const TriangleMesh mesh = triangulatePlane (sites.uv, sites.loop);
  for (const Index p : {30U, 40U, 50U})
    EXPECT_EQ (mesh.triangle_of[p], NONE);
  for (const std::size_t p : {30U, 40U, 50U})
    sites.uv[p].setConstant (std::numeric_limits<double>::quiet_NaN ());
  expectDelaunay (sites, mesh, 3);
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
}

TEST (TriangulateHull, FillsTheHullOfPointsAnyhowPlaced)
{
  RandomStream random (3);
  std::vector<Eigen::Vector2d> places{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
  for (int i = 0; i < 500; ++i)
    places.emplace_back (random.uniform (), random.uniform ());
  places.push_back (places[10]); // stays without a triangle
  places.emplace_back (std::nan (""), 0.5);
  const TriangleMesh mesh = triangulateHull (places);
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += 0.5 * cross (places[b] - places[a], places[c] - places[a]);
  EXPECT_NEAR (area, 1.0, 1e-12);
  EXPECT_EQ (mesh.triangles.size (), 2 * 504U - 2U - 4U);
  EXPECT_EQ (mesh.triangle_of.back (), NONE);
  TriangleMesh copy = mesh;
  EXPECT_TRUE (copy.connect (places.size (), 1));
}

TEST (TriangulateHull, PointsOnALineHaveNone)
{
  EXPECT_TRUE (triangulateHull ({}).triangles.empty ());
  EXPECT_TRUE (triangulateHull ({{0.0, 0.0}, {1.0, 1.0}, {2.0, 2.0}}).triangles.empty ());
}

} // namespace
} // namespace pcl::floater

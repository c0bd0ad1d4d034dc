// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The method of TW 385 and nothing else, and normals that are given.
#include "mesh_oracle.h"
#include "samples.h"

#include <pcl/surface/floater/reconstruct.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pcl::floater {
namespace {
using samples::asInput;
using samples::Positions;

Options
published ()
{
  Options options;
  options.disc = DiscOptions::tw385 ();
  return options;
}

// A round sheet over a wavy ground.
Positions
wavySheet (std::uint64_t seed)
{
  Positions positions = samples::disc (0.06, seed).positions;
  for (Eigen::Vector3d& p : positions)
    p.z () = 0.1 * std::sin (3.0 * p.x ()) * std::cos (2.0 * p.y ());
  return positions;
}

std::vector<Triangle>
trianglesOf (const Result& result)
{
  return {result.triangles.begin (), result.triangles.end ()};
}

// Positive if d is inside the circle through the corners of an anti-clockwise triangle.
double
inCircle (const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
          const Eigen::Vector2d& d)
{
  Eigen::Matrix3d m;
  m << a.x () - d.x (), a.y () - d.y (), (a - d).squaredNorm (), //
      b.x () - d.x (), b.y () - d.y (), (b - d).squaredNorm (),  //
      c.x () - d.x (), c.y () - d.y (), (c - d).squaredNorm ();
  return m.determinant ();
}

TEST (PublishedMethod, TrianglesAreTheDelaunayTriangulationOfTheParameters)
{
  const Positions positions = wavySheet (1);
  const Result result = reconstruct (asInput (positions), published ());
  ASSERT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
  EXPECT_EQ (result.report.topology, Topology::DISC);
  EXPECT_EQ (result.report.statistics.flips, 0U);
  const std::vector<Triangle> triangles = trianglesOf (result);
  const samples::Topology topology = samples::topologyOf (triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (topology.euler, 1);
  EXPECT_EQ (topology.vertices, positions.size ());
  // No flips, no repair: across every edge, the corner is outside the circle in the plane.
  const std::vector<Eigen::Vector2d>& uv = result.report.parameters;
  std::map<std::pair<Index, Index>, Index> corner_at;
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      corner_at[{t[i], t[(i + 1) % 3]}] = t[(i + 2) % 3];
  std::size_t edges = 0;
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto across = corner_at.find ({t[(i + 1) % 3], t[i]});
      if (across == corner_at.end ())
        continue;
      ++edges;
      const Eigen::Vector2d &a = uv[t[0]], &b = uv[t[1]], &c = uv[t[2]];
      const Eigen::Vector2d ab = b - a, ac = c - a;
      const double side = ab.x () * ac.y () - ab.y () * ac.x () > 0.0 ? 1.0 : -1.0;
      EXPECT_LE (side * inCircle (a, b, c, uv[across->second]), 1e-14);
    }
  EXPECT_GT (edges, positions.size ());
}

TEST (PublishedMethod, LeavesEverythingElseOut)
{
  // A point far off the sheet would be an outlier, and stays.
  Positions positions = wavySheet (2);
  positions.emplace_back (0.0, 0.0, 0.6);
  const Result usual = reconstruct (asInput (positions), samples::discOptions ());
  const Result result = reconstruct (asInput (positions), published ());
  EXPECT_EQ (usual.report.outliers.size (), 1U);
  ASSERT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
  EXPECT_TRUE (result.report.outliers.empty ());
  EXPECT_EQ (result.report.statistics.relinked_points, 0U);
  EXPECT_EQ (result.report.statistics.noise, 0.0);
}

TEST (PublishedMethod, IsForDiscsOnly)
{
  Options options = published ();
  options.topology = Topology::SURFACE;
  EXPECT_EQ (reconstruct (asInput (wavySheet (3)), options).report.status,
             RunStatus::INVALID_OPTION);
}

// A cloud in two parts: nothing links the second one to the loop.
TEST (PublishedMethod, LinksNothing)
{
  Positions positions = wavySheet (4);
  const std::size_t part = positions.size ();
  for (std::size_t p = 0; p < part; ++p)
    positions.emplace_back (positions[p] + Eigen::Vector3d (3.0, 0.0, 0.0));
  const Result result = reconstruct (asInput (positions), published ());
  ASSERT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
  EXPECT_EQ (result.report.statistics.relinked_points, 0U);
  EXPECT_EQ (result.report.unused.size (), part);
}

TEST (GivenNormals, TakeThePlaceOfFittedPlanes)
{
  const Positions positions = wavySheet (5);
  const Result fitted = reconstruct (asInput (positions), {});
  ASSERT_EQ (fitted.report.status, RunStatus::SUCCESS);
  Input input = asInput (positions);
  // Of any length and sign; where there is none, the plane is fitted.
  for (std::size_t p = 0; p < positions.size (); ++p) {
    const double x = positions[p].x (), y = positions[p].y ();
    const Eigen::Vector3d normal (-0.3 * std::cos (3.0 * x) * std::cos (2.0 * y),
                                  0.2 * std::sin (3.0 * x) * std::sin (2.0 * y), 1.0);
    input.normals.emplace_back (((p % 2 == 0 ? 5.0 : -1e-3) * normal).cast<float> ());
    if (p % 10 == 0)
      input.normals.back () = p % 20 == 0 ? Eigen::Vector3f (Eigen::Vector3f::Zero ())
                                          : Eigen::Vector3f (Eigen::Vector3f::Constant (
                                                std::numeric_limits<float>::quiet_NaN ()));
  }
  const Result given = reconstruct (Input (input), {});
  ASSERT_EQ (given.report.status, RunStatus::SUCCESS) << given.report.message;
  EXPECT_EQ (samples::unordered (trianglesOf (given)), samples::unordered (trianglesOf (fitted)));
  // Normals that lie in the surface are taken, too: nothing is right with them.
  for (Eigen::Vector3f& normal : input.normals)
    normal = Eigen::Vector3f::UnitX ();
  const Result wrong = reconstruct (std::move (input), {});
  EXPECT_NE (samples::unordered (trianglesOf (wrong)), samples::unordered (trianglesOf (fitted)));
}

TEST (GivenNormals, AreOneForEachPointOfTheCloud)
{
  Input input = asInput (wavySheet (6));
  input.normals.assign (input.positions.size () - 1, Eigen::Vector3f::UnitZ ());
  const Result result = reconstruct (std::move (input), {});
  EXPECT_EQ (result.report.status, RunStatus::INVALID_INDICES);
  EXPECT_NE (result.report.message.find ("normals"), std::string::npos);
}

} // namespace
} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Deep surfaces: regions that collapse in the plane, and that are laid out again.
#include "floater/collapsed_regions.h"
#include "floater/region_recursion.h"

#include "floater/boundary/boundary.h"
#include "floater/floater_method.h"
#include "floater/planar_delaunay.h"
#include "samples.h"
#include "surfaces.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::Neighborhoods;
using samples::Positions;

constexpr double TUBE_RADIUS = 3.6; // of the fingers, in spacings; 23 points around

// An open tube with a round tip.
// \param length over its radius
Positions
finger (double length)
{
  SurfaceSpec spec;
  spec.kind = SurfaceKind::FINGER;
  spec.points = static_cast<std::size_t> (2.0 * PI * (1.0 + length) * TUBE_RADIUS * TUBE_RADIUS);
  spec.length = length;
  return generateSurface (spec);
}

TEST (Depth, OpenFingersAreDiscsOfAllPointsWithShortEdges)
{
  for (const double length : {1.0, 10.0, 30.0, 60.0, 100.0}) {
    SCOPED_TRACE (length);
    const Positions cloud = finger (length);
    const Result result = reconstruct (samples::asInput (cloud), samples::discOptions ());
    ASSERT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
    const samples::Topology topology = samples::topologyOf (result.triangles);
    EXPECT_TRUE (topology.manifold && topology.components == 1 && topology.euler == 1);
    EXPECT_EQ (topology.vertices, cloud.size ());
    EXPECT_EQ (result.report.statistics.folds, 0U);
    double longest = 0.0;
    for (const Triangle& t : result.triangles)
      for (std::size_t i = 0; i < 3; ++i)
        longest = std::max (longest, (cloud[t[i]] - cloud[t[(i + 1) % 3]]).norm ());
    EXPECT_LT (longest, 3.0); // spacings
    EXPECT_NEAR (static_cast<double> (result.report.statistics.levels), length / 14.0,
                 length < 12.0 ? 0.9 : 1.5); // each level shrinks by a million
  }
}

// A flat disc whose parameters are its own places, but pressed together around some centres.
struct PressedDisc
{
  static constexpr double RADIUS = 0.25;
  Neighborhoods made;
  Positions positions;
  std::vector<Index> loop;
  std::vector<Eigen::Vector2d> uv;
  TriangleMesh mesh;

  explicit PressedDisc (const std::vector<Eigen::Vector2d>& centres)
  {
    const samples::Sheet sheet = samples::disc (0.05, 3);
    made = samples::makeNeighborhoods (sheet.positions);
    loop.resize (sheet.border);
    for (Index p = 0; p < made.points.size (); ++p) {
      positions.push_back (sheet.positions[made.points.cloud_index[p]]);
      uv.emplace_back (positions[p].head<2> ());
      if (made.points.cloud_index[p] < sheet.border)
        loop[made.points.cloud_index[p]] = p;
    }
    mesh = triangulatePlane (uv, loop);
    for (const Eigen::Vector2d& centre : centres)
      for (Eigen::Vector2d& p : uv)
        if ((p - centre).norm () < RADIUS)
          p = centre + 1e-9 * (p - centre);
  }

  std::vector<CollapsedRegion> find (const DiscLimits& limits = {}) const
  {
    return findCollapsedRegions (mesh, uv, positions, loop, 1, limits);
  }
};

TEST (CollapsedRegions, AreDiscsWithoutChords)
{
  const std::vector<Eigen::Vector2d> centres{{-0.5, 0.0}, {0.5, 0.1}};
  const PressedDisc pressed (centres);
  const std::vector<CollapsedRegion> regions = pressed.find ();
  ASSERT_EQ (regions.size (), centres.size ());
  std::set<Index> seen;
  for (const CollapsedRegion& region : regions) {
    std::vector<Triangle> triangles;
    for (const Index t : region.triangles)
      triangles.push_back (pressed.mesh.triangles[t]);
    const samples::Topology topology = samples::topologyOf (triangles);
    EXPECT_TRUE (topology.manifold && topology.components == 1 && topology.euler == 1);
    ASSERT_EQ (topology.loops.size (), 1U);
    EXPECT_EQ (samples::canonicalCycle (topology.loops.front ()),
               samples::canonicalCycle (region.loop));
    EXPECT_EQ (topology.vertices, region.loop.size () + region.interior.size ());
    // All points that are pressed together, but for the outermost ones.
    const bool left = pressed.positions[region.interior.front ()].x () < 0.0;
    const auto isPressed = [&] (const Eigen::Vector3d& p) {
      return (p.head<2> () - centres[left ? 0 : 1]).norm () < PressedDisc::RADIUS;
    };
    const auto pressed_points = static_cast<std::size_t> (
        std::count_if (pressed.positions.begin (), pressed.positions.end (), isPressed));
    EXPECT_GE (topology.vertices, pressed_points - 5); // some have no collapsed triangle
    for (const Index p : region.interior)
      EXPECT_TRUE (isPressed (pressed.positions[p]) && seen.insert (p).second);
    // Outside of the region, only edges of its loop join two points of the loop.
    const std::set<Index> loop (region.loop.begin (), region.loop.end ());
    const auto isInRegion = [&] (Index t) {
      return std::binary_search (region.triangles.begin (), region.triangles.end (), t);
    };
    for (Index t = 0; t < pressed.mesh.triangles.size (); ++t)
      for (std::uint8_t side = 0; side < 3; ++side)
        if (!isInRegion (t) && loop.count (pressed.mesh.from ({t, side})) != 0 &&
            loop.count (pressed.mesh.to ({t, side})) != 0) {
          EXPECT_TRUE (isInRegion (pressed.mesh.neighbors[t][side]));
        }
  }
}

TEST (CollapsedRegions, ContainWhatTheyEnclose)
{
  PressedDisc pressed ({{0.0, 0.0}});
  const std::size_t whole = pressed.find ().front ().triangles.size ();
  // Put the middle point back in its place: its triangles have not collapsed.
  Index middle = 0;
  for (Index p = 0; p < pressed.positions.size (); ++p)
    if (pressed.positions[p].norm () < pressed.positions[middle].norm ())
      middle = p;
  pressed.uv[middle] = pressed.positions[middle].head<2> ();
  ASSERT_EQ (pressed.find ().size (), 1U);
  EXPECT_EQ (pressed.find ().front ().triangles.size (), whole);
  // Add a point without a triangle that coincides with it, and one without parameters.
  pressed.uv.emplace_back (pressed.uv[middle]);
  pressed.uv.emplace_back (Eigen::Vector2d::Constant (std::numeric_limits<double>::quiet_NaN ()));
  for (int i = 0; i < 2; ++i) {
    pressed.positions.push_back (pressed.positions[middle]);
    pressed.mesh.triangle_of.push_back (NONE);
  }
  const std::vector<Index> interior = pressed.find ().front ().interior;
  EXPECT_EQ (interior.back (), pressed.positions.size () - 2);
  EXPECT_TRUE (std::binary_search (interior.begin (), interior.end (), middle));
}

TEST (CollapsedRegions, DependOnTheLimitAndNeverTouchTheBoundary)
{
  DiscLimits limits;
  limits.collapsed_scale = 1e-10; // the disc is pressed by 1e-9
  EXPECT_TRUE (PressedDisc ({{0.0, 0.0}}).find (limits).empty ());
  const PressedDisc pressed ({{0.9, 0.0}});
  for (const CollapsedRegion& region : pressed.find ())
    for (const std::vector<Index>* part : {&region.loop, &region.interior})
      for (const Index p : *part)
        EXPECT_EQ (std::count (pressed.loop.begin (), pressed.loop.end (), p), 0);
  EXPECT_TRUE (PressedDisc ({}).find ().empty ());
}

// If they can be parameterized: without neighbours they stay as they are.
TEST (CollapsedRegions, AreLaidOutAgain)
{
  for (const bool connected : {true, false}) {
    PressedDisc pressed ({{-0.5, 0.0}, {0.5, 0.1}});
    const std::vector<Triangle> before = pressed.mesh.triangles;
    CsrLists none;
    none.offsets.assign (pressed.positions.size () + 1, 0);
    const std::size_t levels =
        layOutCollapsedRegions (pressed.mesh, pressed.uv, pressed.positions,
                                connected ? pressed.made.geometry.neighbors : none,
                                pressed.made.geometry.stars.normals, pressed.loop, {}, {}, 1);
    EXPECT_EQ (levels, connected ? 1U : 0U);
    EXPECT_EQ (pressed.mesh.triangles.size (), before.size ());
    if (!connected) {
      EXPECT_EQ (pressed.mesh.triangles, before);
    }
  }
}

} // namespace
} // namespace pcl::floater

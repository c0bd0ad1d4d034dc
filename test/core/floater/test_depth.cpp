// SPDX-License-Identifier: GPL-3.0-or-later
// Deep surfaces: regions that collapse in the plane, and what their recursion makes of them.
#include "floater/collapsed_regions.h"
#include "floater/region_recursion.h"

#include "floater/boundary/boundary.h"
#include "floater/parameterize.h"
#include "floater/planar_delaunay.h"
#include "samples.h"
#include "surfaces.h"

#include <gtest/gtest.h>

namespace pcl
{
namespace floater
{
namespace
{
using samples::asInput;
using samples::Outline;
using samples::PI;
using samples::Positions;

constexpr double RADIUS = 3.6; // of fingers, in spacings: 23 points around

// An open tube with a round tip, by the generator, its radius as above.
Positions
finger (double length)
{
  SurfaceSpec spec;
  spec.kind = SurfaceKind::FINGER;
  spec.points = static_cast<std::size_t> (2.0 * PI * (1.0 + length) * RADIUS * RADIUS);
  spec.length = length;
  return generateSurface (spec);
}

// Rings of points on a tube with a round tip, from one spacing above the ground on.
void
addFinger (const Eigen::Vector2d& foot, double length, RandomStream& random, Positions& cloud)
{
  const double straight = length * RADIUS, whole = straight + 0.5 * PI * RADIUS;
  const int rings = static_cast<int> (std::lround (whole));
  for (int ring = 1; ring <= rings; ++ring) {
    const double along = whole * ring / rings;
    const double angle = std::max (0.0, along - straight) / RADIUS;
    const int count =
        std::max (1, static_cast<int> (std::lround (2.0 * PI * RADIUS * std::cos (angle))));
    for (int i = 0; i < count; ++i) {
      const double turn = 2.0 * PI * (i + 0.5 * (ring % 2) + 0.4 * random.uniform ()) / count;
      const double r = RADIUS * std::cos (angle);
      cloud.emplace_back (foot.x () + r * std::cos (turn), foot.y () + r * std::sin (turn),
                          std::min (along, straight) + RADIUS * std::sin (angle));
    }
  }
}

// A round plate with fingers, the lengths over radius as given, standing on a circle.
samples::Sheet
hand (const std::vector<double>& lengths)
{
  const double around = lengths.size () == 1 ? 0.0 : 4.0 * RADIUS;
  std::vector<Outline> outlines{samples::circle (around + 3.0 * RADIUS, 1.0)};
  Outline feet;
  for (std::size_t i = 0; i < lengths.size (); ++i) {
    const double turn = 2.0 * PI * static_cast<double> (i) / static_cast<double> (lengths.size ());
    feet.emplace_back (around * std::cos (turn), around * std::sin (turn));
    outlines.push_back (samples::circle (RADIUS, 1.0));
    for (Eigen::Vector2d& p : outlines.back ())
      p += feet.back ();
  }
  samples::Sheet sheet = samples::fillOutlines (outlines, 1.0, 0.3, 5);
  RandomStream random (6);
  for (std::size_t i = 0; i < lengths.size (); ++i)
    addFinger (feet[i], lengths[i], random, sheet.positions);
  return sheet;
}

// One disc of all points whose edges are short.
void
expectWholeDisc (const Result& result, const Positions& cloud)
{
  ASSERT_EQ (result.report.status, Status::OK) << result.report.message;
  const samples::Topology topology = samples::topologyOf (result.triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (topology.components, 1U);
  EXPECT_EQ (topology.euler, 1);
  EXPECT_EQ (topology.vertices, cloud.size ());
  EXPECT_TRUE (result.report.unused.empty ());
  ASSERT_EQ (topology.loops.size (), 1U);
  EXPECT_EQ (samples::canonicalCycle (topology.loops.front ()),
             samples::canonicalCycle (result.report.loop));
  EXPECT_EQ (result.report.statistics.folds, 0U);
  double longest = 0.0;
  for (const Triangle& t : result.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      longest = std::max (longest, (cloud[t[i]] - cloud[t[(i + 1) % 3]]).norm ());
  EXPECT_LT (longest, 3.0); // spacings
}

Options
discOptions ()
{
  Options options;
  options.topology = Topology::DISC;
  return options;
}

TEST (Depth, OpenFingers)
{
  for (const double length : {1.0, 10.0, 30.0, 60.0, 100.0}) {
    SCOPED_TRACE (length);
    const Positions cloud = finger (length);
    const Result result = reconstruct (asInput (cloud), discOptions ());
    expectWholeDisc (result, cloud);
    const auto levels = static_cast<double> (result.report.statistics.levels);
    EXPECT_NEAR (levels, length / 14.0, length < 12.0 ? 0.9 : 1.5); // a factor of a million each
  }
}

TEST (Depth, FingersOnAPlate)
{
  for (const double length : {10.0, 60.0}) {
    SCOPED_TRACE (length);
    const samples::Sheet sheet = hand ({length});
    const Result result = reconstruct (asInput (sheet.positions), discOptions ());
    expectWholeDisc (result, sheet.positions);
  }
}

TEST (Depth, Hand)
{
  const samples::Sheet sheet = hand ({20.0, 35.0, 50.0, 40.0, 25.0});
  const Result result = reconstruct (asInput (sheet.positions), discOptions ());
  expectWholeDisc (result, sheet.positions);
  EXPECT_GE (result.report.statistics.levels, 3U);
}

TEST (Depth, SameForAnyNumberOfThreads)
{
  const Positions cloud = finger (40.0);
  Options options = discOptions ();
  options.threads = 1;
  const Result one = reconstruct (asInput (cloud), options);
  options.threads = 3;
  EXPECT_EQ (one.triangles, reconstruct (asInput (cloud), options).triangles);
}

// A flat disc, its own parameters, and in the plane pressed together around some centres.
struct PressedDisc
{
  static constexpr double RADIUS = 0.25;
  Positions positions;
  std::vector<Index> loop;
  std::vector<Eigen::Vector2d> uv;
  TriangleMesh mesh;

  explicit PressedDisc (const std::vector<Eigen::Vector2d>& centres)
  {
    const samples::Sheet sheet = samples::disc (0.05, 3);
    positions = sheet.positions;
    loop = samples::indices (sheet.border);
    for (const Eigen::Vector3d& p : positions)
      uv.emplace_back (p.head<2> ());
    mesh = triangulatePlane (uv, loop);
    for (const Eigen::Vector2d& centre : centres)
      for (Eigen::Vector2d& p : uv)
        if ((p - centre).norm () < RADIUS)
          p = centre + 1e-9 * (p - centre);
  }

  std::vector<CollapsedRegion> find () const
  {
    return findCollapsedRegions (mesh, uv, positions, loop);
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
    EXPECT_TRUE (topology.manifold);
    EXPECT_EQ (topology.components, 1U);
    EXPECT_EQ (topology.euler, 1);
    ASSERT_EQ (topology.loops.size (), 1U);
    EXPECT_EQ (samples::canonicalCycle (topology.loops.front ()),
               samples::canonicalCycle (region.loop));
    EXPECT_EQ (topology.vertices, region.loop.size () + region.interior.size ());
    // All that is pressed together, but for its outermost ring.
    const bool left = pressed.positions[region.interior.front ()].x () < 0.0;
    std::size_t pressed_points = 0;
    for (const Eigen::Vector3d& p : pressed.positions)
      pressed_points +=
          (p.head<2> () - centres[left ? 0 : 1]).norm () < PressedDisc::RADIUS ? 1 : 0;
    EXPECT_GE (topology.vertices, pressed_points - 5); // corners of none of the triangles
    for (const Index p : region.interior) {
      EXPECT_LT ((pressed.positions[p].head<2> () - centres[left ? 0 : 1]).norm (),
                 PressedDisc::RADIUS);
      EXPECT_TRUE (seen.insert (p).second);
    }
    // No edge outside of the region joins two points of the rim, but the rim's own.
    const std::set<Index> loop (region.loop.begin (), region.loop.end ());
    for (Index t = 0; t < pressed.mesh.triangles.size (); ++t) {
      if (std::binary_search (region.triangles.begin (), region.triangles.end (), t))
        continue;
      for (std::uint8_t side = 0; side < 3; ++side)
        if (loop.count (pressed.mesh.from ({t, side})) != 0 &&
            loop.count (pressed.mesh.to ({t, side})) != 0) {
          EXPECT_TRUE (std::binary_search (region.triangles.begin (), region.triangles.end (),
                                           pressed.mesh.neighbors[t][side]));
        }
    }
  }
}

TEST (CollapsedRegions, TakeInWhatTheyEnclose)
{
  PressedDisc pressed ({{0.0, 0.0}});
  const std::size_t whole = pressed.find ().front ().triangles.size ();
  // The point next to the centre in its place: its triangles have not collapsed.
  Index middle = 0;
  for (Index p = 0; p < pressed.positions.size (); ++p)
    if (pressed.positions[p].norm () < pressed.positions[middle].norm ())
      middle = p;
  pressed.uv[middle] = pressed.positions[middle].head<2> ();
  ASSERT_EQ (pressed.find ().size (), 1U);
  EXPECT_EQ (pressed.find ().front ().triangles.size (), whole);
  // One without a triangle on the place of another, and one that has no place.
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

TEST (CollapsedRegions, NeverTouchTheLoop)
{
  const PressedDisc pressed ({{0.9, 0.0}});
  for (const CollapsedRegion& region : pressed.find ())
    for (const std::vector<Index>* part : {&region.loop, &region.interior})
      for (const Index p : *part)
        EXPECT_GE (p, pressed.loop.size ());
  EXPECT_TRUE (PressedDisc ({}).find ().empty ());
}

// The stages up to the planar triangulation.
struct Layout
{
  samples::Neighborhoods made;
  std::vector<Index> loop;
  std::vector<Eigen::Vector2d> uv;
  TriangleMesh mesh;
};

Layout
layOut (const Positions& cloud, const Options& options)
{
  Layout layout;
  layout.made = samples::makeNeighborhoods (cloud);
  samples::Neighborhoods& made = layout.made;
  layout.loop =
      findBoundary (made.points, made.geometry.neighbors, made.geometry.stars, options).loop;
  Statistics statistics;
  StageClock clock (statistics, options.stage_callback);
  layout.uv = parameterize (made.points.positions, made.geometry.neighbors, made.geometry.stars,
                            layout.loop, options, clock, statistics)
                  .uv;
  layout.mesh = triangulatePlane (layout.uv, layout.loop);
  return layout;
}

std::size_t
missingPoints (const TriangleMesh& mesh)
{
  return static_cast<std::size_t> (
      std::count (mesh.triangle_of.begin (), mesh.triangle_of.end (), NONE));
}

TEST (Depth, PointsThatCoincideComeBack)
{
  const Options options = discOptions ();
  Layout layout = layOut (finger (100.0), options);
  const samples::Neighborhoods& made = layout.made;
  const std::size_t missing = missingPoints (layout.mesh);
  EXPECT_GT (missing, made.points.positions.size () / 20);
  const RegionRecursion recursion = layOutCollapsedRegions (
      layout.mesh, layout.uv, made.points.positions, made.geometry.neighbors,
      made.geometry.stars.normals, layout.loop, options);
  EXPECT_GT (recursion.levels, 4U);
  EXPECT_EQ (missingPoints (layout.mesh), 0U);
  RecordProperty ("missing_before", static_cast<int> (missing));
  RecordProperty ("levels", static_cast<int> (recursion.levels));
}

TEST (Depth, WhatCannotBeSolvedForStaysAsItWas)
{
  const Options options = discOptions ();
  Layout layout = layOut (finger (40.0), options);
  const samples::Neighborhoods& made = layout.made;
  const std::vector<Triangle> before = layout.mesh.triangles;
  CsrLists nobody; // no point hangs together with another
  nobody.offsets.assign (made.points.positions.size () + 1, 0);
  const RegionRecursion recursion =
      layOutCollapsedRegions (layout.mesh, layout.uv, made.points.positions, nobody,
                              made.geometry.stars.normals, layout.loop, options);
  EXPECT_EQ (recursion.levels, 0U);
  EXPECT_EQ (recursion.regions, 0U);
  EXPECT_EQ (layout.mesh.triangles, before);
}

TEST (Depth, ShallowSurfacesStayAsTheyAre)
{
  const Options options = discOptions ();
  Layout layout = layOut (finger (4.0), options);
  const samples::Neighborhoods& made = layout.made;
  EXPECT_TRUE (
      findCollapsedRegions (layout.mesh, layout.uv, made.points.positions, layout.loop).empty ());
  const std::vector<Triangle> before = layout.mesh.triangles;
  const RegionRecursion recursion = layOutCollapsedRegions (
      layout.mesh, layout.uv, made.points.positions, made.geometry.neighbors,
      made.geometry.stars.normals, layout.loop, options);
  EXPECT_EQ (recursion.levels, 0U);
  EXPECT_EQ (layout.mesh.triangles, before);
}

} // namespace
} // namespace floater
} // namespace pcl

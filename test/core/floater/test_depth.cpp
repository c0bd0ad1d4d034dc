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
using samples::asInput;
using samples::discOptions;
using samples::Outline;
using samples::PI;
using samples::Positions;

constexpr double RADIUS = 3.6; // of the fingers, in spacings; 23 points around

// An open tube with a round tip.
// \param length over its radius
Positions
finger (double length)
{
  SurfaceSpec spec;
  spec.kind = SurfaceKind::FINGER;
  spec.points = static_cast<std::size_t> (2.0 * PI * (1.0 + length) * RADIUS * RADIUS);
  spec.length = length;
  return generateSurface (spec);
}

// Adds rings of points on a tube with a round tip, from one spacing above the ground on.
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

// A round plate with fingers that stand on a circle.
// \param lengths of the fingers over their radius
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

// Expects one disc of all points, with short edges.
void
expectWholeDisc (const Result& result, const Positions& cloud)
{
  ASSERT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
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

TEST (Depth, OpenFingers)
{
  for (const double length : {1.0, 10.0, 30.0, 60.0, 100.0}) {
    SCOPED_TRACE (length);
    const Positions cloud = finger (length);
    const Result result = reconstruct (asInput (cloud), discOptions ());
    expectWholeDisc (result, cloud);
    const auto levels = static_cast<double> (result.report.statistics.levels);
    EXPECT_NEAR (levels, length / 14.0,
                 length < 12.0 ? 0.9 : 1.5); // each level shrinks by a million
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

// A flat disc whose parameters are its own places, but pressed together around some centres.
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
    return findCollapsedRegions (mesh, uv, positions, loop, 1);
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
    // All points that are pressed together, but for the outermost ones.
    const bool left = pressed.positions[region.interior.front ()].x () < 0.0;
    std::size_t pressed_points = 0;
    for (const Eigen::Vector3d& p : pressed.positions)
      pressed_points +=
          (p.head<2> () - centres[left ? 0 : 1]).norm () < PressedDisc::RADIUS ? 1 : 0;
    EXPECT_GE (topology.vertices, pressed_points - 5); // some have no collapsed triangle
    for (const Index p : region.interior) {
      EXPECT_LT ((pressed.positions[p].head<2> () - centres[left ? 0 : 1]).norm (),
                 PressedDisc::RADIUS);
      EXPECT_TRUE (seen.insert (p).second);
    }
    // Outside of the region, only edges of its loop join two points of the loop.
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

TEST (CollapsedRegions, SearchCanBeCancelled)
{
  const PressedDisc pressed ({{0.0, 0.0}});
  Statistics statistics;
  RunMonitor monitor ({{}, {}, [] { return true; }}, statistics);
  EXPECT_THROW (findCollapsedRegions (pressed.mesh, pressed.uv, pressed.positions, pressed.loop,
                                      RunContext (1, &monitor)),
                Cancelled);
}

TEST (CollapsedRegions, DependOnTheLimit)
{
  const PressedDisc pressed ({{0.0, 0.0}}); // by a factor of 1e-9
  DiscLimits limits;
  limits.collapsed_scale = 1e-10;
  EXPECT_TRUE (
      findCollapsedRegions (pressed.mesh, pressed.uv, pressed.positions, pressed.loop, 1, limits)
          .empty ());
}

TEST (CollapsedRegions, NeverTouchTheBoundary)
{
  const PressedDisc pressed ({{0.9, 0.0}});
  for (const CollapsedRegion& region : pressed.find ())
    for (const std::vector<Index>* part : {&region.loop, &region.interior})
      for (const Index p : *part)
        EXPECT_GE (p, pressed.loop.size ());
  EXPECT_TRUE (PressedDisc ({}).find ().empty ());
}

// A cloud after the stages up to the planar triangulation.
struct Layout
{
  samples::Neighborhoods made;
  std::vector<Index> loop;
  std::vector<Eigen::Vector2d> uv;
  TriangleMesh mesh;
};

Layout
layOut (const Positions& cloud)
{
  Layout layout;
  layout.made = samples::makeNeighborhoods (cloud);
  const samples::Neighborhoods& made = layout.made;
  layout.loop = findBoundary (made.points, made.geometry, {}, 1).loop;
  layout.uv = parameterize (made.points.positions, made.geometry.neighbors, made.geometry.stars,
                            layout.loop, {}, 1)
                  .uv;
  layout.mesh = triangulatePlane (layout.uv, layout.loop);
  return layout;
}

// \return levels
std::size_t
layOutAgain (Layout& layout, const CsrLists& neighbors)
{
  const samples::Neighborhoods& made = layout.made;
  return layOutCollapsedRegions (layout.mesh, layout.uv, made.points.positions, neighbors,
                                 made.geometry.stars.normals, layout.loop, {}, {}, 1);
}

std::size_t
missingPoints (const TriangleMesh& mesh)
{
  return static_cast<std::size_t> (
      std::count (mesh.triangle_of.begin (), mesh.triangle_of.end (), NONE));
}

TEST (Depth, PointsThatCoincideGetTriangles)
{
  Layout layout = layOut (finger (100.0));
  const samples::Neighborhoods& made = layout.made;
  const std::size_t missing = missingPoints (layout.mesh);
  EXPECT_GT (missing, made.points.positions.size () / 20);
  const std::size_t levels = layOutAgain (layout, made.geometry.neighbors);
  EXPECT_GT (levels, 4U);
  EXPECT_EQ (missingPoints (layout.mesh), 0U);
  RecordProperty ("missing_before", static_cast<int> (missing));
  RecordProperty ("levels", static_cast<int> (levels));
}

TEST (Depth, RegionsThatCannotBeParameterizedStayAsTheyWere)
{
  Layout layout = layOut (finger (40.0));
  const samples::Neighborhoods& made = layout.made;
  const std::vector<Triangle> before = layout.mesh.triangles;
  CsrLists none; // no point has a neighbour
  none.offsets.assign (made.points.positions.size () + 1, 0);
  EXPECT_EQ (layOutAgain (layout, none), 0U);
  EXPECT_EQ (layout.mesh.triangles, before);
}

TEST (Depth, ShallowSurfacesStayAsTheyAre)
{
  Layout layout = layOut (finger (4.0));
  const samples::Neighborhoods& made = layout.made;
  EXPECT_TRUE (findCollapsedRegions (layout.mesh, layout.uv, made.points.positions, layout.loop, 1)
                   .empty ());
  const std::vector<Triangle> before = layout.mesh.triangles;
  const std::size_t levels = layOutAgain (layout, made.geometry.neighbors);
  EXPECT_EQ (levels, 0U);
  EXPECT_EQ (layout.mesh.triangles, before);
}

} // namespace
} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The method for discs: on known surfaces, as published, and with all choices that it has.
#include <pcl/surface/floater/reconstruct.h>
#include <pcl/surface/floater/texture_coordinates.h>

#include "options/option_rows.h"
#include "samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;

// One disc of all points in the loop of the report, whose figures agree with it.
void
expectDisc (const Result& result, std::size_t points)
{
  const Report& report = result.report;
  ASSERT_EQ (report.status, RunStatus::SUCCESS) << report.message;
  EXPECT_TRUE (report.message.empty ());
  const MeshTopology topology = expectTopology (result.triangles, points, 1, 1, 1);
  ASSERT_EQ (topology.loops.size (), 1U);
  EXPECT_EQ (canonicalCycle (topology.loops.front ()), canonicalCycle (report.loop));
  EXPECT_TRUE (report.unused.empty ());
  EXPECT_EQ (report.statistics.used_points, points);
  EXPECT_EQ (report.statistics.working_points, points);
  EXPECT_EQ (report.statistics.loop_points, report.loop.size ());
  EXPECT_EQ (report.statistics.unknowns, points - report.loop.size ());
  EXPECT_EQ (report.statistics.triangles, result.triangles.size ());
  EXPECT_EQ (result.triangles.size (), 2 * points - 2 - report.loop.size ());
  EXPECT_LT (report.statistics.residual, 1e-12);
  for (const Triangle& t : result.triangles)
    for (const Index p : t)
      EXPECT_LE (report.parameters[p].norm (), 1.0 + 1e-12);
}

TEST (Reconstruct, KnownDiscs)
{
  for (const SurfaceKind kind : {SurfaceKind::HEIGHT_FIELD, SurfaceKind::HEMISPHERE,
                                 SurfaceKind::FINGER, SurfaceKind::FOLDED_SHEET}) {
    SCOPED_TRACE (static_cast<int> (kind));
    const Positions cloud = surface (kind, 3000);
    const Result result = reconstruct (asInput (cloud), discOptions ());
    expectDisc (result, cloud.size ());
    EXPECT_EQ (result.report.statistics.folds, 0U);
    // One point for each unit of area; of rolling terrain, in plan view.
    const double area = areaOf (result.triangles, cloud);
    EXPECT_GT (area / 3000.0, 0.95);
    EXPECT_LT (area / 3000.0, kind == SurfaceKind::HEIGHT_FIELD ? 1.2 : 1.02);
  }
}

// Open tubes with round tips, which shrink in the plane like exp (-length / radius).
TEST (Reconstruct, FingersAreDiscsUntilTheirPointsCoincideInThePlane)
{
  constexpr double TUBE_RADIUS = 3.6;              // in spacings; 23 points around
  for (const double length : {1.0, 30.0, 100.0}) { // over the radius
    SCOPED_TRACE (length);
    const double points = 2.0 * PI * (1.0 + length) * TUBE_RADIUS * TUBE_RADIUS;
    const Positions cloud = generateSurface (
        {SurfaceKind::FINGER, static_cast<std::size_t> (points), 1, 1.0, 0.0, length});
    const Result disc = reconstruct (asInput (cloud), discOptions ());
    if (length < 50.0)
      expectDisc (disc, cloud.size ());
    else
      EXPECT_EQ (disc.report.status, RunStatus::NOT_A_DISC);
    const Result made = length < 50.0 ? disc : reconstruct (asInput (cloud), {});
    EXPECT_EQ (topologyOf (made.triangles).euler, 1);
    EXPECT_EQ (made.report.check.folds, 0U);
    EXPECT_LT (made.report.check.longest_edge, 2.6);
  }
}

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
  Positions positions = disc (0.06, seed).positions;
  for (Eigen::Vector3d& p : positions)
    p.z () = 0.1 * std::sin (3.0 * p.x ()) * std::cos (2.0 * p.y ());
  return positions;
}

TEST (Reconstruct, WithoutFlipsAndAsPublishedItIsTheDelaunayTriangulationOfTheParameters)
{
  const Positions cloud = wavySheet (1);
  Options plain = discOptions (), flipped = discOptions ();
  plain.flip_edges = false;
  plain.disc.domain.curve = flipped.disc.domain.curve = Domain::CIRCLE;
  for (const Options& options : {plain, published ()}) {
    const Result result = reconstruct (asInput (cloud), options);
    expectDisc (result, cloud.size ());
    EXPECT_EQ (result.report.topology, floater::Topology::DISC);
    EXPECT_EQ (result.report.statistics.flips, 0U);
    const std::vector<Eigen::Vector2d>& uv = result.report.parameters;
    double area = 0.0;
    for (const Triangle& t : result.triangles) {
      const Eigen::Vector2d a = uv[t[1]] - uv[t[0]], b = uv[t[2]] - uv[t[0]];
      const double cross = a.x () * b.y () - a.y () * b.x ();
      area += 0.5 * cross;
      EXPECT_GT (cross * area, 0.0); // all turn the same way
      const Eigen::Vector2d centre =
          uv[t[0]] + Eigen::Vector2d (b.y () * a.squaredNorm () - a.y () * b.squaredNorm (),
                                      a.x () * b.squaredNorm () - b.x () * a.squaredNorm ()) /
                         (2.0 * cross);
      const double radius = (centre - uv[t[0]]).norm ();
      for (const Eigen::Vector2d& p : uv)
        ASSERT_GT ((p - centre).norm (), radius * (1.0 - 1e-9) - 1e-12);
    }
    // The whole disc, but for the segments beside the loop.
    EXPECT_NEAR (std::abs (area), PI, 0.02);
    EXPECT_NE (unordered (reconstruct (asInput (cloud), flipped).triangles),
               unordered (result.triangles));
  }
}

// A point far off the sheet is an outlier, and a small second component is left out and named. As
// published, the point is not left out.
TEST (PublishedMethod, LeavesEverythingElseOut)
{
  Positions positions = wavySheet (2);
  positions.emplace_back (0.0, 0.0, 0.6);
  const std::size_t first = positions.size ();
  positions = joined (positions, placed (disc (0.1, 2).positions, {10.0, 0.0, 0.0}, 0.5));
  const std::size_t second = positions.size () - first;
  const Result usual = reconstruct (asInput (positions), discOptions ());
  const Result as_published = reconstruct (asInput (positions), published ());
  EXPECT_EQ (usual.report.outliers, std::vector<Index> (1, static_cast<Index> (first - 1)));
  EXPECT_TRUE (as_published.report.outliers.empty ());
  EXPECT_EQ (as_published.report.statistics.noise, 0.0);
  for (const Result& result : {usual, as_published}) {
    const std::size_t used = first - result.report.outliers.size ();
    ASSERT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
    EXPECT_EQ (result.report.unused.size (), second);
    EXPECT_EQ (result.report.unused.front (), first);
    EXPECT_EQ (result.report.statistics.used_points, used);
    EXPECT_TRUE (warns (result.report, std::to_string (second)));
    EXPECT_TRUE (result.report.parameters.back ().hasNaN ());
    expectTopology (result.triangles, used, 1, 1, 1);
  }
}

TEST (GivenNormals, TakeThePlaceOfFittedPlanes)
{
  const Positions positions = wavySheet (5);
  const Result fitted = meshOf (positions);
  Input input = asInput (positions);
  // Of any length and sign; where there is none, the plane is fitted.
  for (std::size_t p = 0; p < positions.size (); ++p) {
    const double x = positions[p].x (), y = positions[p].y ();
    const Eigen::Vector3d normal (-0.3 * std::cos (3.0 * x) * std::cos (2.0 * y),
                                  0.2 * std::sin (3.0 * x) * std::sin (2.0 * y), 1.0);
    const double length = p % 20 == 0   ? 0.0
                          : p % 10 == 0 ? std::nan ("")
                          : p % 2 == 0  ? 5.0
                                        : -1e-3;
    input.normals.emplace_back ((length * normal).cast<float> ());
  }
  const Result given = reconstruct (Input (input), {});
  ASSERT_EQ (given.report.status, RunStatus::SUCCESS) << given.report.message;
  EXPECT_EQ (unordered (given.triangles), unordered (fitted.triangles));
  // Normals that lie in the surface are taken, too: nothing is right with them.
  for (Eigen::Vector3f& normal : input.normals)
    normal = Eigen::Vector3f::UnitX ();
  const Result wrong = reconstruct (std::move (input), {});
  EXPECT_NE (unordered (wrong.triangles), unordered (fitted.triangles));
}

// A round sheet of about 100 points, 36 of them on its border, whose middle is lifted.
Sheet
smallSheet (double height)
{
  Sheet sheet = disc (2.0 * PI / 36.0, 1);
  for (Eigen::Vector3d& p : sheet.positions)
    p.z () = height * (1.0 - p.squaredNorm ());
  return sheet;
}

// Flips lead to a triangulation whose circumcircles are empty. For points in a plane there is only
// one, whatever the mesh before the flips.
TEST (Choices, MakeTheSameMeshOfAFlatSheet)
{
  const auto [points, border] = smallSheet (0.0);
  Options options = discOptions (indices (border));
  const Result expected = reconstruct (asInput (points), options);
  expectDisc (expected, points.size ());
  for (const auto& [neighborhood, kind] : NEIGHBORHOOD_CHOICES)
    for (const auto& [weights, weighting] : WEIGHTING_CHOICES) {
      SCOPED_TRACE (std::string (neighborhood) + ", " + weights);
      options.neighbors.kind = kind;
      options.disc.weighting = weighting;
      EXPECT_EQ (unordered (meshOf (points, options).triangles), unordered (expected.triangles));
    }
}

TEST (Choices, OfNeighborhoodShowInTheMatrix)
{
  const auto nonzeros = [] (Neighborhood neighborhood, double radius) {
    const Sheet sheet = smallSheet (0.7);
    Options options = discOptions (indices (sheet.border));
    options.neighbors.kind = neighborhood;
    options.neighbors.ball_radius = radius;
    const Statistics statistics =
        reconstruct (asInput (sheet.positions), options).report.statistics;
    return static_cast<double> (statistics.nnz_matrix) / static_cast<double> (statistics.unknowns);
  };
  const double ball = nonzeros (Neighborhood::BALL, 2.5);
  EXPECT_GT (nonzeros (Neighborhood::NEAREST, 2.5),
             2.0 * nonzeros (Neighborhood::NEAREST_DELAUNAY, 2.5));
  EXPECT_GT (ball, 2.0 * nonzeros (Neighborhood::BALL_DELAUNAY, 2.5));
  EXPECT_GT (nonzeros (Neighborhood::BALL, 3.5), 1.2 * ball);
}

TEST (Reconstruct, FewestPoints)
{
  const Positions square = {{0, 0, 0}, {1, 0, 0}, {1, 1.1, 0}, {0, 1, 0}};
  expectDisc (reconstruct (asInput (square), discOptions ()), 4);
  const Options options = discOptions ({2, 3, 0, 1});
  const Result given = reconstruct (asInput (square), options);
  expectDisc (given, 4);
  EXPECT_EQ (given.report.loop, options.disc.boundary.loop);
  Positions with_middle = square;
  with_middle.emplace_back (0.4, 0.6, 0.1);
  expectDisc (reconstruct (asInput (with_middle), options), 5);
}

// Each coordinate is a double, but not the sum of the edges of the boundary.
TEST (Reconstruct, LengthsOfHugeCloudsAreFinite)
{
  Positions square;
  for (int i = 0; i < 36; ++i)
    square.emplace_back (2e307 * (i / 6), 2e307 * (i % 6) + 1e306 * (i / 6), 0.0);
  const Result result = meshOf (square);
  ASSERT_EQ (result.report.check.loops.size (), 1U);
  EXPECT_EQ (result.report.check.loops[0].length, std::numeric_limits<double>::max ());
  EXPECT_NEAR (result.report.check.loops[0].width, 1.45e308, 0.05e308);
  EXPECT_TRUE (std::isfinite (result.report.check.longest_edge));
}

TEST (Reconstruct, ManyCoincidingPointsAreToldOf)
{
  const Positions distinct = surface (SurfaceKind::HEIGHT_FIELD, 500);
  for (const std::size_t repeated : {1U, 20U}) {
    Positions positions = distinct;
    positions.insert (positions.end (), distinct.begin (),
                      distinct.begin () + static_cast<std::ptrdiff_t> (repeated));
    const Result result = meshOf (positions);
    EXPECT_EQ (warns (result.report, "20 points coincide with another one"), repeated == 20);
    EXPECT_EQ (result.report.statistics.duplicate_points, repeated);
  }
}

// Of two equal points that look like an outlier the given loop names the second, which the first
// stands for.
TEST (Reconstruct, AGivenLoopKeepsADuplicateThatIsAnOutlier)
{
  const Sheet sheet = disc (0.1, 21);
  Positions positions = sheet.positions;
  const Eigen::Vector3d far = {0.0, 3.0, 0.0};
  positions.push_back (far);
  positions.push_back (far);
  const auto second = static_cast<Index> (positions.size () - 1);
  Options options = discOptions ();
  ASSERT_EQ (reconstruct (asInput (positions), options).report.outliers.size (), 1U);
  options.disc.boundary.loop = indices (sheet.border);
  options.disc.boundary.loop.push_back (second);
  const Result result = meshOf (positions, options);
  EXPECT_TRUE (result.report.outliers.empty ());
  EXPECT_EQ (result.report.loop.size (), options.disc.boundary.loop.size ());
}

#ifdef __GLIBC__
// The caller may have invalid operations end the program: those of the library do not, and the caller
// still has it so afterwards.
TEST (Reconstruct, NumbersOfTheLibraryDoNotTrap)
{
  const auto run = [] (const Positions& positions) {
    constexpr int TRAPS = FE_INVALID | FE_DIVBYZERO;
    Options options;
    options.threads = 2;
    feenableexcept (TRAPS);
    const Result result = reconstruct (positions, options);
    computeTextureCoordinates (positions, result.triangles, {});
    EXPECT_EQ (fegetexcept (), TRAPS);
    fedisableexcept (FE_ALL_EXCEPT);
    EXPECT_NE (result.report.status, RunStatus::INTERNAL_ERROR);
  };
  run (latticeCube (8));
  Positions pencil; // segments from one point, which stars see end on
  for (int i = 0; i < 200; ++i)
    for (int k = 1; k < 6; ++k)
      pencil.push_back (k * randomPoints (200, 3)[static_cast<std::size_t> (i)]);
  run (pencil);
}
#endif

} // namespace
} // namespace pcl::floater

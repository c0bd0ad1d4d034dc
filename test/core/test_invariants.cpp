// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What must not matter to a result, for every method: threads, the order of the points, a power of
// two, a motion; and cancellation at any moment. A mesh has several ranges of points, so that threads share it.
#include "mesh/known_meshes.h"
#include "samples.h"
#include "scan_samples.h"
#include "surfaces.h"

#include <pcl/surface/floater/reconstruct.h>
#include <pcl/surface/floater/texture_coordinates.h>
#include <pcl/surface/floater/vertex_normals.h>

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;

/// A method and a cloud. The points have no ties in their coordinates, and none is there twice, so that
/// rounding and order decide nothing.
struct Invariant
{
  const char* name;
  std::function<Positions (bool is_large)> points;
  Options options{};
  double moved_share = 0.005; ///< of triangles that a motion may change

  bool isCalled (const std::string& other) const { return other == name; }
};

void
PrintTo (const Invariant& one, std::ostream* out)
{
  *out << one.name;
}

std::function<Positions (bool)>
noisy (SurfaceKind kind, double noise, std::size_t large, bool with_outliers = false)
{
  return [=] (bool is_large) {
    Positions points = generateSurface ({kind, is_large ? large : 600, 5, 1.0, noise});
    for (int i = 0; with_outliers && i < 5; ++i)
      points.emplace_back (31.3 * i * i, 200.1 - 7.7 * i, 90.3 + 11.1 * i);
    return points;
  };
}

Positions
frame (bool is_large)
{
  const Scan scan = scanScene (Raster::CAMERA, {0.01, 0.0}, 7);
  Positions points;
  for (std::size_t p = 0; p < scan.points.size (); p += is_large ? 1 : 8)
    points.push_back (scan.points[p]);
  return points;
}

// Every point three times, up to a fifth of the spacing apart.
Positions
stacks (bool is_large)
{
  Positions points = noisy (SurfaceKind::TORUS, 0.0, 3000) (is_large);
  RandomStream random (3);
  points.reserve (3 * points.size ());
  for (std::size_t p = 0, all = 2 * points.size (); p < all; ++p)
    points.emplace_back (points[p] + 0.05 * uniformVector (random));
  return points;
}

Options
with (void (*change) (Options&), Options options = {})
{
  change (options);
  return options;
}

std::vector<Invariant>
invariants ()
{
  using Kind = SurfaceKind;
  const auto disc = [] (void (*change) (Options&)) { return with (change, discOptions ()); };
  return {{"consensus", noisy (Kind::TORUS, 0.0, 40000, true)},
          // Fillings are sampled anew, and repaired.
          {"holes", noisy (Kind::CUT_OUT, 0.1, 5000),
           with ([] (Options& o) { o.holes.policy = HolePolicy::CLOSE_ALL; }), 0.12},
          {"denoised", noisy (Kind::SPHERE, 0.3, 3000), {}, 0.06}, // noise is sampled anew
          {"normals", noisy (Kind::HEMISPHERE, 0.0, 5000)},
          {"trimmed", noisy (Kind::FOLDED_SHEET, 0.1, 5000), with ([] (Options& o) {
             o.trimming.maximum_edge_ratio = 2.0;
             o.trimming.open_self_intersections = true;
           })},
          {"balls", noisy (Kind::TORUS, 0.0, 5000),
           with ([] (Options& o) { o.neighbors.kind = Neighborhood::BALL_DELAUNAY; })},
          // They come into the mesh along a curve that follows the axes.
          {"stacks", stacks, {}, 0.5},
          {"view", frame, {}, 0.5}, // the place that is found decides diagonals
          {"disc", noisy (Kind::FINGER, 0.0, 20000), discOptions ()},
          {"disc_consensus_loop", noisy (Kind::HEMISPHERE, 0.0, 3000),
           disc ([] (Options& o) { o.disc.boundary.method = BoundaryMethod::CONSENSUS; })},
          {"disc_two_segments", noisy (Kind::HEIGHT_FIELD, 0.0, 3000), disc ([] (Options& o) {
             o.disc.boundary.method = BoundaryMethod::TWO_SEGMENTS;
             o.disc.boundary.cluster_tolerance = 0.2;
           })},
          {"disc_iterative", noisy (Kind::HEIGHT_FIELD, 0.0, 3000),
           disc ([] (Options& o) { o.disc.solver.method = Solver::BICGSTAB_ILUT; })},
          {"tw385", noisy (Kind::HEIGHT_FIELD, 0.0, 20000), with ([] (Options& o) {
             o.disc = DiscOptions::tw385 ();
             o.disc.boundary.cluster_tolerance = 0.2;
           })}};
}

class Invariants : public testing::TestWithParam<Invariant>
{
protected:
  Result run (const Positions& points, const Options& options) const
  {
    Input input = asInput (points);
    if (GetParam ().isCalled ("normals")) // for facing
      for (const Eigen::Vector3d& p : points)
        input.facing_normals.push_back ((-p.stableNormalized ()).cast<float> ());
    return reconstruct (std::move (input), options);
  }
  Result run (const Positions& points) const { return run (points, GetParam ().options); }
};

TEST_P (Invariants, ThreadsChangeNothing)
{
  const Positions points = GetParam ().points (true);
  Options options = GetParam ().options;
  options.threads = 1;
  const Result expected = run (points, options);
  ASSERT_EQ (expected.report.status, RunStatus::SUCCESS) << expected.report.message;
  EXPECT_EQ (expected.report.is_view, GetParam ().isCalled ("view"));
  for (const int threads : {2, 5}) {
    SCOPED_TRACE (threads);
    options.threads = threads;
    const Result result = run (points, options);
    // Everything in it that is not a time.
    const Report &a = result.report, &b = expected.report;
    ASSERT_EQ (a.status, b.status) << a.message;
    EXPECT_EQ (a.message, b.message);
    EXPECT_TRUE (result.triangles == expected.triangles);
    EXPECT_EQ (a.loop, b.loop);
    EXPECT_TRUE (a.parameters == b.parameters);
    EXPECT_EQ (a.outliers, b.outliers);
    EXPECT_EQ (a.unused, b.unused);
    EXPECT_EQ (a.scatter, b.scatter);
    EXPECT_EQ (a.viewpoint, b.viewpoint);
    EXPECT_EQ (a.facing_certainty, b.facing_certainty);
    EXPECT_EQ (a.facing_parts, b.facing_parts);
    EXPECT_EQ (a.warnings, b.warnings);
    EXPECT_EQ (a.check.longest_edge, b.check.longest_edge);
    EXPECT_EQ (a.check.folds, b.check.folds);
    EXPECT_EQ (a.check.self_intersections, b.check.self_intersections);
  }
}

TEST_P (Invariants, OrderAndPowersOfTwoChangeNothing)
{
  // Triangles from their smallest corners on, in any order.
  const auto relabelled = [] (const Result& result, const std::vector<Index>& label) {
    std::set<Triangle> set;
    for (Triangle t : result.triangles) {
      for (Index& p : t)
        p = label[p];
      std::rotate (t.begin (), std::min_element (t.begin (), t.end ()), t.end ());
      set.insert (t);
    }
    return set;
  };
  const Positions points = GetParam ().points (false);
  const Result expected = run (points);
  ASSERT_EQ (expected.report.status, RunStatus::SUCCESS) << expected.report.message;
  const std::vector<Index> order = permutation (points.size (), 17);
  Positions permuted;
  for (const Index p : order)
    permuted.push_back (points[p]);
  const Result again = run (permuted);
  EXPECT_EQ (relabelled (again, order), relabelled (expected, indices (points.size ())));
  for (std::size_t p = 0; p < again.report.parameters.size (); ++p)
    EXPECT_EQ (again.report.parameters[p], expected.report.parameters[order[p]]);
  for (const double scale : {0x1p-900, 0x1p3, 0x1p900})
    EXPECT_EQ (run (placed (points, {0, 0, 0}, scale)).triangles, expected.triangles) << scale;
}

// A motion rounds the coordinates, and turns the axes that the order of the points and the front of an open
// surface follow. So the mesh is the same but for edges whose flip is a tie within rounding.
TEST_P (Invariants, MotionChangesFewTriangles)
{
  const Positions points = GetParam ().points (true);
  const Result expected = run (points);
  const std::set<Triangle> before = unordered (expected.triangles);
  const Eigen::Affine3d turn (Eigen::AngleAxisd (1.1, Eigen::Vector3d (1, -2, 3).normalized ()));
  for (const Eigen::Affine3d& motion :
       {Eigen::Affine3d (Eigen::Translation3d (1e4, -3e3, 70) * turn),
        Eigen::Affine3d (turn * Eigen::Scaling (1e-7))}) {
    Positions moved;
    for (const Eigen::Vector3d& p : points)
      moved.push_back (motion * p);
    const Result result = run (moved);
    ASSERT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
    EXPECT_EQ (result.report.check.euler_characteristic,
               expected.report.check.euler_characteristic);
    EXPECT_EQ (result.report.check.loops.size (), expected.report.check.loops.size ());
    double other = 0.0;
    for (const Triangle& t : unordered (result.triangles))
      other += before.count (t) == 0 ? 1.0 : 0.0;
    EXPECT_LE (other, GetParam ().moved_share * static_cast<double> (before.size ()));
  }
}

TEST_P (Invariants, CancellationEndsARunWhereverItIsAskedFor)
{
  const Positions points = GetParam ().points (false);
  Options options = GetParam ().options;
  for (const int threads : {1, 3}) {
    options.threads = threads;
    int questions = 0;
    options.cancelled_callback = [&] { return ++questions < 0; };
    ASSERT_EQ (run (points, options).report.status, RunStatus::SUCCESS);
    const int all = questions;
    EXPECT_GE (all, 5);
    constexpr int MOST = 40; // moments, spread over the run
    for (int last = 1; last <= all; last += std::max (1, all / MOST)) {
      questions = 0;
      options.cancelled_callback = [&] { return ++questions == last; };
      const Result result = run (points, options);
      if (questions < last)
        continue; // the number of questions depends on time
      EXPECT_EQ (result.report.status, RunStatus::CANCELLED);
      EXPECT_NE (result.report.message, "");
      EXPECT_TRUE (result.triangles.empty ());
      EXPECT_TRUE (result.report.loop.empty ());
      EXPECT_TRUE (result.report.parameters.empty ());
      EXPECT_EQ (questions, last) << "asked again after the cancellation";
    }
  }
}

INSTANTIATE_TEST_SUITE_P (Methods, Invariants, testing::ValuesIn (invariants ()),
                          [] (const auto& one) { return std::string (one.param.name); });

TEST (Invariants, ThreadsDoNotChangeNormalsAndTexture)
{
  Mesh mesh = torus (90, 40);
  RandomStream random (7);
  for (Eigen::Vector3d& p : mesh.positions)
    p += 0.01 * uniformVector (random);
  TextureOptions options;
  options.threads = 1;
  const TextureCoordinates one =
      computeTextureCoordinates (mesh.positions, mesh.triangles, options);
  ASSERT_EQ (one.status, RunStatus::SUCCESS);
  options.threads = 3;
  const TextureCoordinates three =
      computeTextureCoordinates (mesh.positions, mesh.triangles, options);
  EXPECT_TRUE (one.coordinates == three.coordinates);
  EXPECT_EQ (one.corners, three.corners);
  EXPECT_EQ (vertexNormals (mesh.positions, mesh.triangles, 1),
             vertexNormals (mesh.positions, mesh.triangles, 7));
}

} // namespace
} // namespace pcl::floater

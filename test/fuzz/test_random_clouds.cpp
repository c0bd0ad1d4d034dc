// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds that are hard on a reconstruction: no result is wrong, and what must not matter does not.
#include "random_attack.h"
#include "result_oracle.h"

#include "samples.h"
#include "surfaces.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace pcl::floater {
namespace {
using samples::asInput;
using samples::Positions;

// Clouds of each size. PCL_FLOATER_RANDOM_CLOUDS asks for another number.
std::uint64_t
cloudsWanted ()
{
  constexpr std::uint64_t FEW = 60;
  const char* const wanted = std::getenv ("PCL_FLOATER_RANDOM_CLOUDS");
  return wanted == nullptr ? FEW : std::strtoull (wanted, nullptr, 10);
}

class RandomClouds : public testing::TestWithParam<std::size_t>
{
};

TEST_P (RandomClouds, GiveNoWrongResult)
{
  std::size_t meshes = 0;
  for (std::uint64_t seed = 1; seed <= cloudsWanted (); ++seed) {
    const fuzz::Attack attack = fuzz::randomAttack (seed, GetParam ());
    const Result result = reconstruct (attack.input, attack.options);
    EXPECT_EQ (fuzz::findFault (attack.input, result), "") << "seed " << seed;
    meshes += result.report.status == RunStatus::SUCCESS ? 1 : 0;
  }
  EXPECT_GE (3 * meshes, cloudsWanted ()) << "the clouds are too hopeless to test much";
}

TEST_P (RandomClouds, GiveTheSameMeshWithAnyNumberOfThreads)
{
  constexpr std::uint64_t OTHERS = 1000;
  for (std::uint64_t seed = OTHERS; seed < OTHERS + cloudsWanted () / 4; ++seed) {
    fuzz::Attack attack = fuzz::randomAttack (seed, GetParam ());
    attack.options.threads = 1;
    const Result expected = reconstruct (attack.input, attack.options);
    attack.options.threads = 3;
    const Result result = reconstruct (attack.input, attack.options);
    EXPECT_EQ (result.report.status, expected.report.status) << "seed " << seed;
    EXPECT_EQ (result.triangles, expected.triangles) << "seed " << seed;
    EXPECT_EQ (result.report.unused, expected.report.unused) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P (Points, RandomClouds, testing::Values (12, 60, 300));

// The oracle itself: it sees what is wrong.
TEST (ResultOracle, SeesFaults)
{
  SurfaceSpec spec;
  spec.kind = SurfaceKind::HEMISPHERE;
  spec.points = 300;
  Input input = asInput (generateSurface (spec));
  input.positions[7] = input.positions[11];
  input.positions[40].x () = std::numeric_limits<double>::quiet_NaN ();
  const Result right = reconstruct (input, {});
  ASSERT_EQ (right.report.status, RunStatus::SUCCESS);
  EXPECT_EQ (fuzz::findFault (input, right), "");
  const auto expectFault = [&] (const auto& change, const std::string& what) {
    Result wrong = right;
    change (wrong);
    const std::string fault = fuzz::findFault (input, wrong);
    EXPECT_NE (fault.find (what), std::string::npos) << "'" << fault << "', not '" << what << "'";
  };
  const auto first = [] (Result& result) -> Triangle& { return result.triangles.front (); };
  expectFault ([&] (Result& r) { std::swap (first (r)[0], first (r)[1]); }, "no oriented manifold");
  expectFault ([&] (Result& r) { r.triangles.push_back (first (r)); }, "no oriented manifold");
  expectFault ([] (Result& r) { r.triangles.pop_back (); }, "the check counts");
  expectFault ([&] (Result& r) { first (r)[0] = 300; }, "point 300 is in the mesh, but was not");
  expectFault ([] (Result& r) { r.triangles.clear (); }, "no triangles");
  expectFault ([] (Result& r) { r.report.non_finite.clear (); }, "nothing is said of point 40");
  expectFault ([] (Result& r) { r.report.unused = {5}; }, "point 5 is unused and in the mesh");
  expectFault ([] (Result& r) { r.report.duplicates.front ()[1] = 0; }, "is no duplicate of 0");
  expectFault ([] (Result& r) { ++r.report.statistics.used_points; }, "counts of points");
  expectFault ([] (Result& r) { r.report.check.euler_characteristic = 2; }, "the check counts");
  expectFault ([] (Result& r) { r.report.status = RunStatus::INTERNAL_ERROR; }, "INTERNAL_ERROR");
  expectFault ([] (Result& r) { r.report.status = RunStatus::DEGENERATE; }, "has triangles");
}

// Triangles in any order, each from its smallest corner; seen from either side if `either`.
std::set<Triangle>
asSet (const std::vector<Triangle>& triangles, bool either)
{
  std::set<Triangle> set;
  for (Triangle t : triangles) {
    std::rotate (t.begin (), std::min_element (t.begin (), t.end ()), t.end ());
    if (either && t[2] < t[1])
      std::swap (t[1], t[2]);
    set.insert (t);
  }
  return set;
}

struct Cloud
{
  const char* name;
  Positions positions;
  bool is_closed;
};

// Surfaces without ties in their coordinates and distances, so that rounding decides nothing.
std::vector<Cloud>
surfacesWithoutTies ()
{
  std::vector<Cloud> clouds;
  for (const auto& [kind, name] :
       {std::pair{SurfaceKind::TORUS, "torus"}, std::pair{SurfaceKind::SPHERE, "sphere"},
        std::pair{SurfaceKind::CUT_OUT, "sheet with holes"},
        std::pair{SurfaceKind::HEMISPHERE, "hemisphere"}}) {
    SurfaceSpec spec;
    spec.kind = kind;
    spec.points = 2500;
    spec.seed = 5;
    const bool is_closed = kind == SurfaceKind::TORUS || kind == SurfaceKind::SPHERE;
    clouds.push_back ({name, generateSurface (spec), is_closed});
  }
  return clouds;
}

Positions
moved (const Positions& points, const Eigen::Affine3d& motion)
{
  Positions result;
  for (const Eigen::Vector3d& p : points)
    result.push_back (motion * p);
  return result;
}

// The order of the points and a scale by a power of two change no bit of what is computed.
TEST (Invariance, OrderAndPowersOfTwoChangeNothing)
{
  for (const Cloud& cloud : surfacesWithoutTies ()) {
    SCOPED_TRACE (cloud.name);
    const Result expected = reconstruct (asInput (cloud.positions), {});
    ASSERT_EQ (expected.report.status, RunStatus::SUCCESS) << expected.report.message;
    for (const double scale : {0x1p-900, 0x1p-20, 0x1p3, 0x1p900})
      EXPECT_EQ (
          reconstruct (asInput (moved (cloud.positions, Eigen::Affine3d (Eigen::Scaling (scale)))),
                       {})
              .triangles,
          expected.triangles)
          << scale;
    for (const std::uint64_t seed : {1U, 2U}) {
      const std::vector<Index> order = samples::permutation (cloud.positions.size (), seed);
      Positions permuted;
      for (const Index p : order)
        permuted.push_back (cloud.positions[p]);
      Result result = reconstruct (asInput (permuted), {});
      for (Triangle& t : result.triangles)
        for (Index& p : t)
          p = order[p];
      EXPECT_EQ (asSet (result.triangles, false), asSet (expected.triangles, false));
    }
  }
}

// A rigid motion rounds the coordinates, and turns the axes that the order of the points and the
// front of an open surface follow. So the mesh is the same but for edges whose flip is a tie within
// rounding: up to one triangle in two hundred.
TEST (Invariance, RigidMotionChangesFewTriangles)
{
  constexpr std::size_t MOST = 200;
  for (const Cloud& cloud : surfacesWithoutTies ()) {
    SCOPED_TRACE (cloud.name);
    const Result expected = reconstruct (asInput (cloud.positions), {});
    const std::set<Triangle> before = asSet (expected.triangles, !cloud.is_closed);
    Eigen::Matrix3d cyclic;
    cyclic << 0, 1, 0, 0, 0, 1, 1, 0, 0;
    const Eigen::Affine3d turn (Eigen::AngleAxisd (1.1, Eigen::Vector3d (1, -2, 3).normalized ()));
    for (const Eigen::Affine3d& motion :
         {Eigen::Affine3d (cyclic), turn,
          Eigen::Affine3d (Eigen::Translation3d (1e4, -3e3, 70) * turn),
          Eigen::Affine3d (Eigen::Scaling (1e-7))}) {
      const Result result = reconstruct (asInput (moved (cloud.positions, motion)), {});
      ASSERT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
      EXPECT_EQ (result.report.check.euler_characteristic,
                 expected.report.check.euler_characteristic);
      EXPECT_EQ (result.report.check.loops.size (), expected.report.check.loops.size ());
      std::size_t other = 0;
      for (const Triangle& t : asSet (result.triangles, !cloud.is_closed))
        other += before.count (t) == 0 ? 1 : 0;
      EXPECT_LE (other * MOST, before.size ());
    }
  }
}

} // namespace
} // namespace pcl::floater

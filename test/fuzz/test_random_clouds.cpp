// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds that are hard on a reconstruction: no result is wrong.
#include "attack.h"

#include "samples.h"
#include "surfaces.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace pcl::floater {
namespace {
using samples::asInput;

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
  EXPECT_GE (4 * meshes, cloudsWanted ()) << "the clouds are too hopeless to test much";
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

} // namespace
} // namespace pcl::floater

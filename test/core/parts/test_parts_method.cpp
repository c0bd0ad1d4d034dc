// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The whole method on surfaces in many small parts.
#include "parts/parts_method.h"

#include "mesh_oracle.h"
#include "options/stage_limits.h"
#include "part_samples.h"
#include "reconstruct.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pcl::floater {
namespace {
using samples::Positions;
using samples::surface;

constexpr std::size_t WHOLE = 0;

Result
reconstructInParts (const Positions& positions, std::size_t points_of_part, int threads = 2,
                    std::size_t rings = PartLimits ().rings)
{
  Input input;
  input.positions = positions;
  input.cloud_index = samples::indices (positions.size ());
  input.cloud_size = positions.size ();
  Options options;
  options.threads = threads;
  Limits limits;
  if (points_of_part != WHOLE)
    limits.parts.points = points_of_part;
  limits.parts.rings = rings;
  return reconstruct (std::move (input), options, limits);
}

// Each triangle from its smallest corner on, ascending.
std::vector<std::array<std::uint32_t, 3>>
inOrder (const Result& result)
{
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto& t : result.triangles) {
    std::array<std::uint32_t, 3> corners{t[0], t[1], t[2]};
    std::rotate (corners.begin (), std::min_element (corners.begin (), corners.end ()),
                 corners.end ());
    triangles.push_back (corners);
  }
  std::sort (triangles.begin (), triangles.end ());
  return triangles;
}

double
shareInCommon (const Result& a, const Result& b)
{
  const auto first = inOrder (a), second = inOrder (b);
  std::vector<std::array<std::uint32_t, 3>> both;
  std::set_intersection (first.begin (), first.end (), second.begin (), second.end (),
                         std::back_inserter (both));
  return static_cast<double> (both.size ()) /
         static_cast<double> (std::max (first.size (), second.size ()));
}

void
expectSameShape (const Result& parts, const Result& whole)
{
  ASSERT_EQ (parts.report.status, RunStatus::SUCCESS) << parts.report.message;
  EXPECT_EQ (parts.report.statistics.used_points, whole.report.statistics.used_points);
  EXPECT_EQ (parts.report.check.nonmanifold_edges, 0U);
  EXPECT_EQ (parts.report.check.nonmanifold_vertices, 0U);
  EXPECT_EQ (parts.report.check.orientation_conflicts, 0U);
  EXPECT_EQ (parts.report.check.components, whole.report.check.components);
  EXPECT_EQ (parts.report.check.loops.size (), whole.report.check.loops.size ());
  EXPECT_EQ (parts.report.check.genus, whole.report.check.genus);
  EXPECT_LE (parts.report.check.folds, whole.report.check.folds);
}

class SurfaceInParts : public testing::TestWithParam<SurfaceKind>
{
};

// Measured: 99.8 % and more of the triangles of clean surfaces in parts of 600 points are those of
// the whole, of which 8 % of the points are beside another part.
TEST_P (SurfaceInParts, IsThatOfTheWhole)
{
  const Positions positions = surface (GetParam (), 6000);
  const Result whole = reconstructInParts (positions, WHOLE);
  ASSERT_EQ (whole.report.status, RunStatus::SUCCESS);
  for (const std::size_t size : {600U, 2500U}) {
    const Result parts = reconstructInParts (positions, size);
    expectSameShape (parts, whole);
    EXPECT_GT (shareInCommon (parts, whole), 0.99);
  }
}

TEST_P (SurfaceInParts, NoiseDoesNotTearPartsApart)
{
  const Positions positions = surface (GetParam (), 5000, 0.25);
  expectSameShape (reconstructInParts (positions, 700), reconstructInParts (positions, WHOLE));
}

INSTANTIATE_TEST_SUITE_P (Surfaces, SurfaceInParts,
                          testing::Values (SurfaceKind::HEIGHT_FIELD, SurfaceKind::CUT_OUT,
                                           SurfaceKind::HEMISPHERE, SurfaceKind::SPHERE,
                                           SurfaceKind::TORUS, SurfaceKind::FINGER),
                          [] (const testing::TestParamInfo<SurfaceKind>& one) {
                            std::string name = surfaceName (one.param);
                            name.erase (std::remove (name.begin (), name.end (), '-'), name.end ());
                            return name;
                          });

// More of the parts is looked at until that is enough.
TEST (PartsMethod, FewRingsAreWidened)
{
  const Positions positions = surface (SurfaceKind::CUT_OUT, 4000);
  expectSameShape (reconstructInParts (positions, 700, 2, 1),
                   reconstructInParts (positions, WHOLE));
}

TEST (PartsMethod, ObjectsInSeveralPartsFaceOutwards)
{
  Positions positions = surface (SurfaceKind::SPHERE, 3000);
  for (const Eigen::Vector3d& p : surface (SurfaceKind::TORUS, 3000))
    positions.push_back (p + Eigen::Vector3d (500.0, 0.0, 0.0));
  const Result whole = reconstructInParts (positions, WHOLE);
  const Result parts = reconstructInParts (positions, 400);
  expectSameShape (parts, whole);
  ASSERT_EQ (parts.report.check.components, 2U);
  double volume = 0.0;
  for (const auto& t : parts.triangles)
    volume += positions[t[0]].dot (positions[t[1]].cross (positions[t[2]]));
  EXPECT_GT (volume, 0.0);
}

// In the first part there is nothing but a few points apart from all others.
TEST (PartsMethod, PointsOfNoTriangleAreTold)
{
  Positions positions = surface (SurfaceKind::HEIGHT_FIELD, 3000);
  for (int i = 0; i < 3; ++i)
    positions.emplace_back (-3000.0 - 900.0 * i, 40.0 * i * i, 500.0 * i);
  const Result whole = reconstructInParts (positions, WHOLE);
  const Result parts = reconstructInParts (positions, 500);
  ASSERT_EQ (parts.report.status, whole.report.status);
  EXPECT_EQ (parts.report.statistics.used_points, whole.report.statistics.used_points);
}

} // namespace
} // namespace pcl::floater

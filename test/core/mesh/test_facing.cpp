// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Which side of a surface becomes its front, and what that is decided by.
#include "mesh/facing.h"

#include "facing_cases.h"
#include "mesh/known_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace pcl::floater {
namespace {
using facing_cases::makeBowl;
using namespace samples;

// Meshes that face as they should.
std::vector<std::pair<const char*, Mesh>>
forms ()
{
  const auto square = [] (const std::function<Eigen::Vector3d (double, double)>& shape) {
    return cells (40, 40, [&] (Index x, Index y) { return shape (x / 40.0, y / 40.0); });
  };
  const auto terrain = [&square] (const std::function<double (double, double)>& height) {
    return square ([&] (double u, double v) { return Eigen::Vector3d (u, v, height (u, v)); });
  };
  const auto tube = [] (Index rows) {
    return cells (
        40, rows,
        [] (Index x, Index y) {
          return Eigen::Vector3d (std::cos (PI * x / 20.0), std::sin (PI * x / 20.0), 0.075 * y);
        },
        true);
  };
  return {
      {"long tube", tube (100)},
      {"tube", tube (40)},
      {"short tube", tube (3)},
      {"half sphere", makeBowl (0.5)},
      {"nearly a sphere", makeBowl (0.975)},
      {"bowl", makeBowl (0.35)},
      {"flat", terrain ([] (double, double) { return 1.0; })},
      {"hills", terrain ([] (double u, double v) {
         return 0.1 * std::sin (9.0 * u) * std::cos (7.0 * v) + 0.3 * u;
       })},
      {"folds in a valley", terrain ([] (double u, double v) {
         return 0.2 * std::sin (12.0 * u) + 0.7 * std::pow (std::hypot (u - 0.5, v - 0.5), 2.0);
       })},
      {"steep folds", terrain ([] (double u, double v) {
         return 0.3 * std::sin (12.0 * u) + 0.02 * std::sin (9.0 * v);
       })},
      {"shallow valley", terrain ([] (double u, double v) {
         return 0.3 * (std::pow (u - 0.5, 2.0) + std::pow (v - 0.5, 2.0));
       })},
      {"pit with slopes of 45 degrees", terrain ([] (double u, double v) {
         return std::clamp (std::hypot (u - 0.5, v - 0.5), 0.2, 0.45);
       })},
      {"upright in y",
       square ([] (double u, double v) { return Eigen::Vector3d (-u, -0.1 * u, v); })},
      {"upright in x",
       square ([] (double u, double v) { return Eigen::Vector3d (0.1 * u, u, v); })},
      {"of equal slope", square ([] (double u, double v) { return Eigen::Vector3d (u, v, u); })}};
}

TEST (Facing, EveryFormFacesOneWayWhateverItDidBefore)
{
  for (const auto& [name, form] : forms ()) {
    SCOPED_TRACE (name);
    for (const bool is_turned : {false, true}) {
      Mesh given = form;
      if (is_turned)
        turnRound (given);
      TriangleMesh mesh = connected (given);
      EXPECT_EQ (faceOutwards (mesh, form.positions, {}, {}, 1).turned, is_turned ? 1U : 0U);
      EXPECT_TRUE (mesh.triangles == form.triangles);
      expectConsistent (mesh);
    }
  }
}

// Bodies with windows, hollows, bodies within others, torn surfaces.
TEST (Facing, GeneratedSurfacesFaceAsTheyShould)
{
  for (const facing_cases::Family& family : facing_cases::FAMILIES)
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE (family.name + std::to_string (seed));
      const Mesh one = makeFacingCase (family, seed);
      TriangleMesh mesh = connected (one);
      const MeshComponents components = findComponents (mesh, 1);
      RandomStream random (seed);
      std::vector<std::uint8_t> is_turned (components.count);
      for (std::uint8_t& turned : is_turned)
        turned = static_cast<std::uint8_t> (random.below (2));
      for (std::size_t t = 0; t < mesh.triangles.size (); ++t)
        if (is_turned[components.of_triangle[t]] != 0)
          std::swap (mesh.triangles[t][1], mesh.triangles[t][2]);
      mesh.connect (one.positions.size (), 1);
      faceOutwards (mesh, one.positions, {}, {}, 1);
      EXPECT_TRUE (mesh.triangles == one.triangles);
      expectConsistent (mesh);
    }
}

MeshFacing
faced (const Mesh& one, const FacingHints& hints = {})
{
  TriangleMesh mesh = connected (one);
  return faceOutwards (mesh, one.positions, hints, {}, 1);
}

// Of a cap that is a share f of its sphere, the front sees all of the outside, the back 1 - f, and
// the mean normal is as long.
TEST (Facing, ACapIsSeenAsTheoryTells)
{
  for (const double share : {0.3, 0.5, 0.7, 0.9}) {
    const MeshFacing facing = faced (makeBowl (share));
    ASSERT_EQ (facing.objects.size (), 1U);
    const FacingObject& object = facing.objects.front ();
    EXPECT_EQ (object.rule, FacingRule::BODY);
    EXPECT_GT (object.front, 0.98);
    EXPECT_NEAR (object.back, 1.0 - share, 0.06);
    EXPECT_NEAR (object.mean_normal, 1.0 - share, 0.01);
    EXPECT_EQ (facing.turned, 0U);
  }
}

TEST (Facing, ABowlBecomesAValleyWhereItIsUnsure)
{
  const auto certaintyOf = [] (double share, std::size_t turned) {
    const MeshFacing facing = faced (makeBowl (share));
    EXPECT_EQ (facing.turned, turned);
    return facing.objects.front ().certainty;
  };
  EXPECT_EQ (certaintyOf (0.15, 1), 1.0); // it was outwards, which is down
  EXPECT_LT (certaintyOf (0.27, 0), 0.75);
  EXPECT_NEAR (certaintyOf (0.5, 0), 0.8, 0.05); // half a body may as well be a bowl
  EXPECT_GT (certaintyOf (0.8, 0), 0.9);
}

// Sensors that saw all of the surface are tested with the whole method.
TEST (Facing, ASensorFromWhichHalfOfABodyIsHiddenIsNotFaced)
{
  FacingHints hints;
  hints.sensor = Eigen::Vector3d (2.0, 1.0, 1.0);
  const MeshFacing facing = faced (makeFacingCase (facing_cases::FAMILIES[0], 1), hints);
  EXPECT_NE (facing.objects.front ().rule, FacingRule::SENSOR);
  EXPECT_EQ (facing.turned, 0U);
}

TEST (Facing, WhatOneViewHasShownIsTurnedTogether)
{
  // A bowl, whose inside was seen, and a sheet beside it.
  Mesh sheet = samples::sheet (10);
  turnRound (sheet);
  const Mesh both = beside (makeBowl (0.6), sheet);
  FacingHints hints;
  for (const bool is_one_view : {false, true}) {
    hints.is_one_view = is_one_view;
    const MeshFacing facing = faced (both, hints);
    EXPECT_EQ (facing.objects.size (), is_one_view ? 1U : 2U);
    EXPECT_EQ (facing.turned, is_one_view ? 0U : 1U);
  }
}

} // namespace
} // namespace pcl::floater

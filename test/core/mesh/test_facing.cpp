// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/facing.h"

#include "facing_cases.h"
#include "samples.h"

#include <pcl/surface/floater/reconstruct.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace pcl::floater {
namespace {
using samples::PI;
using samples::Positions;
using Shape = std::function<Eigen::Vector3d (double, double)>;

constexpr int BODY_SIDE = 40;

double
hills (double x, double y)
{
  return 0.1 * std::sin (9.0 * x) * std::cos (7.0 * y) + 0.3 * x;
}

// A unit square laid on a surface; u, or u and v, may close up.
struct Patch
{
  Positions positions;
  TriangleMesh mesh;

  Patch (const Shape& shape, bool wraps_u, bool wraps_v, bool reversed = false)
  {
    const int columns = wraps_u ? BODY_SIDE : BODY_SIDE + 1,
              rows = wraps_v ? BODY_SIDE : BODY_SIDE + 1;
    for (int v = 0; v < rows; ++v)
      for (int u = 0; u < columns; ++u)
        positions.push_back (
            shape (static_cast<double> (u) / BODY_SIDE, static_cast<double> (v) / BODY_SIDE));
    const auto at = [&] (int u, int v) {
      return static_cast<Index> ((v % rows) * columns + u % columns);
    };
    for (int v = 0; v < BODY_SIDE; ++v)
      for (int u = 0; u < BODY_SIDE; ++u) {
        mesh.triangles.push_back ({at (u, v), at (u + 1, v), at (u + 1, v + 1)});
        mesh.triangles.push_back ({at (u, v), at (u + 1, v + 1), at (u, v + 1)});
      }
    if (reversed)
      for (Triangle& t : mesh.triangles)
        std::swap (t[0], t[1]);
    mesh.connect (positions.size (), 1);
  }
};

Eigen::Vector3d
normalOf (const Triangle& t, const Positions& positions)
{
  return (positions[t[1]] - positions[t[0]]).cross (positions[t[2]] - positions[t[0]]);
}

// Share of the triangles that face as `outside` says for their centroids.
double
shareFacing (const std::vector<Triangle>& triangles, const Positions& positions,
             const std::function<Eigen::Vector3d (const Eigen::Vector3d&)>& outside)
{
  std::size_t facing = 0;
  for (const Triangle& t : triangles) {
    const Eigen::Vector3d centroid = (positions[t[0]] + positions[t[1]] + positions[t[2]]) / 3.0;
    facing += normalOf (t, positions).dot (outside (centroid)) > 0.0 ? 1 : 0;
  }
  return static_cast<double> (facing) / static_cast<double> (triangles.size ());
}

// Expects the neighbours that connect () finds.
void
expectConnected (const TriangleMesh& mesh)
{
  TriangleMesh fresh;
  fresh.triangles = mesh.triangles;
  ASSERT_TRUE (fresh.connect (mesh.triangle_of.size (), 1));
  EXPECT_EQ (mesh.neighbors, fresh.neighbors);
  for (Index p = 0; p < mesh.triangle_of.size (); ++p) {
    if (mesh.triangle_of[p] == NONE)
      continue;
    const Triangle& t = mesh.triangles[mesh.triangle_of[p]];
    EXPECT_EQ (std::count (t.begin (), t.end (), p), 1);
  }
}

struct Form
{
  const char* name;
  Shape shape;
  std::function<Eigen::Vector3d (const Eigen::Vector3d&)> outside;
  bool wraps_u = false, wraps_v = false;
};

Eigen::Vector3d
awayFromRing (const Eigen::Vector3d& p)
{
  return p - Eigen::Vector3d (p.x (), p.y (), 0.0).normalized ();
}

Shape
bowl (double share_of_sphere)
{
  return [share_of_sphere] (double u, double v) {
    // A square laid on a disc, that on a cap of the sphere, open at the top.
    const double x = 2.0 * u - 1.0, y = 2.0 * v - 1.0;
    const Eigen::Vector2d disc (x * std::sqrt (1.0 - 0.5 * y * y),
                                y * std::sqrt (1.0 - 0.5 * x * x));
    const double angle = PI * share_of_sphere * disc.norm ();
    const Eigen::Vector2d side = disc.norm () > 0.0 ? disc.normalized () : disc;
    return Eigen::Vector3d (side.x () * std::sin (angle), side.y () * std::sin (angle),
                            5.0 - std::cos (angle));
  };
}

std::vector<Form>
forms ()
{
  const auto fromMiddle = [] (const Eigen::Vector3d& p) {
    return Eigen::Vector3d (p - Eigen::Vector3d (0.0, 0.0, 5.0));
  };
  const auto up = [] (const Eigen::Vector3d&) { return Eigen::Vector3d (0.0, 0.0, 1.0); };
  return {
      {"torus",
       [] (double u, double v) {
         const double radius = 1.0 + 0.3 * std::cos (2.0 * PI * v);
         return Eigen::Vector3d (radius * std::cos (2.0 * PI * u), radius * std::sin (2.0 * PI * u),
                                 0.3 * std::sin (2.0 * PI * v));
       },
       awayFromRing, true, true},
      {"tube",
       [] (double u, double v) {
         return Eigen::Vector3d (std::cos (2.0 * PI * u), std::sin (2.0 * PI * u), 3.0 * v);
       },
       [] (const Eigen::Vector3d& p) { return Eigen::Vector3d (p.x (), p.y (), 0.0); }, true},
      {"half sphere", bowl (0.5), fromMiddle},
      {"nearly a sphere", bowl (0.9), fromMiddle},
      {"bowl", bowl (0.4), fromMiddle},
      {"flat", [] (double u, double v) { return Eigen::Vector3d (u, v, 1.0); }, up},
      {"terrain", [] (double u, double v) { return Eigen::Vector3d (u, v, hills (u, v)); }, up},
      {"shallow valley",
       [] (double u, double v) {
         return Eigen::Vector3d (u, v, 0.3 * (std::pow (u - 0.5, 2.0) + std::pow (v - 0.5, 2.0)));
       },
       up},
      {"upright in y", [] (double u, double v) { return Eigen::Vector3d (u, 0.1 * u, v); },
       [] (const Eigen::Vector3d&) { return Eigen::Vector3d (0.0, 1.0, 0.0); }},
      {"upright in x", [] (double u, double v) { return Eigen::Vector3d (0.1 * u, u, v); },
       [] (const Eigen::Vector3d&) { return Eigen::Vector3d (1.0, 0.0, 0.0); }},
      {"of equal slope", [] (double u, double v) { return Eigen::Vector3d (u, v, u); }, up}};
}

TEST (Facing, EveryFormFacesOneWayWhateverItDidBefore)
{
  for (const Form& form : forms ()) {
    SCOPED_TRACE (form.name);
    std::size_t turned = 0;
    for (const bool reversed : {false, true}) {
      Patch patch (form.shape, form.wraps_u, form.wraps_v, reversed);
      turned += faceOutwards (patch.mesh, patch.positions, {}, {}, 1).turned;
      EXPECT_GT (shareFacing (patch.mesh.triangles, patch.positions, form.outside), 0.99);
      expectConnected (patch.mesh);
      EXPECT_EQ (faceOutwards (patch.mesh, patch.positions, {}, {}, 1).turned, 0U);
    }
    EXPECT_EQ (turned, 1U);
  }
}

TEST (Facing, AMeshOfNothingStaysNothing)
{
  TriangleMesh mesh;
  EXPECT_EQ (faceOutwards (mesh, {}, {}, {}, 1).turned, 0U);
  mesh.triangles = {{0, 1, 2}}; // without area
  ASSERT_TRUE (mesh.connect (3, 1));
  faceOutwards (mesh, Positions (3, Eigen::Vector3d::Zero ()), {}, {}, 1);
  EXPECT_EQ (mesh.triangles.size (), 1U);
}

// Bodies with thin parts, hollows, tubes, caps, terrain, scans, torn surfaces.
TEST (Facing, GeneratedSurfacesFaceAsTheyShould)
{
  using namespace facing_cases;
  constexpr std::uint64_t CASES = 2;
  for (std::size_t f = 0; f < static_cast<std::size_t> (Family::COUNT); ++f)
    for (std::uint64_t seed = 1; seed <= CASES; ++seed) {
      SCOPED_TRACE (std::string (familyName (static_cast<Family> (f))) + ", seed " +
                    std::to_string (seed));
      const FacingCase one = makeFacingCase (static_cast<Family> (f), seed);
      RandomStream random (seed);
      TriangleMesh mesh = turnAtRandom (one, random), with_threads = mesh;
      const MeshFacing facing = faceOutwards (mesh, one.positions, one.hints, {}, 1);
      EXPECT_EQ (wrongShare (one, mesh), 0.0);
      expectConnected (mesh);
      const MeshFacing same = faceOutwards (with_threads, one.positions, one.hints, {}, 3);
      EXPECT_EQ (mesh.triangles, with_threads.triangles);
      ASSERT_EQ (facing.objects.size (), same.objects.size ());
      for (std::size_t i = 0; i < same.objects.size (); ++i)
        EXPECT_EQ (facing.objects[i].certainty, same.objects[i].certainty);
    }
}

// Of a cap that is a share f of its sphere, the front sees all of the outside, the back 1 - f, and
// the mean normal is as long.
TEST (Facing, ACapIsSeenAsTheoryTells)
{
  for (const double share : {0.3, 0.5, 0.7, 0.9}) {
    const facing_cases::FacingCase one = facing_cases::makeBowl (share);
    TriangleMesh mesh = one.mesh;
    const MeshFacing facing = faceOutwards (mesh, one.positions, {}, {}, 1);
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
  const auto facingOf = [] (double share, std::size_t& turned) {
    const facing_cases::FacingCase one = facing_cases::makeBowl (share);
    TriangleMesh mesh = one.mesh;
    const MeshFacing facing = faceOutwards (mesh, one.positions, {}, {}, 1);
    turned = facing.turned;
    return facing.objects.front ().certainty;
  };
  std::size_t turned = 0;
  EXPECT_EQ (facingOf (0.15, turned), 1.0);
  EXPECT_EQ (turned, 1U); // it was outwards, which is down
  EXPECT_LT (facingOf (0.27, turned), 0.75);
  EXPECT_GT (facingOf (0.5, turned), 0.9);
  EXPECT_EQ (turned, 0U);
}

// The same bowl faces a sensor in it, but not one from which half of another body is hidden.
TEST (Facing, ASensorThatSawTheSurfaceIsFaced)
{
  const facing_cases::FacingCase bowl = facing_cases::makeBowl (0.6);
  TriangleMesh mesh = bowl.mesh;
  FacingHints hints;
  hints.sensor = Eigen::Vector3d (0.1, 0.0, 1.5);
  EXPECT_EQ (faceOutwards (mesh, bowl.positions, hints, {}, 1).objects.front ().rule,
             FacingRule::SENSOR);
  EXPECT_GT (facing_cases::wrongShare (bowl, mesh), 0.99);
  hints.sensor = Eigen::Vector3d (0.1, 0.0, -9.0);
  faceOutwards (mesh, bowl.positions, hints, {}, 1);
  EXPECT_EQ (facing_cases::wrongShare (bowl, mesh), 0.0);

  const facing_cases::FacingCase body =
      facing_cases::makeFacingCase (facing_cases::Family::WINGED_BODY, 1);
  mesh = body.mesh;
  hints.sensor = Eigen::Vector3d (2.0, 1.0, 1.0);
  EXPECT_NE (faceOutwards (mesh, body.positions, hints, {}, 1).objects.front ().rule,
             FacingRule::SENSOR);
  EXPECT_EQ (facing_cases::wrongShare (body, mesh), 0.0);
}

TEST (Facing, WhatOneViewHasShownIsTurnedTogether)
{
  // A bowl, whose inside was seen, and a sheet beside it.
  facing_cases::FacingCase one = facing_cases::makeBowl (0.6);
  const Patch sheet ([] (double u, double v) { return Eigen::Vector3d (u + 9.0, v, 0.0); }, false,
                     false, true);
  const auto offset = static_cast<Index> (one.positions.size ());
  one.positions.insert (one.positions.end (), sheet.positions.begin (), sheet.positions.end ());
  for (const Triangle& t : sheet.mesh.triangles)
    one.mesh.triangles.push_back ({t[0] + offset, t[1] + offset, t[2] + offset});
  ASSERT_TRUE (one.mesh.connect (one.positions.size (), 1));
  FacingHints hints;
  for (const bool is_one_view : {false, true}) {
    hints.is_one_view = is_one_view;
    TriangleMesh mesh = one.mesh;
    const MeshFacing facing = faceOutwards (mesh, one.positions, hints, {}, 1);
    EXPECT_EQ (facing.objects.size (), is_one_view ? 1U : 2U);
    EXPECT_EQ (facing.turned, is_one_view ? 0U : 1U);
  }
}

// The report on a cap of a sphere. \param share of its area
Report
reportOfCap (double share)
{
  const samples::Sheet sheet = samples::disc (0.05, 3);
  const double end = std::acos (1.0 - 2.0 * share);
  Positions points;
  for (const Eigen::Vector3d& p : sheet.positions) {
    const double angle = end * p.norm (), radius = std::max (1e-9, p.norm ());
    points.emplace_back (p.x () / radius * std::sin (angle), p.y () / radius * std::sin (angle),
                         -std::cos (angle));
  }
  return reconstruct (samples::asInput (points), {}).report;
}

TEST (Facing, TheReportTellsWhatIsNotSure)
{
  const Report sure = reportOfCap (0.6);
  EXPECT_GT (sure.facing_certainty, 0.9);
  EXPECT_TRUE (sure.facing_decisions.empty ());
  const Report unsure = reportOfCap (0.3);
  ASSERT_EQ (unsure.facing_decisions.size (), 1U);
  EXPECT_EQ (unsure.facing_decisions.front ().rule, FacingRule::BODY);
  EXPECT_EQ (unsure.facing_decisions.front ().certainty, unsure.facing_certainty);
  EXPECT_EQ (unsure.facing_decisions.front ().triangles, unsure.statistics.triangles);
  EXPECT_LT (unsure.facing_certainty, 0.9);
  EXPECT_GE (unsure.facing_certainty, 0.5);
}

} // namespace
} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What decides which side of a mesh is its front: normals of the input, and what the options ask
// for.
#include "samples.h"
#include "scan_samples.h"

#include <pcl/surface/floater/reconstruct.h>

#include <gtest/gtest.h>

#include <memory>

namespace pcl::floater {
namespace {
using Eigen::Vector3d;
using namespace samples;

const Direction UP = [] (const Vector3d&) { return Vector3d::UnitZ (); };
const Direction DOWN = [] (const Vector3d&) { return Vector3d (-Vector3d::UnitZ ()); };
const Direction OUT = [] (const Vector3d& p) { return p; };
const Direction IN = [] (const Vector3d& p) { return Vector3d (-p); };

// A round sheet of radius 1: z by the distance from its middle.
Positions
sheet (const std::function<double (double)>& height)
{
  Positions points = disc (0.06, 3).positions;
  for (Vector3d& p : points)
    p.z () = height (p.norm ());
  return points;
}

// The lower half of a sphere of radius 1, open at the top.
Positions
bowl ()
{
  constexpr std::size_t POINTS = 1300;
  return placed (surface (SurfaceKind::HEMISPHERE, POINTS), Vector3d::Zero (),
                 -1.0 / std::sqrt (static_cast<double> (POINTS) / (2.0 * PI)));
}

// What may tell the front.
struct Asked
{
  Facing facing = Facing::AUTO;
  Direction normal{};
  Vector3d sensor = Vector3d::Zero ();
};

Result
run (const Positions& points, const Asked& asked, Options options = {})
{
  options.facing = asked.facing;
  Input input = asInput (points);
  for (const Vector3d& p : points)
    if (asked.normal)
      input.facing_normals.push_back (asked.normal (p).cast<float> ());
  Eigen::Map<Vector3d> (input.sensor_origin.data ()) = asked.sensor;
  Result result = reconstruct (std::move (input), options);
  EXPECT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
  return result;
}

std::size_t
partsBy (const Result& result, FacingRule rule)
{
  return result.report.facing_parts[static_cast<std::size_t> (rule)];
}

// All of the mesh faces there, by one rule, with such a warning or none.
Report
expectFacing (const Positions& points, const Asked& asked, const Direction& there, FacingRule rule,
              const std::string& warning = "")
{
  const Result result = run (points, asked);
  EXPECT_EQ (shareFacing (result, points, there), 1.0);
  EXPECT_EQ (partsBy (result, rule), 1U) << facingRuleName (rule);
  EXPECT_EQ (result.report.warnings.empty (), warning.empty ());
  EXPECT_TRUE (warning.empty () || warns (result.report, warning)) << warning;
  return result.report;
}

TEST (FacingChoices, NormalsOfAClosedBody)
{
  const Positions body = evenSphere (1500);
  expectFacing (body, {Facing::AUTO}, OUT, FacingRule::CLOSED);
  expectFacing (body, {Facing::OUTWARDS, IN}, OUT, FacingRule::CLOSED);
  expectFacing (body, {Facing::INWARDS}, IN, FacingRule::CLOSED);
  const auto inwards = [] (double share) -> Direction {
    return [share, random = std::make_shared<RandomStream> (11)] (const Vector3d& p) {
      return Vector3d (random->uniform () < share ? -p : p);
    };
  };
  const Direction by_axis = [] (const Vector3d& p) { return Vector3d (p.z () < 0.0 ? -p : p); };
  const Direction nothing = [] (const Vector3d& p) {
    return Vector3d (p.x () < 0.0 ? 0.0 : std::nan (""), 0.0, 0.0);
  };
  for (const Facing facing : {Facing::AUTO, Facing::NORMALS}) {
    EXPECT_EQ (expectFacing (body, {facing, IN}, IN, FacingRule::NORMALS).facing_certainty, 1.0);
    const Report most = expectFacing (body, {facing, inwards (0.85)}, IN, FacingRule::NORMALS);
    EXPECT_NEAR (most.facing_certainty, 0.85, 0.03);
    ASSERT_EQ (most.facing_decisions.size (), 1U);
    EXPECT_EQ (most.facing_decisions.front ().rule, FacingRule::NORMALS);
    // As a principal component analysis leaves them: the sign of each is chance, or hangs on an axis.
    for (const Direction& normal : {inwards (0.65), inwards (0.5), by_axis})
      expectFacing (body, {facing, normal}, OUT, FacingRule::CLOSED,
                    "contradict each other on 1 part of the mesh, at point");
    expectFacing (body, {facing, nothing}, OUT, FacingRule::CLOSED,
                  facing == Facing::AUTO ? "" : "no point has a normal on 1 part of the mesh");
  }
}

TEST (FacingChoices, EveryComponentFacesByItsOwnNormals)
{
  const Vector3d other (5.0, 0.0, 0.0);
  const Positions bodies = joined (evenSphere (1500), evenSphere (1500, other));
  const Direction opposite = [&] (const Vector3d& p) {
    return p.x () < 2.5 ? Vector3d (-p) : Vector3d (p - other);
  };
  const Result two = run (bodies, {Facing::NORMALS, opposite});
  EXPECT_EQ (partsBy (two, FacingRule::NORMALS), 2U);
  EXPECT_EQ (shareFacing (two, bodies, opposite), 1.0);

  // Two halves of a sheet, which continue each other and would be turned together.
  Positions halves = disc (0.05, 3).positions;
  for (Vector3d& p : halves)
    p.x () += p.x () > 0.0 ? 0.15 : -0.15;
  const Direction by_half = [] (const Vector3d& p) {
    return Vector3d (0.0, 0.0, p.x () > 0.0 ? 1.0 : -1.0);
  };
  const Result together = run (halves, {});
  EXPECT_EQ (together.report.check.components, 2U);
  EXPECT_EQ (partsBy (together, FacingRule::SHEET), 1U);
  const Result apart = run (halves, {Facing::AUTO, by_half});
  EXPECT_EQ (partsBy (apart, FacingRule::NORMALS), 2U);
  EXPECT_EQ (shareFacing (apart, halves, by_half), 1.0);

  // One half has no normals, and follows the other one.
  const Result follows = run (halves, {Facing::NORMALS, [] (const Vector3d& p) {
                                         return Vector3d (0.0, 0.0, p.x () > 0.0 ? -1.0 : 0.0);
                                       }});
  EXPECT_EQ (partsBy (follows, FacingRule::NORMALS), 1U);
  EXPECT_EQ (shareFacing (follows, halves, DOWN), 1.0);
}

TEST (FacingChoices, UpIsUpWhateverTheShapeIs)
{
  expectFacing (bowl (), {Facing::AUTO}, OUT, FacingRule::BODY);
  EXPECT_GT (expectFacing (bowl (), {Facing::UP}, IN, FacingRule::UP).facing_certainty, 0.99);
  expectFacing (evenSphere (1500), {Facing::UP}, OUT, FacingRule::CLOSED,
                "is closed: no side is up, and it faces outwards");
  Positions wall = disc (0.06, 3).positions;
  for (Vector3d& p : wall)
    p = {p.x (), 0.0, p.y ()};
  const Report upright = expectFacing (
      wall, {Facing::UP}, [] (const Vector3d&) { return Vector3d::UnitY (); }, FacingRule::UP,
      "as much of it faces down as up");
  EXPECT_EQ (upright.facing_certainty, 0.5);
}

TEST (FacingChoices, OutwardsIsWhereASheetBulges)
{
  for (const double height : {0.1, -0.1}) {
    const Positions points = sheet ([height] (double r) { return height * (1.0 - r * r); });
    EXPECT_EQ (shareFacing (run (points, {}), points, UP), 1.0);
    const Result outwards = run (points, {Facing::OUTWARDS});
    EXPECT_EQ (shareFacing (outwards, points, height > 0.0 ? UP : DOWN), 1.0);
    EXPECT_GT (outwards.report.facing_certainty, 0.9);
    EXPECT_EQ (shareFacing (run (points, {Facing::INWARDS}), points, height > 0.0 ? DOWN : UP),
               1.0);
    EXPECT_TRUE (outwards.report.warnings.empty ());
  }
  // Too low for lines of sight, which are a sample.
  const Positions low = sheet ([] (double r) { return -1e-3 * (1.0 - r * r); });
  expectFacing (low, {Facing::OUTWARDS}, DOWN, FacingRule::BULGE);
  const Positions flat = sheet ([] (double) { return 0.0; });
  const Result guess = run (flat, {Facing::OUTWARDS});
  EXPECT_EQ (shareFacing (guess, flat, UP), 1.0);
  EXPECT_EQ (guess.report.facing_certainty, 0.5);
  EXPECT_TRUE (warns (guess.report, "is a guess"));
}

TEST (FacingChoices, TheViewpointIsFacedFromAnySide)
{
  const Vector3d above (0.1, 0.2, 4.0), below (0.1, 0.2, -4.0);
  const Positions body = evenSphere (1500);
  expectFacing (bowl (), {Facing::VIEWPOINT, {}, above}, IN, FacingRule::SENSOR);
  expectFacing (bowl (), {Facing::VIEWPOINT, {}, below}, OUT, FacingRule::SENSOR);
  expectFacing (bowl (), {Facing::VIEWPOINT}, OUT, FacingRule::BODY, "none is known");
  expectFacing (body, {Facing::VIEWPOINT, {}, {0.1, 0.2, 0.3}}, IN, FacingRule::SENSOR);
  expectFacing (body, {Facing::VIEWPOINT, {}, above}, OUT, FacingRule::CLOSED,
                "is closed: the viewpoint is outside");
  Options disc = discOptions (), no_view;
  no_view.view.use = ViewUse::NEVER;
  for (Options options : {disc, no_view}) {
    EXPECT_EQ (shareFacing (run (bowl (), {Facing::VIEWPOINT, {}, above}, options), bowl (), IN),
               1.0);
    options.facing = Facing::VIEWPOINT;
    const Report unknown = reconstruct (asInput (bowl ()), options).report;
    EXPECT_EQ (unknown.status, RunStatus::INVALID_OPTION);
    EXPECT_NE (unknown.message.find ("viewpoint"), std::string::npos);
  }
}

TEST (FacingChoices, ARoomFacesThePeopleInItAndABoxOutwards)
{
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    RandomStream random (100 + seed);
    const Vector3d size (3.0 + 3.0 * random.uniform (), 2.5 + 2.0 * random.uniform (), 2.5);
    const double at = 0.4 + random.uniform ();
    const Direction in = [&size] (const Vector3d& p) { return Vector3d (0.5 * size - p); };
    const Direction out = [&size] (const Vector3d& p) { return Vector3d (p - 0.5 * size); };
    // Jittered points on the faces of a box, which stands on z = 0: without a door, and without a floor.
    constexpr double STEP = 0.1;
    RandomStream jitter (seed);
    Positions room, box;
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {0.0, size[axis]})
        for (double u = 0.5 * STEP; u < size[(axis + 1) % 3]; u += STEP)
          for (double v = 0.5 * STEP; v < size[(axis + 2) % 3]; v += STEP) {
            Vector3d p;
            p[axis] = side;
            p[(axis + 1) % 3] = u + 0.4 * STEP * (jitter.uniform () - 0.5);
            p[(axis + 2) % 3] = v + 0.4 * STEP * (jitter.uniform () - 0.5);
            if (p.y () != 0.0 || p.z () >= 2.0 || p.x () <= at || p.x () >= at + 0.9)
              room.push_back (p);
            if (p.z () > 0.0)
              box.push_back (p);
          }
    const Report found = expectFacing (room, {}, in, FacingRule::ROOM);
    EXPECT_LT (found.facing_certainty, 0.9); // a box may have a window
    expectFacing (room, {Facing::OUTWARDS}, out, FacingRule::BODY);
    expectFacing (room, {Facing::INWARDS}, in, FacingRule::BODY);
    expectFacing (box, {}, out, FacingRule::BODY);
  }
}

// A scan that is connected as its sensor saw it faces the sensor, unless something else decides.
TEST (FacingChoices, OfASingleScan)
{
  const Scan scan = scanScene (Raster::CAMERA, {0.005, 0.0}, 3);
  const Direction to_sensor = [&scan] (const Vector3d& p) { return Vector3d (scan.viewpoint - p); };
  const Direction away = [&scan] (const Vector3d& p) { return Vector3d (p - scan.viewpoint); };
  const auto view = [&scan] (const Asked& asked) {
    Result result = run (scan.points, asked, seenFrom (scan.viewpoint));
    EXPECT_TRUE (result.report.is_view) << result.report.message;
    return result;
  };
  const Result plain = view ({});
  EXPECT_EQ (shareFacing (plain, scan.points, to_sensor), 1.0);
  EXPECT_EQ (partsBy (plain, FacingRule::SENSOR), 1U);
  EXPECT_EQ (view ({Facing::VIEWPOINT}).triangles, plain.triangles);
  EXPECT_EQ (shareFacing (view ({Facing::AUTO, away}), scan.points, away), 1.0);
  RandomStream random (5);
  const Result contradictory = view ({Facing::NORMALS, [&] (const Vector3d& p) {
                                        return random.uniform () < 0.5 ? away (p) : to_sensor (p);
                                      }});
  EXPECT_TRUE (warns (contradictory.report, "contradict"));
  EXPECT_GT (shareFacing (contradictory, scan.points, to_sensor), 0.95); // but for small parts
  const Result up = view ({Facing::UP});
  EXPECT_GT (partsBy (up, FacingRule::UP), 0U);
  EXPECT_EQ (partsBy (up, FacingRule::SENSOR), 0U);
}

// A dome that stands is no terrain: it faces the side to which it bulges, and a wave any side.
TEST (FacingChoices, WhatStandsFacesTheSideToWhichItBulges)
{
  for (const double side : {-1.0, 1.0}) {
    Positions points = sheet ([side] (double r) { return -0.4 * side * r * r; });
    for (Vector3d& p : points)
      p = {p.x (), -p.z (), p.y ()};
    expectFacing (
        points, {}, [side] (const Vector3d&) { return Vector3d (0.0, -side, 0.0); },
        FacingRule::BULGE);
  }
}

} // namespace
} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What decides which side of a mesh is its front: normals of the input, and what the options ask
// for.
#include "samples.h"
#include "scan_samples.h"

#include <pcl/surface/floater/reconstruct.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

namespace pcl::floater {
namespace {
using samples::asInput;
using samples::PI;
using samples::Positions;
using Direction = std::function<Eigen::Vector3d (const Eigen::Vector3d&)>;

const Direction UP = [] (const Eigen::Vector3d&) { return Eigen::Vector3d::UnitZ (); };
const Direction DOWN = [] (const Eigen::Vector3d&) {
  return Eigen::Vector3d (-Eigen::Vector3d::UnitZ ());
};

// Evenly spread points of a unit sphere.
Positions
sphere (std::size_t count = 1500, const Eigen::Vector3d& centre = Eigen::Vector3d::Zero ())
{
  Positions points;
  const double turn = PI * (3.0 - std::sqrt (5.0));
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * static_cast<double> (i) + 1.0) / static_cast<double> (count);
    const double angle = turn * static_cast<double> (i), radius = std::sqrt (1.0 - z * z);
    points.push_back (centre +
                      Eigen::Vector3d (radius * std::cos (angle), radius * std::sin (angle), z));
  }
  return points;
}

// A round sheet of radius 1: z by the distance from its middle.
Positions
sheet (const std::function<double (double)>& height)
{
  Positions points;
  for (const Eigen::Vector3d& p : samples::disc (0.06, 3).positions)
    points.emplace_back (p.x (), p.y (), height (p.head<2> ().norm ()));
  return points;
}

// The lower half of a sphere, open at the top.
Positions
bowl ()
{
  Positions points;
  for (const Eigen::Vector3d& p : samples::disc (0.05, 3).positions) {
    const double angle = 0.5 * PI * p.norm (), radius = std::max (1e-9, p.norm ());
    points.emplace_back (p.x () / radius * std::sin (angle), p.y () / radius * std::sin (angle),
                         -std::cos (angle));
  }
  return points;
}

Result
run (const Positions& points, Facing facing, const Direction& normal = {},
     const Eigen::Vector3d& sensor = Eigen::Vector3d::Zero ())
{
  Options options;
  options.facing = facing;
  Input input = asInput (points);
  if (normal)
    for (const Eigen::Vector3d& p : points)
      input.facing_normals.push_back (normal (p).cast<float> ());
  Eigen::Map<Eigen::Vector3d> (input.sensor_origin.data ()) = sensor;
  Result result = reconstruct (std::move (input), options);
  EXPECT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
  return result;
}

// Share of the triangles that face there.
double
shareFacing (const Result& result, const Positions& positions, const Direction& there)
{
  std::size_t facing = 0;
  for (const auto& t : result.triangles) {
    const Eigen::Vector3d &a = positions[t[0]], &b = positions[t[1]], &c = positions[t[2]];
    facing += (b - a).cross (c - a).dot (there ((a + b + c) / 3.0)) > 0.0 ? 1 : 0;
  }
  return static_cast<double> (facing) / static_cast<double> (result.triangles.size ());
}

std::size_t
partsBy (const Result& result, FacingRule rule)
{
  return result.report.facing_parts[static_cast<std::size_t> (rule)];
}

bool
warns (const Result& result, const std::string& words)
{
  return std::any_of (
      result.report.warnings.begin (), result.report.warnings.end (),
      [&words] (const std::string& warning) { return warning.find (words) != std::string::npos; });
}

const Direction OUT = [] (const Eigen::Vector3d& p) { return p; };
const Direction IN = [] (const Eigen::Vector3d& p) { return Eigen::Vector3d (-p); };

TEST (FacingChoices, NormalsTurnAClosedBodyInwards)
{
  const Positions points = sphere ();
  const Result without = run (points, Facing::AUTO);
  EXPECT_EQ (shareFacing (without, points, OUT), 1.0);
  EXPECT_EQ (partsBy (without, FacingRule::CLOSED), 1U);
  for (const Facing facing : {Facing::AUTO, Facing::NORMALS}) {
    const Result result = run (points, facing, IN);
    EXPECT_EQ (shareFacing (result, points, IN), 1.0);
    EXPECT_EQ (partsBy (result, FacingRule::NORMALS), 1U);
    EXPECT_EQ (partsBy (result, FacingRule::CLOSED), 0U);
    EXPECT_EQ (result.report.facing_certainty, 1.0);
    EXPECT_TRUE (result.report.warnings.empty ());
  }
  EXPECT_EQ (shareFacing (run (points, Facing::OUTWARDS, IN), points, OUT), 1.0);
}

TEST (FacingChoices, EveryComponentFacesByItsOwnNormals)
{
  Positions bodies = sphere ();
  const Eigen::Vector3d other (5.0, 0.0, 0.0);
  const Positions second = sphere (1500, other);
  bodies.insert (bodies.end (), second.begin (), second.end ());
  const Direction opposite = [&] (const Eigen::Vector3d& p) {
    return p.x () < 2.5 ? Eigen::Vector3d (-p) : Eigen::Vector3d (p - other);
  };
  const Result two = run (bodies, Facing::NORMALS, opposite);
  EXPECT_EQ (partsBy (two, FacingRule::NORMALS), 2U);
  EXPECT_EQ (shareFacing (two, bodies, opposite), 1.0);

  // Two halves of a sheet, which continue each other and would be turned together.
  Positions halves;
  for (const Eigen::Vector3d& p : samples::disc (0.05, 3).positions)
    halves.emplace_back (p.x () + (p.x () > 0.0 ? 0.15 : -0.15), p.y (), 0.0);
  const Direction by_half = [] (const Eigen::Vector3d& p) {
    return Eigen::Vector3d (0.0, 0.0, p.x () > 0.0 ? 1.0 : -1.0);
  };
  const Result together = run (halves, Facing::AUTO);
  EXPECT_EQ (together.report.check.components, 2U);
  EXPECT_EQ (partsBy (together, FacingRule::SHEET), 1U);
  const Result apart = run (halves, Facing::AUTO, by_half);
  EXPECT_EQ (partsBy (apart, FacingRule::NORMALS), 2U);
  EXPECT_EQ (shareFacing (apart, halves, by_half), 1.0);

  // One half has no normals, and follows the other one.
  const Result follows = run (halves, Facing::NORMALS, [] (const Eigen::Vector3d& p) {
    return Eigen::Vector3d (0.0, 0.0, p.x () > 0.0 ? -1.0 : 0.0);
  });
  EXPECT_EQ (partsBy (follows, FacingRule::NORMALS), 1U);
  EXPECT_EQ (shareFacing (follows, halves, DOWN), 1.0);
}

// As a principal component analysis leaves them: the sign of each is chance, or hangs on an axis.
TEST (FacingChoices, NormalsThatWereNeverOrientedDecideNothing)
{
  const Positions points = sphere ();
  RandomStream random (7);
  const Direction by_chance = [&random] (const Eigen::Vector3d& p) {
    return Eigen::Vector3d (random.uniform () < 0.5 ? -p : p);
  };
  const Direction by_axis = [] (const Eigen::Vector3d& p) {
    return Eigen::Vector3d (p.z () < 0.0 ? -p : p);
  };
  const Result without = run (points, Facing::AUTO);
  for (const Facing facing : {Facing::AUTO, Facing::NORMALS})
    for (const Direction& normal : {by_chance, by_axis}) {
      const Result result = run (points, facing, normal);
      EXPECT_EQ (result.triangles, without.triangles);
      EXPECT_EQ (partsBy (result, FacingRule::CLOSED), 1U);
      EXPECT_TRUE (warns (result, "contradict each other on 1 part of the mesh, at point"));
    }
}

TEST (FacingChoices, TheReportTellsHowManyNormalsAgree)
{
  const Positions points = sphere ();
  const auto with_faults = [&points] (double share) {
    RandomStream random (11);
    return run (points, Facing::AUTO, [&] (const Eigen::Vector3d& p) {
      return Eigen::Vector3d (random.uniform () < share ? p : -p);
    });
  };
  const Result few = with_faults (0.15);
  EXPECT_EQ (shareFacing (few, points, IN), 1.0);
  EXPECT_NEAR (few.report.facing_certainty, 0.85, 0.03);
  ASSERT_EQ (few.report.facing_decisions.size (), 1U);
  EXPECT_EQ (few.report.facing_decisions.front ().rule, FacingRule::NORMALS);
  EXPECT_TRUE (few.report.warnings.empty ());
  const Result many = with_faults (0.35);
  EXPECT_EQ (shareFacing (many, points, OUT), 1.0);
  EXPECT_TRUE (warns (many, "contradict"));
}

TEST (FacingChoices, NormalsThatAreMissing)
{
  const Positions points = sphere ();
  const Direction nothing = [] (const Eigen::Vector3d& p) {
    return Eigen::Vector3d (p.x () < 0.0 ? 0.0 : std::nan (""), 0.0, 0.0);
  };
  const Result wanted = run (points, Facing::NORMALS, nothing);
  EXPECT_EQ (shareFacing (wanted, points, OUT), 1.0);
  EXPECT_TRUE (warns (wanted, "no point has a normal on 1 part of the mesh"));
  EXPECT_TRUE (run (points, Facing::AUTO, nothing).report.warnings.empty ());

  Options options;
  options.facing = Facing::NORMALS;
  const Report none = reconstruct (asInput (points), options).report;
  EXPECT_EQ (none.status, RunStatus::INVALID_OPTION);
  EXPECT_NE (none.message.find ("have no normals"), std::string::npos);
  Input input = asInput (points);
  input.facing_normals.resize (points.size () - 1);
  EXPECT_EQ (reconstruct (std::move (input), options).report.status, RunStatus::INVALID_INDICES);
}

TEST (FacingChoices, UpIsUpWhateverTheShapeIs)
{
  const Positions points = bowl ();
  EXPECT_EQ (shareFacing (run (points, Facing::AUTO), points, OUT), 1.0);
  const Result up = run (points, Facing::UP);
  EXPECT_EQ (shareFacing (up, points, IN), 1.0);
  EXPECT_EQ (partsBy (up, FacingRule::UP), 1U);
  EXPECT_GT (up.report.facing_certainty, 0.99);

  const Positions body = sphere ();
  const Result closed = run (body, Facing::UP);
  EXPECT_EQ (shareFacing (closed, body, OUT), 1.0);
  EXPECT_TRUE (warns (closed, "is closed: no side is up, and it faces outwards"));

  Positions wall;
  for (const Eigen::Vector3d& p : samples::disc (0.06, 3).positions)
    wall.emplace_back (p.x (), 0.0, p.y ());
  const Result upright = run (wall, Facing::UP);
  EXPECT_TRUE (warns (upright, "as much of it faces down as up"));
  EXPECT_EQ (upright.report.facing_certainty, 0.5);
  EXPECT_EQ (shareFacing (upright, wall,
                          [] (const Eigen::Vector3d&) { return Eigen::Vector3d::UnitY (); }),
             1.0);
}

TEST (FacingChoices, OutwardsIsWhereASheetBulges)
{
  for (const double height : {0.1, -0.1}) {
    const Positions points = sheet ([height] (double r) { return height * (1.0 - r * r); });
    EXPECT_EQ (shareFacing (run (points, Facing::AUTO), points, UP), 1.0);
    const Result outwards = run (points, Facing::OUTWARDS);
    EXPECT_EQ (shareFacing (outwards, points, height > 0.0 ? UP : DOWN), 1.0);
    EXPECT_GT (outwards.report.facing_certainty, 0.9);
    EXPECT_TRUE (outwards.report.warnings.empty ());
  }
  // Too low for lines of sight, which are a sample.
  const Positions low = sheet ([] (double r) { return -1e-3 * (1.0 - r * r); });
  const Result bulges = run (low, Facing::OUTWARDS);
  EXPECT_EQ (shareFacing (bulges, low, DOWN), 1.0);
  EXPECT_EQ (partsBy (bulges, FacingRule::BULGE), 1U);
  const Positions flat = sheet ([] (double) { return 0.0; });
  const Result guess = run (flat, Facing::OUTWARDS);
  EXPECT_EQ (shareFacing (guess, flat, UP), 1.0);
  EXPECT_EQ (guess.report.facing_certainty, 0.5);
  EXPECT_TRUE (warns (guess, "is a guess"));
}

TEST (FacingChoices, TheViewpointIsFacedFromAnySide)
{
  const Positions points = bowl ();
  const Eigen::Vector3d above (0.1, 0.2, 4.0), below (0.1, 0.2, -4.0);
  EXPECT_EQ (shareFacing (run (points, Facing::VIEWPOINT, {}, above), points, IN), 1.0);
  const Result from_below = run (points, Facing::VIEWPOINT, {}, below);
  EXPECT_EQ (shareFacing (from_below, points, OUT), 1.0);
  EXPECT_EQ (partsBy (from_below, FacingRule::SENSOR), 1U);

  const Positions body = sphere ();
  EXPECT_EQ (shareFacing (run (body, Facing::VIEWPOINT, {}, {0.1, 0.2, 0.3}), body, IN), 1.0);
  const Result outside = run (body, Facing::VIEWPOINT, {}, above);
  EXPECT_EQ (shareFacing (outside, body, OUT), 1.0);
  EXPECT_TRUE (warns (outside, "is closed: the viewpoint is outside"));
}

TEST (FacingChoices, AViewpointThatNobodyKnows)
{
  const Positions points = bowl ();
  const Result unknown = run (points, Facing::VIEWPOINT);
  EXPECT_EQ (shareFacing (unknown, points, OUT), 1.0);
  EXPECT_TRUE (warns (unknown, "none is known"));

  Options options;
  options.facing = Facing::VIEWPOINT;
  for (const bool is_disc : {false, true}) {
    options.topology = is_disc ? Topology::DISC : Topology::AUTO;
    options.view.use = is_disc ? ViewUse::AUTO : ViewUse::NEVER;
    const Report report = reconstruct (asInput (points), options).report;
    EXPECT_EQ (report.status, RunStatus::INVALID_OPTION);
    EXPECT_NE (report.message.find ("viewpoint"), std::string::npos);
    Input input = asInput (points);
    input.sensor_origin = {0.1, 0.2, 4.0};
    const Result told = reconstruct (std::move (input), options);
    ASSERT_EQ (told.report.status, RunStatus::SUCCESS) << told.report.message;
    EXPECT_EQ (shareFacing (told, points, IN), 1.0);
  }
}

// A scan that is connected as its sensor saw it faces the sensor, unless something else decides.
TEST (FacingChoices, OfASingleScan)
{
  const samples::Scan scan = samples::scanScene (samples::Raster::CAMERA, {0.005, 0.0}, 3);
  const Direction to_sensor = [&scan] (const Eigen::Vector3d& p) {
    return Eigen::Vector3d (scan.viewpoint - p);
  };
  const Direction away = [&scan] (const Eigen::Vector3d& p) {
    return Eigen::Vector3d (p - scan.viewpoint);
  };
  const auto view = [&scan] (Facing facing, const Direction& normal) {
    Options options;
    options.facing = facing;
    options.view.use = ViewUse::GIVEN;
    Eigen::Map<Eigen::Vector3d> (options.view.viewpoint.data ()) = scan.viewpoint;
    Input input = asInput (scan.points);
    if (normal)
      for (const Eigen::Vector3d& p : scan.points)
        input.facing_normals.push_back (normal (p).cast<float> ());
    Result result = reconstruct (std::move (input), options);
    EXPECT_TRUE (result.report.is_view) << result.report.message;
    return result;
  };
  const Result plain = view (Facing::AUTO, {});
  EXPECT_EQ (shareFacing (plain, scan.points, to_sensor), 1.0);
  EXPECT_EQ (partsBy (plain, FacingRule::SENSOR), 1U);
  EXPECT_EQ (view (Facing::VIEWPOINT, {}).triangles, plain.triangles);
  EXPECT_EQ (shareFacing (view (Facing::AUTO, away), scan.points, away), 1.0);
  RandomStream random (5);
  const Result contradictory = view (Facing::NORMALS, [&] (const Eigen::Vector3d& p) {
    return random.uniform () < 0.5 ? away (p) : to_sensor (p);
  });
  EXPECT_TRUE (warns (contradictory, "contradict"));
  EXPECT_GT (shareFacing (contradictory, scan.points, to_sensor), 0.95); // but for small parts
  const Result up = view (Facing::UP, {});
  EXPECT_GT (partsBy (up, FacingRule::UP), 0U);
  EXPECT_EQ (partsBy (up, FacingRule::SENSOR), 0U);
}

} // namespace
} // namespace pcl::floater

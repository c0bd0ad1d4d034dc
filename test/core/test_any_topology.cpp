// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The whole method on samples of surfaces of known topology: the mesh is that surface.
//
// Environment variables: PCL_FLOATER_SAVE is a folder into which the meshes are saved as PLY files.
// If PCL_FLOATER_SHOW_WRONG is set, cases that are known not to work yet fail instead of being
// skipped.
#include <pcl/surface/floater/reconstruct.h>

#include "mesh_oracle.h"
#include "still_wrong.h"
#include "surface_samples.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <sstream>
#include <string>

namespace pcl::floater {
namespace {
using samples::KnownSurface;
using samples::Positions;

/// A mean edge of an even mesh is a little longer than the mean distance to the six nearest.
constexpr double LEAST_MEAN_EDGE = 0.85, LARGEST_MEAN_EDGE = 1.25;
/// Bound of all edges of a mesh without filled holes, in spacings; with noise, which moves both
/// ends by up to half a spacing in any direction.
constexpr double LONGEST_EDGE = 4.0, LONGEST_NOISY_EDGE = 4.5;

struct Case
{
  std::string name;
  std::function<KnownSurface ()> make;
  Options options{};
  double area_tolerance = 0.02; ///< relative
};

void
PrintTo (const Case& one, std::ostream* out)
{
  *out << one.name;
}

std::string
nameOf (const testing::TestParamInfo<Case>& info)
{
  return info.param.name;
}

Options
policy (HolePolicy holes, int kept_loops = 1, double largest_hole = 0.0)
{
  Options options;
  options.holes.policy = holes;
  options.holes.kept_loops = kept_loops;
  options.holes.largest_hole = largest_hole;
  return options;
}

std::string
places (const Positions& points)
{
  constexpr std::size_t SHOWN = 5;
  std::ostringstream text;
  for (std::size_t i = 0; i < points.size () && i < SHOWN; ++i)
    text << " (" << points[i].transpose () << ")";
  return text.str ();
}

std::string
loopsText (const samples::Topology& topology, const Positions& points)
{
  std::ostringstream text;
  for (const std::vector<Index>& loop : topology.loops)
    text << " " << loop.size () << " points from (" << points[loop.front ()].transpose () << ")";
  return text.str ();
}

std::string
warningsOf (const Report& report)
{
  std::string text;
  for (const std::string& warning : report.warnings)
    text += "\n  warning: " + warning;
  return text;
}

void
expectPointsUsed (const Result& result, const KnownSurface& surface)
{
  std::vector<Index> seen (surface.points.size (), 0);
  for (const Triangle& t : result.triangles)
    for (const Index p : t)
      seen[p] = 1;
  std::vector<Index> unused;
  for (Index p = 0; p < seen.size (); ++p)
    if (seen[p] == 0)
      unused.push_back (p);
  std::vector<Index> expected;
  std::merge (surface.outliers.begin (), surface.outliers.end (), surface.duplicates.begin (),
              surface.duplicates.end (), std::back_inserter (expected));
  std::vector<Index> wrong;
  std::set_symmetric_difference (unused.begin (), unused.end (), expected.begin (), expected.end (),
                                 std::back_inserter (wrong));
  Positions where;
  for (const Index p : wrong)
    where.push_back (surface.points[p]);
  EXPECT_TRUE (wrong.empty ()) << wrong.size () << " points wrongly used or unused, as"
                               << places (where);
  EXPECT_EQ (result.report.outliers, surface.outliers);
  EXPECT_EQ (result.report.statistics.used_points, surface.points.size () - expected.size ());
}

void
expectTopology (const Result& result, const KnownSurface& surface)
{
  const samples::Topology topology = samples::topologyOf (result.triangles);
  EXPECT_TRUE (topology.manifold);
  EXPECT_EQ (topology.components, surface.components);
  EXPECT_EQ (topology.loops.size (), surface.loops) << loopsText (topology, surface.points);
  EXPECT_EQ (topology.euler, samples::eulerOf (surface));
  const long handles = 2 * static_cast<long> (topology.components) -
                       static_cast<long> (topology.loops.size ()) - topology.euler;
  EXPECT_EQ (handles, 2 * static_cast<long> (surface.handles)) << "twice the genus";
}

Positions
foldsOf (const std::vector<Triangle>& triangles, const Positions& points)
{
  Positions folds;
  for (const auto& [a, b] : samples::foldedEdges (triangles, points))
    folds.emplace_back (0.5 * (points[a] + points[b]));
  return folds;
}

// Number of edges that may be folded: one per 0.8 spacings of the sharp edges of the surface. With
// noise, also as many as the mesh of the clean points has when its vertices are moved.
double
allowedFolds (const KnownSurface& surface)
{
  double allowed = surface.sharp_length / 0.8;
  if (!surface.clean.empty ()) {
    const Result clean = reconstruct (samples::asInput (surface.clean), {});
    allowed += static_cast<double> (foldsOf (clean.triangles, surface.points).size ());
  }
  return allowed;
}

void
expectGeometry (const Result& result, const KnownSurface& surface, const Case& one)
{
  const samples::Geometry geometry = samples::geometryOf (result.triangles, surface.points);
  const Positions folds = foldsOf (result.triangles, surface.points);
  EXPECT_LE (static_cast<double> (folds.size ()), allowedFolds (surface)) << places (folds);
  EXPECT_GT (geometry.mean_edge, LEAST_MEAN_EDGE);
  if (one.options.holes.policy == HolePolicy::AUTO) {
    EXPECT_LT (geometry.mean_edge, LARGEST_MEAN_EDGE);
    EXPECT_LT (geometry.longest_edge, surface.clean.empty () ? LONGEST_EDGE : LONGEST_NOISY_EDGE)
        << geometry.longest_at.transpose ();
  }
  if (surface.area > 0.0) {
    EXPECT_NEAR (geometry.area / surface.area, 1.0, one.area_tolerance);
  }
}

class AnyTopology : public testing::TestWithParam<Case>
{
};

void
expectSurface (const Case& one)
{
  const KnownSurface surface = one.make ();
  const Result result = reconstruct (samples::asInput (surface.points), one.options);
  if (const char* folder = std::getenv ("PCL_FLOATER_SAVE"))
    samples::savePly (std::string (folder) + "/" + one.name + ".ply", surface.points,
                      result.triangles);
  SCOPED_TRACE (std::to_string (surface.points.size ()) + " points, by " +
                (result.report.topology == Topology::DISC ? "DISC: " : "SURFACE: ") +
                result.report.topology_reason + warningsOf (result.report));
  ASSERT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
  EXPECT_EQ (warningsOf (result.report).find ("one-sided"), std::string::npos);
  EXPECT_NE (result.report.topology_reason, "");
  expectPointsUsed (result, surface);
  expectTopology (result, surface);
  expectGeometry (result, surface, one);
}

TEST_P (AnyTopology, IsTheSurface)
{
  const Case& one = GetParam ();
  expectUnlessStillWrong (one.name, [&one] { expectSurface (one); });
}

// A surface without an orientation has no right mesh: it is refused, or cut with a warning.
void
expectRefusedOrCut (const KnownSurface& strip, Topology method)
{
  Options options;
  options.topology = method;
  const Result result = reconstruct (samples::asInput (strip.points), options);
  if (result.report.status != RunStatus::SUCCESS) {
    EXPECT_NE (result.report.message.find ("side"), std::string::npos) << result.report.message;
    EXPECT_TRUE (result.triangles.empty ());
    return;
  }
  const samples::Topology made = samples::topologyOf (result.triangles);
  EXPECT_TRUE (made.manifold);
  const std::string warnings = warningsOf (result.report);
  EXPECT_TRUE (warnings.find ("one side") != std::string::npos ||
               warnings.find ("one-sided") != std::string::npos ||
               warnings.find ("orient") != std::string::npos)
      << made.components << " components, Euler characteristic " << made.euler << ","
      << loopsText (made, strip.points) << warnings;
}

TEST (OneSided, IsNeverPassedOffAsRight)
{
  const KnownSurface strip = samples::moebiusStrip (1);
  for (const Topology method : {Topology::AUTO, Topology::SURFACE})
    expectRefusedOrCut (strip, method);
}

// Surfaces for which the method of TW 385 is made.
INSTANTIATE_TEST_SUITE_P (
    Discs, AnyTopology,
    testing::Values (
        // The outermost of random points lie half a spacing inside the rim.
        Case{"finger_1", [] { return samples::finger (1.0, 2000, 1); }, {}, 0.025},
        Case{"finger_10", [] { return samples::finger (10.0, 2500, 2); }},
        Case{"finger_30", [] { return samples::finger (30.0, 4000, 3); }},
        Case{"finger_100", [] { return samples::finger (100.0, 6000, 4); }, {}, 0.03},
        Case{"taco_2", [] { return samples::taco (2.0, 1); }},
        Case{"taco_3", [] { return samples::taco (3.0, 2); }},
        Case{"taco_5", [] { return samples::taco (5.0, 3); }},
        Case{"comb_5", [] { return samples::comb (5.0, false, 1); }},
        Case{"comb_5_ragged", [] { return samples::comb (5.0, true, 2); }},
        Case{"graded_30", [] { return samples::unevenSheet (30.0, false, 1); }},
        Case{"abrupt_30", [] { return samples::unevenSheet (30.0, true, 2); }},
        Case{"lattice_square", [] { return samples::lattice (samples::Lattice::SQUARE); }},
        Case{"lattice_hexagonal", [] { return samples::lattice (samples::Lattice::HEXAGONAL); }},
        Case{"lattice_sheared", [] { return samples::lattice (samples::Lattice::SHEARED); }}),
    nameOf);

INSTANTIATE_TEST_SUITE_P (
    Holes, AnyTopology,
    testing::Values (
        Case{"annulus", [] { return samples::annulus (1); }},
        Case{"hole_1", [] { return samples::sheetWithHoles (1, 10.0, false, 1); }},
        Case{"holes_9", [] { return samples::sheetWithHoles (9, 5.0, false, 2); }},
        Case{"holes_9_ragged", [] { return samples::sheetWithHoles (9, 5.0, true, 3); }},
        Case{"holes_50", [] { return samples::sheetWithHoles (50, 4.0, false, 4); }},
        Case{"sphere_with_holes", [] { return samples::sphereWithThreeHoles (1); }},
        Case{"sphere_with_holes_closed",
             [] {
               KnownSurface made = samples::sphereWithThreeHoles (1);
               made.loops = 0;
               made.area = 0.0;
               return made;
             },
             policy (HolePolicy::CLOSE_ALL)},
        Case{"holes_9_all_but_border_closed",
             [] {
               KnownSurface made = samples::sheetWithHoles (9, 5.0, false, 2);
               made.loops = 1;
               made.area = 0.0;
               return made;
             },
             policy (HolePolicy::KEEP_LARGEST)},
        Case{"two_sizes_six_kept",
             [] {
               KnownSurface made = samples::sheetWithHolesOfTwoSizes (1);
               made.loops = 6;
               made.area = 0.0;
               return made;
             },
             policy (HolePolicy::KEEP_COUNT, 6)},
        Case{"two_sizes_small_closed",
             [] {
               KnownSurface made = samples::sheetWithHolesOfTwoSizes (1);
               made.loops = 6;
               made.area = 0.0;
               return made;
             },
             policy (HolePolicy::BY_SIZE, 1, 8.0)},
        Case{"two_sizes_all_kept", [] { return samples::sheetWithHolesOfTwoSizes (1); },
             policy (HolePolicy::KEEP_COUNT, 10)}),
    nameOf);

INSTANTIATE_TEST_SUITE_P (
    Closed, AnyTopology,
    testing::Values (
        Case{"sphere", [] { return samples::sphere (3000, 1); }},
        Case{"torus", [] { return samples::torus (3000, 2); }},
        Case{"double_torus", [] { return samples::doubleTorus (3); }},
        Case{"sphere_duplicates",
             [] { return samples::withDuplicates (samples::sphere (2000, 4), 200, 5); }},
        Case{"sphere_outliers",
             [] { return samples::withOutliers (samples::sphere (3000, 6), 20, 12.0, 7); }},
        Case{"sphere_outliers_near",
             [] { return samples::withOutliers (samples::sphere (3000, 6), 20, 4.0, 7); }},
        Case{"annulus_outliers",
             [] { return samples::withOutliers (samples::annulus (8), 15, 12.0, 9); }},
        Case{"annulus_outliers_near",
             [] { return samples::withOutliers (samples::annulus (8), 15, 4.0, 9); }}),
    nameOf);

INSTANTIATE_TEST_SUITE_P (
    Components, AnyTopology,
    testing::Values (Case{"parallel_2", [] { return samples::parallelSheets (2.0, 1); }},
                     Case{"parallel_3", [] { return samples::parallelSheets (3.0, 3); }},
                     Case{"components", [] { return samples::components (1); }},
                     Case{"components_outliers",
                          [] {
                            return samples::withOutliers (samples::components (2), 10, 36.0, 3);
                          }}),
    nameOf);

INSTANTIATE_TEST_SUITE_P (SharpEdges, AnyTopology,
                          testing::Values (Case{"box", [] { return samples::box (true, 1); }},
                                           Case{"box_open", [] { return samples::box (false, 2); }},
                                           Case{"bracket", [] { return samples::bracket (3); }},
                                           Case{"cylinder", [] { return samples::cylinder (4); }},
                                           Case{"wedge", [] { return samples::wedge (5); }}),
                          nameOf);

INSTANTIATE_TEST_SUITE_P (
    Noise, AnyTopology,
    testing::Values (
        Case{"noise_01", [] { return samples::withNoise (samples::annulus (1), 0.1, 2); }},
        Case{"noise_02", [] { return samples::withNoise (samples::annulus (2), 0.2, 3); }},
        Case{"noise_03", [] { return samples::withNoise (samples::annulus (3), 0.3, 4); }},
        Case{"noise_05", [] { return samples::withNoise (samples::annulus (4), 0.5, 5); }},
        Case{"sphere_noise_01",
             [] { return samples::withNoise (samples::sphere (3000, 1), 0.1, 6); }},
        Case{"sphere_noise_03",
             [] { return samples::withNoise (samples::sphere (3000, 2), 0.3, 7); }},
        Case{"sphere_noise_05",
             [] { return samples::withNoise (samples::sphere (3000, 3), 0.5, 8); }}),
    nameOf);

} // namespace
} // namespace pcl::floater

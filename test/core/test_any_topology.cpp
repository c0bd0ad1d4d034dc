// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The whole method on samples of surfaces of known topology: the mesh is that surface. Real clouds are looked for in
// the folder PCL_FLOATER_DATA of the environment.
//
// If PCL_FLOATER_SHOW_WRONG is set in the environment, cases that are known not to work yet fail instead of
// being skipped.
#include <pcl/surface/floater/reconstruct.h>

#include "mesh/folds.h"
#include "points/neighbors.h"
#include "real_clouds.h"
#include "surface_samples.h"

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using namespace samples;

/// A mean edge of an even mesh is a little longer than the mean distance to the six nearest.
constexpr double LEAST_MEAN_EDGE = 0.85, LARGEST_MEAN_EDGE = 1.25;
/// Bound of all edges of a mesh without filled holes, in spacings; with noise, which moves both
/// ends by up to half a spacing in any direction.
constexpr double LONGEST_EDGE = 4.0, LONGEST_NOISY_EDGE = 4.5;

struct Case
{
  std::string name;
  std::function<KnownSurface ()> make;
  HoleOptions holes{};
  double area_tolerance = 0.02; ///< relative
};

void
PrintTo (const Case& one, std::ostream* out)
{
  *out << one.name;
}

// All points but the outliers are vertices of a mesh with the topology of the surface.
void
expectTopologyOf (const Result& result, const KnownSurface& surface)
{
  const std::size_t vertices = surface.points.size () - surface.outliers.size ();
  const long euler = static_cast<long> (2 * surface.components) -
                     static_cast<long> (2 * surface.handles + surface.loops);
  expectTopology (result.triangles, vertices, surface.components, euler, surface.loops);
  EXPECT_EQ (result.report.outliers, surface.outliers);
  EXPECT_EQ (result.report.statistics.used_points, vertices);
  for (const Triangle& t : result.triangles)
    for (const Index p : t)
      EXPECT_FALSE (std::binary_search (surface.outliers.begin (), surface.outliers.end (), p));
}

// Number of edges that may be folded: one per 0.8 spacings of the sharp edges of the surface. With
// noise, also as many as the mesh of the clean points has when its vertices are moved.
double
allowedFolds (const KnownSurface& surface)
{
  double allowed = surface.sharp_length / 0.8;
  if (!surface.clean.empty ()) {
    TriangleMesh clean;
    clean.triangles = meshOf (surface.clean).triangles;
    clean.connect (surface.points.size (), 1);
    allowed += static_cast<double> (findFolds (clean, surface.points, 1).size ());
  }
  return allowed;
}

// Mean length of the sides of all triangles, in spacings at their ends, and the sum of their areas.
std::pair<double, double>
meanEdgeAndArea (const std::vector<Triangle>& triangles, const Positions& points)
{
  const std::vector<float> spacing = localSpacing (points, nearestOf (points, 6), 1);
  double lengths = 0.0;
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = t[i], b = t[(i + 1) % 3];
      lengths += 2.0 * (points[a] - points[b]).norm () / (spacing[a] + spacing[b]);
    }
  return {lengths / (3.0 * static_cast<double> (triangles.size ())), areaOf (triangles, points)};
}

void
expectGeometry (const Result& result, const KnownSurface& surface, const Case& one)
{
  EXPECT_LE (static_cast<double> (result.report.check.folds), allowedFolds (surface));
  if (!surface.is_even)
    return;
  EXPECT_EQ (result.report.check.degenerate_triangles, 0U);
  const auto [mean_edge, area] = meanEdgeAndArea (result.triangles, surface.points);
  EXPECT_GT (mean_edge, LEAST_MEAN_EDGE);
  if (one.holes.policy == HolePolicy::AUTO) {
    EXPECT_LT (mean_edge, LARGEST_MEAN_EDGE);
    const MeshCheck& check = result.report.check;
    EXPECT_LT (check.longest_edge, surface.clean.empty () ? LONGEST_EDGE : LONGEST_NOISY_EDGE)
        << surface.points[check.longest_edge_at[0]].transpose ();
  }
  if (surface.area > 0.0) {
    EXPECT_NEAR (area / surface.area, 1.0, one.area_tolerance);
  }
}

using AnyTopology = testing::TestWithParam<Case>;

TEST_P (AnyTopology, IsTheSurface)
{
  // Outliers less than 10 spacings away in the plane of a sheet become a part of it. A thin body without points at
  // its sides has the points of two close sheets. A blade of 16 degrees keeps tunnels, and blades in rows up to 240
  // crossing pairs. A sheet with a ragged boundary keeps an edge of 5.3 spacings at its fold.
  const std::set<std::string> still_wrong{"sphere_outliers_near", "parallel_2", "blade_16",
                                          "fold_ragged_seed_6"};
  const Case& one = GetParam ();
  if (still_wrong.count (one.name) != 0 && std::getenv ("PCL_FLOATER_SHOW_WRONG") == nullptr)
    GTEST_SKIP () << "this surface does not come out right yet";
  const KnownSurface surface = one.make ();
  Options options;
  options.holes = one.holes;
  const Result result = reconstruct (asInput (surface.points), options);
  SCOPED_TRACE (std::to_string (surface.points.size ()) + " points, by " +
                (result.report.topology == Topology::DISC ? "DISC: " : "SURFACE: ") +
                result.report.topology_reason + " " +
                testing::PrintToString (result.report.warnings));
  ASSERT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
  EXPECT_FALSE (warns (result.report, "one-sided"));
  EXPECT_NE (result.report.topology_reason, "");
  expectTopologyOf (result, surface);
  expectGeometry (result, surface, one);
  const auto isOf = [&one] (const char* name) { return one.name.find (name) < one.name.size (); };
  const std::size_t most = isOf ("_in_rows") ? 240 : isOf ("_stacked") ? 2 : 0;
  EXPECT_LE (result.report.check.self_intersections, most);
}

// A surface without an orientation has no right mesh: it is refused, or cut with a warning.
TEST (OneSided, IsNeverPassedOffAsRight)
{
  const KnownSurface strip = moebiusStrip (1);
  for (const Topology method : {Topology::AUTO, Topology::SURFACE}) {
    Options options;
    options.topology = method;
    const Result result = reconstruct (asInput (strip.points), options);
    if (result.report.status != RunStatus::SUCCESS) {
      EXPECT_NE (result.report.message.find ("side"), std::string::npos) << result.report.message;
      EXPECT_TRUE (result.triangles.empty ());
      continue;
    }
    EXPECT_TRUE (topologyOf (result.triangles).manifold);
    EXPECT_TRUE (warns (result.report, "one side") || warns (result.report, "one-sided") ||
                 warns (result.report, "orient"))
        << testing::PrintToString (result.report.warnings);
  }
}

// Each point again, up to `offset` away: the same surface, of stacks.
KnownSurface
stacked (KnownSurface surface, std::size_t copies, double offset, std::uint64_t seed)
{
  RandomStream random (seed);
  const std::size_t n = surface.points.size ();
  for (std::size_t i = 0; i < copies * n; ++i)
    surface.points.emplace_back (surface.points[i % n] + 0.5 * offset * normalVector (random));
  surface.sharp_length += 0.002 * static_cast<double> (copies * n); // needles are folded at times
  surface.is_even = false;
  return surface;
}

// With so many loops, of which some holes are filled.
KnownSurface
filled (KnownSurface surface, std::size_t loops)
{
  surface.loops = loops;
  surface.area = 0.0;
  return surface;
}

KnownSurface
sphere (std::size_t points, std::uint64_t seed)
{
  return generated ({SurfaceKind::SPHERE, points, seed});
}

KnownSurface
finger (double slenderness, std::size_t points, std::uint64_t seed)
{
  return generated ({SurfaceKind::FINGER, points, seed, 1.0, 0.0, slenderness});
}

std::vector<Case>
cases ()
{
  using Kind = SurfaceKind;
  using Make = std::function<KnownSurface ()>;
  std::vector<Case> all;
  const auto add = [&all] (const std::string& name, const Make& make) {
    all.push_back ({name, make});
  };
  const auto fill = [&all] (const std::string& name, const HoleOptions& holes, const Make& make) {
    all.push_back ({name, make, holes});
  };
  // Discs.
  add ("finger_1", [] { return finger (1.0, 2000, 1); });
  all.back ().area_tolerance = 0.025; // the outermost points lie half a spacing inside the rim
  add ("finger_10", [] { return finger (10.0, 2500, 2); });
  add ("finger_30", [] { return finger (30.0, 4000, 3); });
  add ("finger_100", [] { return finger (100.0, 6000, 4); });
  all.back ().area_tolerance = 0.03;
  add ("taco_2", [] { return taco (2.0, 1); });
  add ("taco_3", [] { return taco (3.0, 2); });
  add ("taco_5", [] { return taco (5.0, 3); });
  add ("comb_5", [] { return comb (5.0, false, 1); });
  add ("comb_5_ragged", [] { return comb (5.0, true, 2); });
  add ("graded_30", [] { return generated ({Kind::HEMISPHERE, 4000, 1, 30.0}); });
  add ("lattice_square", [] { return lattice ({0.0, 1.0}); });
  add ("lattice_hexagonal", [] { return lattice ({0.5, std::sqrt (0.75)}); });
  add ("lattice_sheared", [] { return lattice ({std::cos (0.4 * PI), std::sin (0.4 * PI)}); });
  // Holes.
  add ("annulus", [] { return annulus (1); });
  add ("hole_1", [] { return sheetWithHoles (1, 25.0, 10.0, 10.0, 1); });
  add ("holes_9", [] { return sheetWithHoles (3, 15.0, 5.0, 5.0, 2); });
  add ("holes_9_ragged", [] {
    return generated ({Kind::CUT_OUT, 3000, 3, 1.0, 0.0, 0.0, 0.0, 9});
  });
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    add ("holes_25_of_4_spacings_seed_" + std::to_string (seed),
         [=] { return sheetWithHoles (5, 12.0, 2.0, 2.0, seed); });
  add ("holes_49", [] { return sheetWithHoles (7, 13.0, 4.0, 4.0, 4); });
  fill ("holes_9_all_but_border_closed", {HolePolicy::KEEP_LARGEST},
        [] { return filled (sheetWithHoles (3, 15.0, 5.0, 5.0, 2), 1); });
  const Make two_sizes = [] { return sheetWithHoles (3, 20.0, 6.0, 2.0, 1); };
  const Make two_sizes_filled = [=] { return filled (two_sizes (), 6); };
  fill ("two_sizes_all_kept", {HolePolicy::KEEP_COUNT, 10}, two_sizes);
  fill ("two_sizes_six_kept", {HolePolicy::KEEP_COUNT, 6}, two_sizes_filled);
  fill ("two_sizes_small_closed", {HolePolicy::BY_SIZE, 1, 8.0}, two_sizes_filled);
  fill ("half_sphere_closed", {HolePolicy::CLOSE_ALL}, [] {
    return filled (generated ({Kind::HEMISPHERE, 3000, 1}), 0);
  });
  // Closed surfaces, sharp edges.
  add ("sphere", [] { return sphere (3000, 1); });
  add ("torus", [] { return generated ({Kind::TORUS, 3000, 2}); });
  add ("box", [] { return prism ({rectangle (25.0, 18.0)}, 15.0, 1); });
  add ("box_open", [] { return prism ({rectangle (25.0, 18.0)}, 15.0, 2, false); });
  add ("two_windows", [] {
    return prism ({rectangle (34.0, 20.0), rectangle (8.0, 8.0, {6.0, 6.0}),
                   rectangle (8.0, 8.0, {20.0, 6.0})},
                  6.0, 3);
  });
  add ("bracket", [] {
    return prism ({{{0, 0}, {30, 0}, {30, 6}, {6, 6}, {6, 24}, {0, 24}}}, 15.0, 3);
  });
  add ("cylinder", [] { return prism ({circle (10.0, 1.0)}, 24.0, 4); });
  // Angles of 30, 75 and 75 degrees. Points on both faces beside the sharp edge keep their distance.
  add ("wedge", [] {
    return sharp (prism ({{{0, 0}, {32, 0}, {32 * std::cos (PI / 6.0), 16}}}, 20.0, 5), 20.0);
  });
  for (const double height : {0.9, 1.5, 2.2})
    add ("plate_" + std::to_string (static_cast<int> (10.0 * height)),
         [=] { return prism ({rectangle (26.0, 18.0)}, height, 6); });
  // Thin walls of which several are in a neighbourhood are no scatter.
  add ("channel", [] {
    return prism (
        {{{0, 0}, {5.7, 0}, {5.7, 10}, {4.5, 10}, {4.5, 1.2}, {1.2, 1.2}, {1.2, 10}, {0, 10}}},
        20.0, 3);
  });
  // Around the zone that is made anew, the mesh is wrong.
  add ("fins", [] {
    Outline outline{{0.0, 0.0}, {12.7, 0.0}, {12.7, 8.4}, {11.1, 8.4}, {11.1, 3.4}};
    for (const double x : {7.4, 3.7})
      for (const Eigen::Vector2d& p : Outline{{x + 1.6, 3.4}, {x + 1.6, 8.4}, {x, 8.4}, {x, 3.4}})
        outline.push_back (p);
    for (const Eigen::Vector2d& p : Outline{{1.6, 3.4}, {1.6, 8.4}, {0.0, 8.4}})
      outline.push_back (p);
    return sharp (prism ({outline}, 12.0, 1), 3.2);
  });
  // Handles that the mesh does not have before zones are made anew.
  for (const double bar : {2.0, 3.0, 4.0})
    for (const double height : {2.0, 4.0})
      add ("frame_" + std::to_string (static_cast<int> (10.0 * bar + height)),
           [=] { return frame (bar, 7.0, height, 1); });
  for (const double height : {2.0, 3.0}) // some bars have only 8 or 9 points around
    add ("frame_25" + std::to_string (static_cast<int> (height)),
         [=] { return frame (2.5, 7.0, height, 3); });
  for (const double slope : {0.15, 0.3, 0.6})
    add ("roof_" + std::to_string (static_cast<int> (100.0 * slope)), [=] {
      return sharp (prism ({{{0, 0}, {30, 0}, {15, 30.0 * slope}}}, 20.0, 7), 40.0); // its eaves
    });
  // Edges of 16 degrees, and of 20.
  for (const auto& [half_angle, seed] : {std::pair (8.0, 11), {8.0, 16}, {10.0, 2}, {10.0, 3}})
    add ("blade_" + std::to_string (seed), [half_angle, seed] {
      const double half = 20.0 * std::tan (half_angle * PI / 180.0);
      return sharp (prism ({{{0, 0}, {20, -half}, {40, 0}, {20, half}}}, 30.0, seed), 66.0);
    });
  for (const auto& [half, thick] : {std::pair (6, 0.5), {6, 0.8}, {9, 0.5}, {9, 0.8}, {12, 0.8}})
    add ("blade_in_rows_" + std::to_string (half) + (thick < 0.6 ? "_thin" : ""),
         [half = half, thick = thick] { return bladeInRows (half, thick); });
  for (const std::uint64_t seed : {1, 2, 3, 10, 14, 201})
    add ("fold_seed_" + std::to_string (seed), [=] { return foldedSheet (seed); });
  for (const std::uint64_t seed : {3, 6, 12, 13, 21, 23})
    add ("fold_ragged_seed_" + std::to_string (seed), [=] { return foldedSheet (seed, true); });
  for (const auto& [count, width, angle] :
       {std::tuple (2, 8, 50), {2, 8, 70}, {2, 12, 40}, {3, 14, 60}, {4, 12, 70}})
    add ("pleats_" + std::to_string (1000 * count + 100 * width + angle),
         [count = count, width = width, angle = angle] {
           return pleats (count, width, angle * PI / 180.0, 1);
         });
  // Outliers, several components.
  add ("sphere_outliers", [] { return withOutliers (sphere (3000, 6), 20, 12.0, 7); });
  add ("sphere_outliers_near", [] { return withOutliers (sphere (3000, 6), 20, 4.0, 7); });
  add ("annulus_outliers", [] { return withOutliers (annulus (8), 15, 12.0, 9); });
  add ("annulus_outliers_near", [] { return withOutliers (annulus (8), 15, 4.0, 9); });
  add ("parallel_2", [] { return parallelSheets (2.0, 1); });
  add ("parallel_3", [] { return parallelSheets (3.0, 3); });
  add ("components", [] { return components (1); });
  // Two spheres. A neck joins the first four, and the others share points so that a hole is left.
  for (const auto& [seed, gap] :
       {std::pair (2, 0.02), {6, 0.02}, {8, 0.02}, {11, 0.02}, {9, 0.5}, {25, 0.2}})
    add ("touching_" + std::to_string (seed), [seed = seed, gap = gap] {
      const double distance = std::sqrt (300.0 / PI) + std::sqrt (225.0 / PI) + gap;
      return withComponent (sphere (1200, seed), sphere (900, seed + 100), 1.0,
                            distance * Eigen::Vector3d (1.0, 2.0, 2.0) / 3.0);
    });
  add ("components_outliers", [] { return withOutliers (components (2), 10, 36.0, 3); });
  for (const std::uint64_t tenths : {1, 2, 3, 5}) {
    const double noise = 0.1 * static_cast<double> (tenths);
    add ("noise_" + std::to_string (tenths),
         [=] { return withNoise (annulus (tenths), noise, tenths + 1); });
    add ("sphere_noise_" + std::to_string (tenths),
         [=] { return withNoise (sphere (3000, tenths), noise, tenths + 5); });
  }
  for (const double offset : {1e-12, 1e-3, 0.05}) {
    const std::string name = "_stacked_" + std::to_string (all.size ());
    add ("torus" + name, [=] {
      return stacked (generated ({Kind::TORUS, 3000, 2}), 1, offset, 1);
    });
    add ("annulus" + name, [=] { return stacked (annulus (1), 2, offset, 2); });
  }
  add ("half_stacked", [] { return stacked (generated ({Kind::HEMISPHERE, 3000, 3}), 3, 0.2, 3); });
  // Sampling that is far from even.
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const std::string of_seed = "_seed_" + std::to_string (seed);
    for (const int ratio : {2, 5, 10, 30})
      add ("step_" + std::to_string (ratio) + of_seed, [=] { return densityStep (ratio, seed); });
    for (const int apart : {2, 3, 5, 10, 20, 30})
      for (const double noise : {0.0, 0.01})
        add ("lines_" + std::to_string (apart) + (noise > 0.0 ? "_noisy" : "") + of_seed,
             [=] { return scanLines (apart, noise, seed); });
    if (seed == 2)
      continue; // a point behind a gap of its strewn line counts as an outlier
    for (const int apart : {3, 8, 20})
      for (const double height : {0.0, 20.0})
        add ("strewn_lines_" + std::to_string (apart) + (height > 0.0 ? "_wavy" : "") + of_seed,
             [=] { return strewnLines (apart, height, seed); });
  }
  // Where lines are half as far apart as the neighbours reach, or as far, a few neighbours lie on one of
  // the lines beside.
  for (const double apart : {3.0, 5.0, 7.0, 8.0, 8.5, 9.0, 9.5, 10.0, 10.5, 12.0})
    for (const double spread : {0.0, 0.8})
      add ("even_lines_" + std::to_string (static_cast<int> (10.0 * apart)) +
               (spread > 0.0 ? "_jittered" : ""),
           [=] { return strewnLines (apart, 20.0, 1, spread); });
  for (const int apart : {2, 3, 4, 6})
    for (const int rows : {6, 8, 10})
      add ("window_of_" + std::to_string (rows) + "_lines_" + std::to_string (apart),
           [=] { return windowInLines (apart, rows); });
  return all;
}

INSTANTIATE_TEST_SUITE_P (Surfaces, AnyTopology, testing::ValuesIn (cases ()),
                          [] (const auto& one) { return one.param.name; });

// Topology of a real cloud by its ground truth, and the policy for holes where that is ambiguous.
struct Known
{
  const char* name;
  std::size_t most_folds = 0; // what the ground truth has, but for none
  std::size_t components = 1, loops = 1, handles = 0;
  HoleOptions holes{};
};

void
PrintTo (const Known& cloud, std::ostream* out)
{
  *out << cloud.name;
}

using AnyRealCloud = testing::TestWithParam<Known>;

TEST_P (AnyRealCloud, IsWhatItIs)
{
  const Known& known = GetParam ();
  KnownSurface surface;
  surface.points = realCloud (known.name);
  if (surface.points.empty ())
    GTEST_SKIP () << NO_REAL_CLOUD;
  surface.components = known.components;
  surface.loops = known.loops;
  surface.handles = known.handles;
  Options options;
  options.holes = known.holes;
  const Result result = meshOf (surface.points, options);
  expectTopologyOf (result, surface);
  EXPECT_LE (result.report.check.folds, known.most_folds);
  EXPECT_EQ (result.report.check.self_intersections, 0U);
}

INSTANTIATE_TEST_SUITE_P (
    Clouds, AnyRealCloud,
    testing::Values (Known{"snail"}, Known{"lilium"}, Known{"fandisk"}, Known{"lion_head", 5},
                     Known{"tum_rabbit"}, Known{"camel_head", 7}, Known{"man_bust"}, Known{"bunny"},
                     Known{"max_planck"}, Known{"nefertiti", 197}, Known{"st_helens"},
                     Known{"face_strip"}, Known{"hill_lidar", 30}, Known{"igea"},
                     Known{"field_lidar"}, Known{"spot_closed", 0, 1, 0},
                     Known{"rocker_arm_closed", 0, 1, 0, 1}, Known{"fertility_closed", 0, 1, 0, 4},
                     Known{"two_objects", 46, 2, 0, 1}, Known{"max_planck_mask", 0, 1, 4},
                     Known{"beetle_windows", 0, 1, 11},
                     Known{"bunny_holes", 0, 1, 5, 0, {HolePolicy::KEEP_COUNT, 5}}),
    [] (const testing::TestParamInfo<Known>& cloud) { return std::string (cloud.param.name); });

} // namespace
} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Options that are refused, and warnings on options that have no effect. The verdict on a mesh.
#include "options/check_options.h"

#include "options/option_rows.h"
#include "reconstruct.h"
#include "report/report_mesh.h"
#include "surface_samples.h"

#include <gtest/gtest.h>

#include <type_traits>

namespace pcl::floater {
namespace {
using namespace samples;

constexpr double NO_NUMBER = std::numeric_limits<double>::quiet_NaN ();
constexpr double INF = std::numeric_limits<double>::infinity ();
constexpr auto GOOD = RunStatus::SUCCESS, REFUSED = RunStatus::INVALID_OPTION;
using Change = void (*) (Options&);

// Tries the ends of each range, and what lies beyond them.
struct RangeTrial
{
  Options& options;
  int numbers = 0;

  template <typename Number>
  void operator() (const OptionRow& row, Number& value, const NumberRange& range)
  {
    SCOPED_TRACE (row.name);
    const Number usual = value;
    const auto expect = [&] (double number, bool is_good) {
      value = static_cast<Number> (number);
      const Problem problem = checkOptions (options);
      EXPECT_EQ (problem.status, is_good ? GOOD : REFUSED) << number;
      EXPECT_EQ (problem.option, is_good ? "" : row.name);
      EXPECT_EQ (problem.message, is_good ? "" : row.name + (" must be " + range.text ()));
      value = usual;
    };
    expect (range.least, !range.without_least);
    expect (range.least - 1.0, false);
    if (range.most != NO_LIMIT) {
      expect (range.most, !range.without_most);
      expect (range.most + 1.0, false);
    }
    if (!std::is_integral_v<Number>) {
      expect (NO_NUMBER, false);
      expect (INF, false);
    }
    ++numbers;
  }
  void operator() (const OptionRow& row, HoleOptions& holes, LengthUnit unit)
  {
    holes.unit = unit;
    (*this) (row, holes.largest_hole, NumberRange{0, NO_LIMIT});
  }
  template <typename... More>
  void operator() (const OptionRow&, More&...)
  {
  }
};

TEST (CheckOptions, NumbersHaveRanges)
{
  Options options;
  EXPECT_FALSE (checkOptions (options));
  RangeTrial trial{options};
  visitOptions (options, trial);
  EXPECT_GT (trial.numbers, 15);
  EXPECT_EQ ((NumberRange{6, 200}.text ()), "from 6 to 200");
  EXPECT_EQ ((NumberRange{0, 360, true, true}.text ()), "above 0 and below 360");
  EXPECT_EQ ((NumberRange{0, 1, true, false}.text ()), "above 0 and at most 1");
  EXPECT_EQ ((NumberRange{3, NO_LIMIT}.text ()), "3 or more");
}

TEST (CheckOptions, PoliciesFitTheTopology)
{
  for (const auto& [topology_name, topology] : TOPOLOGY_CHOICES)
    for (const auto& [policy_name, policy] : HOLE_CHOICES) {
      SCOPED_TRACE (std::string (policy_name) + " for " + topology_name);
      Options options;
      options.topology = topology;
      options.holes.policy = policy;
      const bool fits = topology != Topology::DISC || policy == HolePolicy::AUTO ||
                        policy == HolePolicy::KEEP_LARGEST;
      for (const LengthUnit unit : {LengthUnit::SPACINGS, LengthUnit::CLOUD})
        for (const double size : {0.0, 3.0}) {
          options.holes.unit = unit;
          options.holes.largest_hole = size;
          const bool has_size = policy != HolePolicy::BY_SIZE || size > 0.0;
          EXPECT_EQ (checkOptions (options).status, fits && has_size ? GOOD : REFUSED);
        }
    }
}

TEST (CheckOptions, WhatCannotBeIsRefused)
{
  const auto expect = [] (const Options& options, const std::string& words,
                          RunStatus status = REFUSED) {
    const Problem problem = checkOptions (options);
    EXPECT_EQ (problem.status, words.empty () ? GOOD : status) << problem.message << words;
    EXPECT_NE (problem.message.find (words), std::string::npos) << problem.message;
  };
  Options view;
  for (const double coordinate : {NO_NUMBER, INF, 0.0}) {
    view.view.viewpoint = {0.0, coordinate, 0.0};
    view.view.use = ViewUse::NEVER; // it is not read
    expect (view, "");
    view.view.use = ViewUse::GIVEN;
    expect (view, std::isfinite (coordinate) ? "" : "finite");
  }
  view.topology = Topology::DISC;
  expect (view, "no use for a disc");

  Options loop, published;
  for (const std::vector<Index>& few : {std::vector<Index>{1}, std::vector<Index>{1, 2}}) {
    loop.disc.boundary.loop = few;
    expect (loop, "fewer than 3", RunStatus::INVALID_LOOP);
  }
  loop.disc.boundary.loop = {1, 2, 3};
  expect (loop, "");
  loop.topology = Topology::DISC;
  expect (loop, "");
  loop.topology = published.topology = Topology::SURFACE;
  expect (loop, "if a boundary loop is given");
  published.disc = DiscOptions::tw385 ();
  expect (published, "TW 385 makes discs only");
}

Report
madeAs (Topology topology, bool is_view = false)
{
  Report report;
  report.status = RunStatus::SUCCESS;
  report.topology = topology;
  report.is_view = is_view;
  return report;
}

// Changes one option of the table.
struct ChangeOf
{
  std::string name;

  template <typename Number>
  void operator() (const OptionRow& row, Number& value, const NumberRange&)
  {
    if (row.name == name)
      value = value + Number (1);
  }
  void operator() (const OptionRow& row, bool& value) { value = value != (row.name == name); }
  template <typename Enum, std::size_t N>
  void operator() (const OptionRow& row, Enum& value, Choices<Enum, N>& choices)
  {
    if (row.name == name)
      value = choices[choices[0].second == value ? 1 : 0].second;
  }
  void operator() (const OptionRow& row, HoleOptions& holes, LengthUnit unit)
  {
    if (row.name == name) {
      holes.largest_hole = 2.0;
      holes.unit = unit;
    }
  }
  void operator() (const OptionRow&, ViewOptions&) {}
};

// Changes each option of a kind alone, which has no effect, and has one after the other change.
void
expectNoEffect (UsedFor used_for, const Report& report, const std::string& reason,
                const Options& before = {}, Change then = nullptr)
{
  int rows = 0;
  for (const OptionRow& row : OptionValues (Options{}).rows)
    if (row.used_for == used_for) {
      Options options = before;
      visitOptions (options, ChangeOf{row.name});
      EXPECT_EQ (describeUnusedOptions (options, report),
                 std::vector<std::string>{std::string ("an option has no effect: ") + row.name +
                                          "; " + reason});
      if (then != nullptr) {
        then (options);
        EXPECT_TRUE (describeUnusedOptions (options, report).empty ()) << row.name;
      }
      ++rows;
    }
  EXPECT_GT (rows, 0);
}

TEST (UnusedOptions, OfADiscWhereASurfaceIsMade)
{
  const Report surface = madeAs (Topology::SURFACE);
  for (const Report& report : {surface, madeAs (Topology::DISC)})
    EXPECT_TRUE (describeUnusedOptions ({}, report).empty ());
  for (const UsedFor use :
       {UsedFor::DISC, UsedFor::LOOP, UsedFor::TWO_SEGMENTS, UsedFor::POLYGON, UsedFor::ITERATIVE})
    expectNoEffect (use, surface, "the mesh was not made as a disc");
  Options two;
  two.disc.weighting = Weighting::UNIFORM;
  two.disc.solver.method = Solver::BICGSTAB_ILUT;
  EXPECT_EQ (describeUnusedOptions (two, surface),
             std::vector<std::string>{
                 "options have no effect: weights, solver; the mesh was not made as a disc"});
}

// Of two that only work together, the second one alone is of no use, and both together are.
TEST (UnusedOptions, WithoutTheOptionThatTakesThem)
{
  const Report disc = madeAs (Topology::DISC), surface = madeAs (Topology::SURFACE);
  expectNoEffect (UsedFor::TWO_SEGMENTS, disc, "only the boundary method two-segments reads it", {},
                  [] (Options& o) { o.disc.boundary.method = BoundaryMethod::TWO_SEGMENTS; });
  expectNoEffect (UsedFor::POLYGON, disc, "the domain is no polygon", {},
                  [] (Options& o) { o.disc.domain.curve = Domain::POLYGON; });
  expectNoEffect (UsedFor::ITERATIVE, disc, "only the solver bicgstab-ilut reads it", {},
                  [] (Options& o) { o.disc.solver.method = Solver::BICGSTAB_ILUT; });
  expectNoEffect (UsedFor::BALLS, surface, "neighbours are not searched in balls", {},
                  [] (Options& o) { o.neighbors.kind = Neighborhood::BALL_DELAUNAY; });
  expectNoEffect (UsedFor::KEEP_COUNT, surface, "only the hole policy keep-count reads it", {},
                  [] (Options& o) { o.holes.policy = HolePolicy::KEEP_COUNT; });
  expectNoEffect (UsedFor::BY_SIZE, surface, "only the hole policy by-size reads it", {},
                  [] (Options& o) { o.holes.policy = HolePolicy::BY_SIZE; });
  Options given, published;
  given.disc.boundary.loop = {0, 1, 2};
  published.disc = DiscOptions::tw385 ();
  expectNoEffect (UsedFor::LOOP, disc, "the boundary loop is given", given);
  expectNoEffect (UsedFor::SCATTER, disc, "the method of TW 385 keeps all points", published);
}

TEST (UnusedOptions, OfAScanThatIsConnectedAsItsSensorSawIt)
{
  const Report view = madeAs (Topology::SURFACE, true);
  EXPECT_TRUE (describeUnusedOptions ({}, view).empty ());
  for (const UsedFor use :
       {UsedFor::STARS, UsedFor::NEIGHBORHOOD, UsedFor::NEAREST, UsedFor::BALLS, UsedFor::SCATTER})
    expectNoEffect (use, view, "a scan is connected as its sensor saw it, without neighbours");
  // It takes no planes from normals; its facing takes the normals only if it may.
  Options options;
  for (const Facing facing : {Facing::AUTO, Facing::NORMALS, Facing::UP, Facing::OUTWARDS}) {
    options.facing = facing;
    const bool is_read = facing == Facing::AUTO || facing == Facing::NORMALS;
    EXPECT_EQ (describeUnusedOptions (options, view, true).size (), is_read ? 0U : 1U);
    EXPECT_TRUE (describeUnusedOptions (options, view, false).empty ());
    EXPECT_TRUE (describeUnusedOptions (options, madeAs (Topology::SURFACE), true).empty ());
  }
}

void
expectIn (const std::string& text, const std::string& part)
{
  EXPECT_NE (text.find (part), std::string::npos) << text;
}

Report
cleanReport ()
{
  Report report;
  report.statistics.selected_points = report.statistics.working_points = 5000;
  report.statistics.triangles = 10000;
  report.check.largest_area_share = 0.02;
  return report;
}

TEST (Verdict, OfAMeshWithoutFlawsIsGood)
{
  const Verdict verdict = judge (cleanReport ());
  EXPECT_EQ (verdict.value, Quality::GOOD);
  EXPECT_EQ (verdict.cause + verdict.remedy, "");
}

TEST (Verdict, CrossingTrianglesAreExplainedByWhatIsAround)
{
  Report report = cleanReport ();
  report.check.self_intersections = 6;
  EXPECT_EQ (judge (report).value, Quality::USABLE);
  expectIn (judge (report).cause, "6 pairs of triangles cross, one for each 1667 triangles");
  report.check.self_intersections = 500;
  EXPECT_EQ (judge (report).value, Quality::POOR);
  expectIn (judge (report).cause, "sheets");
  report.scatter.resize (200);
  expectIn (judge (report).remedy, "--scatter drop");
  report.statistics.selected_points += 200; // they are left out
  expectIn (judge (report).cause, "sheets");
  report.statistics.projected_points = 3000;
  report.statistics.noise_quantile_90 = 0.75;
  expectIn (judge (report).cause, "noisy (90 % of them by less than 0.75");
  expectIn (judge (report).remedy, "voxel grid");
  report.statistics.stacked_points = 4000;
  expectIn (judge (report).cause, "on one another");
  report.statistics.coordinate_step = 0.5;
  expectIn (judge (report).cause, "coarse");
  expectIn (judge (report).remedy, "more digits");
  report.findings.push_back ({FindingId::COORDINATES_IN_FLOAT, {}, {0, 1, 2}, {}});
  expectIn (judge (report).remedy, "--shift");
}

TEST (Verdict, TheWorstMeasureIsTheCause)
{
  Report report = cleanReport ();
  report.check.largest_area_share = 0.95;
  report.check.self_intersections = 6;
  EXPECT_EQ (judge (report).value, Quality::POOR);
  expectIn (judge (report).cause, "95 % of the area");
  report.is_view = true; // far surfaces have few, large triangles
  report.check.self_intersections = 0;
  EXPECT_EQ (judge (report).value, Quality::USABLE);
  expectIn (judge (report).cause, "seen edge-on");
  report.check.largest_area_share = 0.1;
  EXPECT_EQ (judge (report).value, Quality::GOOD);
  report.check.folds = 700;
  expectIn (judge (report).cause, "700 edges are folded");
  report.statistics.view_steps = 300;
  report.statistics.view_gaps = 800;
  expectIn (judge (report).cause, "9.9 % of the view is open");
  report.unused.resize (600);
  expectIn (judge (report).cause, "12 % of the points are in no triangle");
  EXPECT_EQ (judge (report).value, Quality::POOR);
  report = cleanReport ();
  report.scatter.resize (1000);
  expectIn (judge (report).cause, "20 % of the points lie on no surface");
  expectIn (judge (report).remedy, "--scatter drop");
  report.statistics.selected_points += 1000; // they are left out
  expectIn (judge (report).cause, "17 % of the points lie on no surface");
  expectIn (judge (report).remedy, "--scatter keep");
  report = cleanReport ();
  report.outliers.resize (1000);
  expectIn (judge (report).cause, "17 % of the points lie off any surface");
  report = cleanReport ();
  report.findings.push_back ({FindingId::LONG_EDGES, {}, {50, 20}, {}});
  expectIn (judge (report).cause, "longer");
  report.findings = {{FindingId::GUESSED_UP, {}, {1}, {}}};
  expectIn (judge (report).cause, "guess");
  report.findings = {{FindingId::NO_AREA, {}, {2}, {}}};
  expectIn (judge (report).cause, "no area");
  report.findings = {{FindingId::SMALL_HOLES, {}, {1, 10}, {}}};
  expectIn (judge (report).cause, "holes stay open");
  report.is_view = true; // rays are missing there
  EXPECT_EQ (judge (report).value, Quality::GOOD);
  report.findings = {{FindingId::DEEP_HOLES, {}, {1, 10}, {}}};
  expectIn (judge (report).cause, "holes stay open");
  report.findings = {{FindingId::ONE_SIDED, {}, {8}, {}}};
  expectIn (judge (report).cause, "one-sided");
}

TEST (Verdict, TheLargestHundredthOfTheTrianglesIsMeasured)
{
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < 200; ++i) {
    const double size = i % 100 == 7 ? 10.0 : 1.0; // two of 200
    positions.insert (positions.end (), {{0, 0, 0}, {size, 0, 0}, {0, size, 0}});
    triangles.push_back ({3 * i, 3 * i + 1, 3 * i + 2});
  }
  EXPECT_NEAR (largestAreaShare (triangles, positions), 200.0 / 398.0, 1e-6);
  EXPECT_EQ (largestAreaShare ({}, {}), 0.0);
  triangles.resize (99); // with one of the large ones, which few triangles may have
  EXPECT_EQ (largestAreaShare (triangles, positions), 0.0);
}

TEST (Verdict, OfGeneratedClouds)
{
  const auto of = [] (const Positions& points) { return reconstruct (points, {}).report.verdict; };
  for (const Positions& clean :
       {sheetWithHoles (3, 15.0, 5.0, 5.0, 2).points,
        prism ({rectangle (25.0, 18.0)}, 15.0, 1).points, evenSphere (300), latticeCube (5)})
    EXPECT_EQ (of (clean).value, Quality::GOOD);
  const KnownSurface noisy = withNoise (sheetWithHoles (1, 25.0, 10.0, 10.0, 1), 0.5, 6);
  EXPECT_EQ (of (noisy.points).value, Quality::USABLE);
  Positions rough = evenSphere (300);
  RandomStream random (17);
  for (Eigen::Vector3d& p : rough)
    p *= 0.82 + 0.36 * random.uniform ();
  expectIn (of (rough).cause, "too few for the shape");
}

TEST (Verdict, ThereIsNoneWithoutAMesh)
{
  const Result result = reconstruct (Positions (5, Eigen::Vector3d::Zero ()), {});
  EXPECT_EQ (result.report.verdict.value, Quality::NO_MESH);
  EXPECT_STREQ (qualityName (Quality::NO_MESH), "none");
  EXPECT_STREQ (qualityName (Quality::POOR), "poor");
}

} // namespace
} // namespace pcl::floater

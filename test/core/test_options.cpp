// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Options that are refused, and warnings on options that have no effect.
#include "options/check_options.h"

#include "options/option_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <type_traits>

namespace pcl::floater {
namespace {
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
  void operator() (const OptionRow& row, Enum& value, const Choices<Enum, N>& choices)
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
  for (const UsedFor use : {UsedFor::DISC, UsedFor::LOOP, UsedFor::TWO_SEGMENTS, UsedFor::POLYGON,
                            UsedFor::ITERATIVE, UsedFor::ILUT})
    expectNoEffect (use, surface, "the mesh was not made as a disc");
  Options two;
  two.disc.weighting = Weighting::UNIFORM;
  two.disc.solver.method = Solver::GAUSS_SEIDEL;
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
  expectNoEffect (UsedFor::ITERATIVE, disc, "the solver is direct", {},
                  [] (Options& o) { o.disc.solver.method = Solver::GAUSS_SEIDEL; });
  expectNoEffect (UsedFor::ILUT, disc, "only the solver bicgstab-ilut reads it", {},
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

} // namespace
} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Warnings on options that have no effect.
#include "options/check_options.h"

#include "options/option_rows.h"
#include "samples.h"
#include "surfaces.h"

#include <pcl/surface/floater/reconstruct.h>

#include <gtest/gtest.h>

namespace pcl::floater {
namespace {
using samples::asInput;
using samples::discOptions;
using samples::Positions;

Report
madeAs (Topology topology)
{
  Report report;
  report.status = RunStatus::SUCCESS;
  report.topology = topology;
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

TEST (UnusedOptions, DefaultsAreNone)
{
  for (const Topology topology : {Topology::DISC, Topology::SURFACE})
    EXPECT_TRUE (describeUnusedOptions ({}, madeAs (topology)).empty ());
}

TEST (UnusedOptions, OfADiscWhereASurfaceIsMade)
{
  int disc_options = 0;
  for (const OptionRow& row : OptionValues (Options{}).rows)
    if (row.used_for >= UsedFor::DISC && row.used_for <= UsedFor::ILUT) {
      SCOPED_TRACE (row.name);
      Options options;
      visitOptions (options, ChangeOf{row.name});
      const std::vector<std::string> found =
          describeUnusedOptions (options, madeAs (Topology::SURFACE));
      EXPECT_EQ (found, std::vector<std::string>{std::string ("an option has no effect: ") +
                                                 row.name + "; the mesh was not made as a disc"});
      ++disc_options;
    }
  EXPECT_EQ (disc_options, 14);
  Options two;
  two.disc.weighting = Weighting::UNIFORM;
  two.disc.solver.method = Solver::GAUSS_SEIDEL;
  EXPECT_EQ (describeUnusedOptions (two, madeAs (Topology::SURFACE)),
             std::vector<std::string>{
                 "options have no effect: weights, solver; the mesh was not made as a disc"});
}

// Of two that only work together, the second one alone is of no use, and both together are.
TEST (UnusedOptions, WithoutTheOptionThatTakesThem)
{
  struct Pair
  {
    void (*takes) (Options&);
    void (*is_taken) (Options&);
    Topology topology;
  };
  const Pair pairs[] = {{[] (Options& o) { o.disc.boundary.method = BoundaryMethod::TWO_SEGMENTS; },
                         [] (Options& o) { o.disc.boundary.cluster_k = 11; }, Topology::DISC},
                        {[] (Options& o) { o.disc.domain.curve = Domain::POLYGON; },
                         [] (Options& o) { o.disc.domain.polygon_sides = 5; }, Topology::DISC},
                        {[] (Options& o) { o.disc.solver.method = Solver::GAUSS_SEIDEL; },
                         [] (Options& o) { o.disc.solver.tolerance = 1e-9; }, Topology::DISC},
                        {[] (Options& o) { o.disc.solver.method = Solver::BICGSTAB_ILUT; },
                         [] (Options& o) { o.disc.solver.ilut_fill = 7; }, Topology::DISC},
                        {[] (Options& o) { o.neighbors.kind = Neighborhood::BALL_DELAUNAY; },
                         [] (Options& o) { o.neighbors.ball_radius = 3.0; }, Topology::SURFACE},
                        {[] (Options& o) { o.holes.policy = HolePolicy::KEEP_COUNT; },
                         [] (Options& o) { o.holes.kept_loops = 2; }, Topology::SURFACE},
                        {[] (Options& o) { o.holes.policy = HolePolicy::BY_SIZE; },
                         [] (Options& o) { o.holes.largest_hole = 2.0; }, Topology::SURFACE}};
  for (const Pair& pair : pairs) {
    Options options;
    pair.is_taken (options);
    EXPECT_EQ (describeUnusedOptions (options, madeAs (pair.topology)).size (), 1U);
    pair.takes (options);
    EXPECT_TRUE (describeUnusedOptions (options, madeAs (pair.topology)).empty ());
  }
}

TEST (UnusedOptions, OfScatterInThePublishedMethod)
{
  Options options;
  options.disc = DiscOptions::tw385 ();
  options.scatter = ScatterPolicy::DROP;
  const std::vector<std::string> found = describeUnusedOptions (options, madeAs (Topology::DISC));
  ASSERT_EQ (found.size (), 1U);
  EXPECT_NE (found[0].find ("scatter"), std::string::npos);
}

// A scan takes no planes from normals; its facing takes the normals only if it may.
TEST (UnusedOptions, OfNormalsThatNeitherPlanesNorFacingTake)
{
  Report view = madeAs (Topology::SURFACE);
  view.is_view = true;
  Options options;
  for (const Facing facing : {Facing::AUTO, Facing::NORMALS, Facing::UP, Facing::OUTWARDS}) {
    options.facing = facing;
    const bool is_read = facing == Facing::AUTO || facing == Facing::NORMALS;
    EXPECT_EQ (describeUnusedOptions (options, view, true).size (), is_read ? 0U : 1U);
    EXPECT_TRUE (describeUnusedOptions (options, view, false).empty ());
    EXPECT_TRUE (describeUnusedOptions (options, madeAs (Topology::SURFACE), true).empty ());
  }
}

TEST (UnusedOptions, OfTheSearchForALoopThatIsGiven)
{
  Options options;
  options.disc.boundary.loop = {0, 1, 2};
  options.disc.boundary.method = BoundaryMethod::TWO_SEGMENTS;
  EXPECT_EQ (describeUnusedOptions (options, madeAs (Topology::DISC)).size (), 1U);
}

TEST (UnusedOptions, AreWarningsOfARun)
{
  SurfaceSpec spec;
  spec.kind = SurfaceKind::HEIGHT_FIELD;
  spec.points = 500;
  const Positions points = generateSurface (spec);
  const auto warnsOf = [&points] (const Options& options, const char* name) {
    const Result result = reconstruct (asInput (points), options);
    EXPECT_EQ (result.report.status, RunStatus::SUCCESS) << result.report.message;
    for (const std::string& warning : result.report.warnings)
      if (warning.find (std::string ("no effect: ") + name) != std::string::npos)
        return true;
    return false;
  };
  Options surface, disc = discOptions ();
  surface.topology = Topology::SURFACE;
  surface.disc.weighting = disc.disc.weighting = Weighting::UNIFORM;
  EXPECT_TRUE (warnsOf (surface, "weights"));
  EXPECT_FALSE (warnsOf (disc, "weights"));
}

TEST (UnusedOptions, OfTheNeighborsWhereAScanIsConnectedAsItsSensorSawIt)
{
  Report view = madeAs (Topology::SURFACE);
  view.is_view = true;
  Options options;
  EXPECT_TRUE (describeUnusedOptions (options, view).empty ());
  options.scatter = ScatterPolicy::DROP;
  options.neighbors.k = 30;
  EXPECT_EQ (
      describeUnusedOptions (options, view),
      std::vector<std::string>{
          "options have no effect: scatter, neighbors; a scan is connected as its sensor saw it, "
          "without neighbours"});
}

} // namespace
} // namespace pcl::floater

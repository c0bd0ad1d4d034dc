// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Warnings on options that have no effect.
#include "unused_options.h"

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

// What changes an option, and the name of that option in warnings.
struct Change
{
  const char* name;
  void (*apply) (Options&);
};

const Change OF_THE_DISC[] = {
    {"the boundary method",
     [] (Options& o) { o.disc.boundary.method = BoundaryMethod::CONSENSUS; }},
    {"the opening angle", [] (Options& o) { o.disc.boundary.opening_angle = 150.0; }},
    {"the cluster tolerance", [] (Options& o) { o.disc.boundary.cluster_tolerance = 0.1; }},
    {"the number of cluster neighbours", [] (Options& o) { o.disc.boundary.cluster_k = 11; }},
    {"the domain", [] (Options& o) { o.disc.domain.curve = Domain::SQUARE; }},
    {"the number of polygon sides", [] (Options& o) { o.disc.domain.polygon_sides = 5; }},
    {"the spacing on the domain",
     [] (Options& o) { o.disc.domain.loop_spacing = LoopSpacing::UNIFORM; }},
    {"the weights", [] (Options& o) { o.disc.weighting = Weighting::UNIFORM; }},
    {"the solver", [] (Options& o) { o.disc.solver.method = Solver::GAUSS_SEIDEL; }},
    {"the ordering", [] (Options& o) { o.disc.solver.ordering = Ordering::AMD; }},
    {"the tolerance", [] (Options& o) { o.disc.solver.tolerance = 1e-9; }},
    {"the number of iterations", [] (Options& o) { o.disc.solver.max_iterations = 7; }},
    {"the fill of ILUT", [] (Options& o) { o.disc.solver.ilut_fill = 7; }},
    {"the drop tolerance of ILUT", [] (Options& o) { o.disc.solver.ilut_drop = 0.1; }},
    {"the neighbourhood", [] (Options& o) { o.neighbors.kind = Neighborhood::NEAREST; }}};

TEST (UnusedOptions, DefaultsAreNone)
{
  for (const Topology topology : {Topology::DISC, Topology::SURFACE})
    EXPECT_TRUE (describeUnusedOptions ({}, madeAs (topology)).empty ());
}

TEST (UnusedOptions, OfADiscWhereASurfaceIsMade)
{
  for (const Change& change : OF_THE_DISC) {
    SCOPED_TRACE (change.name);
    Options options;
    change.apply (options);
    const std::vector<std::string> found =
        describeUnusedOptions (options, madeAs (Topology::SURFACE));
    ASSERT_EQ (found.size (), 1U);
    EXPECT_EQ (found[0].find ("an option has no effect: " + std::string (change.name) + ";"), 0U)
        << found[0];
  }
  Options two;
  two.disc.weighting = Weighting::UNIFORM;
  two.disc.solver.method = Solver::GAUSS_SEIDEL;
  EXPECT_EQ (describeUnusedOptions (two, madeAs (Topology::SURFACE)),
             std::vector<std::string>{"options have no effect: the weights, the solver; the mesh "
                                      "was not made as a disc"});
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
                         [] (Options& o) { o.holes.largest_hole = 2.0; }, Topology::SURFACE},
                        {[] (Options& o) { o.holes.policy = HolePolicy::BY_SIZE; },
                         [] (Options& o) { o.holes.unit = LengthUnit::CLOUD; }, Topology::SURFACE}};
  for (const Pair& pair : pairs) {
    Options options;
    pair.is_taken (options);
    EXPECT_EQ (describeUnusedOptions (options, madeAs (pair.topology)).size (), 1U);
    pair.takes (options);
    EXPECT_TRUE (describeUnusedOptions (options, madeAs (pair.topology)).empty ());
  }
}

// Words that a user of the class and one of the tool both know: no names of enumerators, no
// symbols.
TEST (UnusedOptions, AreToldInWords)
{
  Options options;
  options.neighbors.ball_radius = 3.0;
  options.holes.kept_loops = 2;
  options.holes.largest_hole = 2.0;
  options.disc.boundary.cluster_k = 11;
  options.disc.solver.ilut_fill = 7;
  std::string text;
  for (const Topology topology : {Topology::DISC, Topology::SURFACE})
    for (const std::string& warning : describeUnusedOptions (options, madeAs (topology)))
      text += warning + "\n";
  for (const char* word : {"TWO_SEGMENTS", "BICGSTAB", "KEEP_COUNT", "BY_SIZE", " k;", "_"})
    EXPECT_EQ (text.find (word), std::string::npos) << word << " in:\n" << text;
}

TEST (UnusedOptions, OfScatterInThePublishedMethod)
{
  Options options;
  options.disc = DiscOptions::tw385 ();
  options.scatter = ScatterPolicy::DROP;
  const std::vector<std::string> found = describeUnusedOptions (options, madeAs (Topology::DISC));
  ASSERT_EQ (found.size (), 1U);
  EXPECT_NE (found[0].find ("the policy for scatter"), std::string::npos);
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

TEST (UnusedOptions, OfNeighborsWhereAScanIsConnectedAsSeen)
{
  Options options;
  options.neighbors.k = 12;
  Report report = madeAs (Topology::SURFACE);
  EXPECT_TRUE (describeUnusedOptions (options, report).empty ());
  report.is_view = true;
  EXPECT_EQ (describeUnusedOptions (options, report).size (), 1U);
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
  EXPECT_TRUE (warnsOf (surface, "the weights"));
  EXPECT_FALSE (warnsOf (disc, "the weights"));
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
          "options have no effect: the number of neighbours, the policy for scatter; a scan is "
          "connected as its sensor saw it, without neighbours"});
}

} // namespace
} // namespace pcl::floater

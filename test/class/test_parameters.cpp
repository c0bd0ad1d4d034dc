// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Setters and getters of FloaterReconstruction: what is set arrives in the run, and wrong values
// are refused.
#include "mesh_check.h"

namespace pcl::floater {
namespace {
using Class = pcl::FloaterReconstruction<pcl::PointXYZ>;

// A setter with a value, and what the getter says of it: -1 for the default, 1 for that value.
struct Choice
{
  std::string name;
  std::function<void (Class&)> set;
  std::function<int (const Class&)> state;
};

#define CHOICE(parameter, default_value, value)                                                    \
  Choice                                                                                           \
  {                                                                                                \
#parameter, [] (Class& floater) { floater.set##parameter (value); },                         \
        [] (const Class& floater) {                                                                \
          return floater.get##parameter () == (default_value)                                      \
                     ? -1                                                                          \
                     : static_cast<int> (floater.get##parameter () == (value));                    \
        }     \
  }

TEST (FloaterClass, ASetterChangesItsOwnParameter)
{
  static const Options d;
  const std::vector<Choice> all{
      CHOICE (Topology, d.topology, Topology::DISC),
      CHOICE (HolePolicy, d.holes.policy, HolePolicy::KEEP_LARGEST),
      CHOICE (KeptLoops, d.holes.kept_loops, 3),
      CHOICE (LargestHole, d.holes.largest_hole, 5.0),
      {"LargestHoleUnit", [] (Class& floater) { floater.setLargestHole (0.0, LengthUnit::CLOUD); },
       [] (const Class& floater) {
         return floater.getLargestHoleUnit () == d.holes.unit ? -1 : 1;
       }},
      CHOICE (MaximumEdgeLength, d.trimming.maximum_edge_length, 100.0),
      CHOICE (MaximumEdgeRatio, d.trimming.maximum_edge_ratio, 100.0),
      CHOICE (MinimumComponentSize, d.trimming.minimum_component_size, 10),
      CHOICE (RemoveOutliers, d.remove_outliers, false),
      CHOICE (ScatterPolicy, d.scatter, ScatterPolicy::DROP),
      CHOICE (OpenSelfIntersections, d.trimming.open_self_intersections, true),
      CHOICE (Denoise, d.denoise, false),
      CHOICE (KSearch, d.neighbors.k, 12),
      CHOICE (Neighborhood, d.neighbors.kind, Neighborhood::BALL),
      CHOICE (BallRadius, d.neighbors.ball_radius, 3.0),
      CHOICE (FilterSheets, d.filter_sheets, false),
      CHOICE (FlipEdges, d.flip_edges, false),
      CHOICE (Facing, d.facing, Facing::OUTWARDS),
      CHOICE (RemoveSelfIntersections, d.remove_self_intersections, false),
      CHOICE (ViewUse, d.view.use, ViewUse::NEVER),
      CHOICE (NumberOfThreads, 0U, 1U),
      CHOICE (ComputeTextureCoordinates, false, true),
      CHOICE (LargestStretch, TextureOptions ().largest_stretch, 1.5),
      CHOICE (ComputeNormals, false, true),
      CHOICE (UseInputNormals, false, true),
      {"disc", [] (Class& floater) { floater.setDiscOptions (DiscOptions::tw385 ()); },
       [] (const Class& floater) { return floater.getDiscOptions ().as_published ? 1 : -1; }}};
  for (const Choice& chosen : all) {
    Class floater;
    chosen.set (floater);
    const Class copy (floater);
    for (const Choice& choice : all) {
      SCOPED_TRACE (chosen.name + ", " + choice.name);
      const int expected = choice.name == chosen.name ? 1 : -1;
      EXPECT_EQ (choice.state (floater), expected);
      EXPECT_EQ (choice.state (copy), expected);
    }
  }
}

TEST (FloaterClass, ParametersChangeTheRun)
{
  Class floater;
  const Cloud::Ptr cloud = heightField ();
  floater.setInputCloud (cloud);
  const std::size_t whole = runWell (floater).size ();
  floater.setMaximumEdgeLength (1.5);
  EXPECT_LT (runWell (floater).size (), whole);
  EXPECT_EQ (floater.getUnusedIndices ().size (), floater.getStatistics ().trimmed_points);
  floater.setMaximumEdgeLength (0.0);

  floater.setTopology (Topology::DISC);
  DiscOptions options;
  options.solver.method = Solver::BICGSTAB_ILUT;
  options.solver.max_iterations = 2;
  floater.setDiscOptions (options);
  expectFailure (floater, RunStatus::NOT_CONVERGED);
  EXPECT_EQ (floater.getStatistics ().iterations_u, 2U);
}

TEST (FloaterClass, WrongValuesAreRefusedNotReplaced)
{
  Class floater;
  floater.setInputCloud (heightField (100));
  floater.setNumberOfThreads (static_cast<unsigned int> (-1));
  expectFailure (floater, RunStatus::INVALID_OPTION);
  EXPECT_EQ (floater.getNumberOfThreads (), static_cast<unsigned int> (-1));
  floater.setNumberOfThreads (0);
  floater.setKSearch (5);
  expectFailure (floater, RunStatus::INVALID_OPTION);
  EXPECT_EQ (floater.getKSearch (), 5);
  floater.setKSearch (12);
  floater.setViewPoint (0.0, std::nan (""), 0.0);
  expectFailure (floater, RunStatus::INVALID_OPTION);
  floater.setViewUse (ViewUse::AUTO);
  for (const bool faces : {false, true}) { // points without normals have none to use
    floater.setUseInputNormals (!faces);
    floater.setFacing (faces ? Facing::NORMALS : Facing::AUTO);
    expectFailure (floater, RunStatus::INVALID_OPTION);
    EXPECT_NE (floater.getMessage ().find ("no normals"), std::string::npos);
  }
}

// The loop is one of the options of a disc; the later of its two setters counts.
TEST (FloaterClass, AGivenLoopIsAnOptionOfADisc)
{
  Floater floater;
  floater.setInputCloud (heightField ());
  const Triangles expected = runWell (floater);
  const pcl::Indices loop = floater.getBoundaryLoop ();
  DiscOptions options;
  options.boundary.loop.assign (loop.begin (), loop.end ());
  floater.setDiscOptions (options);
  EXPECT_EQ (floater.getPrescribedLoop (), loop);
  floater.setTopology (Topology::AUTO);
  EXPECT_EQ (runWell (floater), expected);
  EXPECT_EQ (floater.getReport ().topology, Topology::DISC);

  const pcl::Indices shorter (loop.begin () + 1, loop.end ());
  floater.setPrescribedLoop (shorter);
  EXPECT_EQ (floater.getDiscOptions ().boundary.loop,
             std::vector<std::uint32_t> (shorter.begin (), shorter.end ()));
  floater.setDiscOptions (floater.getDiscOptions ());
  EXPECT_EQ (floater.getPrescribedLoop (), shorter);
  runWell (floater);
  EXPECT_EQ (floater.getBoundaryLoop ().size (), shorter.size ());

  // An index that the type of the core has not is refused, also on its way through the options.
  for (const pcl::index_t outside : {-1, 500}) {
    floater.setPrescribedLoop ({loop[0], loop[1], outside});
    floater.setDiscOptions (floater.getDiscOptions ());
    expectFailure (floater, RunStatus::INVALID_LOOP);
    EXPECT_NE (floater.getMessage ().find ("point " + std::to_string (outside) + " of"),
               std::string::npos);
  }
  floater.setDiscOptions ({});
  EXPECT_TRUE (floater.getPrescribedLoop ().empty ());
  runWell (floater);
  EXPECT_EQ (floater.getReport ().topology, Topology::SURFACE);
}

} // namespace
} // namespace pcl::floater

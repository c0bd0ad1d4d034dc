// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A boundary loop that the user gives to FloaterReconstruction.
#include "mesh_check.h"

#include <set>

namespace pcl::floater {
namespace {
// A given loop is the boundary of a disc, whatever topology is to be found.
TEST_F (FloaterClass, AGivenLoopMakesADisc)
{
  Floater floater;
  floater.setInputCloud (heightField ());
  const Triangles expected = runWell (floater);
  EXPECT_EQ (floater.getReport ().topology, Topology::DISC);
  const pcl::Indices loop = floater.getBoundaryLoop ();
  floater.setTopology (Topology::AUTO);
  floater.setPrescribedLoop (loop);
  EXPECT_EQ (runWell (floater), expected);
  EXPECT_EQ (floater.getReport ().topology, Topology::DISC);
  EXPECT_FALSE (floater.getParameters ().empty ());
}

TEST_F (FloaterClass, TakesTheUsersLoop)
{
  const Cloud::Ptr cloud = heightField ();
  Floater floater;
  floater.setInputCloud (cloud);
  const Triangles expected = runWell (floater);
  pcl::Indices loop = floater.getBoundaryLoop ();

  std::rotate (loop.begin (), loop.begin () + 5, loop.end ());
  floater.setPrescribedLoop (loop);
  EXPECT_EQ (floater.getPrescribedLoop (), loop);
  EXPECT_EQ (runWell (floater), expected);
  EXPECT_EQ (floater.getPrescribedLoop (), loop);
  const std::set<pcl::index_t> members (loop.begin (), loop.end ());
  const pcl::Indices found = floater.getBoundaryLoop ();
  EXPECT_EQ (std::set<pcl::index_t> (found.begin (), found.end ()), members);

  std::reverse (loop.begin (), loop.end ());
  floater.setPrescribedLoop (loop);
  const Triangles reversed = runWell (floater);
  EXPECT_TRUE (reversed == expected || turnedOver (reversed) == expected);

  // A given loop is used as it is: a border point that it leaves out becomes interior, or is cut
  // off.
  loop.erase (loop.begin ());
  floater.setPrescribedLoop (loop);
  runWell (floater);
  EXPECT_EQ (floater.getBoundaryLoop ().size (), loop.size ());

  floater.setPrescribedLoop ({});
  EXPECT_EQ (runWell (floater), expected);
}

// The loop is one of the options of a disc; the later of its two setters counts.
TEST_F (FloaterClass, AGivenLoopIsAnOptionOfADisc)
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

  pcl::Indices shorter (loop.begin () + 1, loop.end ());
  floater.setPrescribedLoop (shorter);
  EXPECT_EQ (floater.getDiscOptions ().boundary.loop,
             std::vector<std::uint32_t> (shorter.begin (), shorter.end ()));
  options = floater.getDiscOptions ();
  options.weighting = Weighting::UNIFORM;
  floater.setDiscOptions (options);
  EXPECT_EQ (floater.getPrescribedLoop (), shorter);
  runWell (floater);
  EXPECT_EQ (floater.getBoundaryLoop ().size (), shorter.size ());

  floater.setDiscOptions ({});
  EXPECT_TRUE (floater.getPrescribedLoop ().empty ());
  runWell (floater);
  EXPECT_EQ (floater.getReport ().topology, Topology::SURFACE);
  // An index that the type of the core has not is refused, also on its way through the options.
  floater.setPrescribedLoop ({loop[0], loop[1], -1});
  floater.setDiscOptions (floater.getDiscOptions ());
  expectFailure (floater, RunStatus::INVALID_LOOP);
  EXPECT_NE (floater.getMessage ().find ("point -1 of"), std::string::npos);
}

} // namespace
} // namespace pcl::floater

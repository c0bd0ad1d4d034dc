// SPDX-License-Identifier: GPL-3.0-or-later
// A boundary loop that the user gives to FloaterReconstruction.
#include "mesh_check.h"

#include <set>

namespace pcl
{
namespace floater
{
namespace
{
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

} // namespace
} // namespace floater
} // namespace pcl

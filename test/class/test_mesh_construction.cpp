// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// FloaterMeshConstruction, and what FloaterReconstruction has in common with PCL's mesh
// construction: triangles without a copy of the cloud, and what each point is in the mesh.
#include "mesh_check.h"

#include <pcl/search/kdtree.h>
#include <pcl/surface/floater_mesh_construction.h>
#include <pcl/surface/gp3.h>

#include <limits>

namespace pcl::floater {
namespace {
using Mesher = pcl::FloaterMeshConstruction<pcl::PointXYZ>;
using State = ReconstructionState::PointState;

TEST_F (FloaterClass, IsDropInForMeshConstruction)
{
  const Cloud::Ptr cloud = heightField ();
  cloud->header.frame_id = "scanner";
  cloud->header.stamp = 1234567;
  pcl::FloaterReconstruction<pcl::PointXYZ> alone;
  alone.setInputCloud (cloud);
  const Triangles expected = runWell (alone);

  const pcl::MeshConstruction<pcl::PointXYZ>::Ptr mesher (new Mesher);
  mesher->setInputCloud (cloud);
  Polygons polygons (5);
  mesher->reconstruct (polygons);
  EXPECT_EQ (trianglesOf (polygons), expected);
  pcl::PolygonMesh mesh;
  mesh.polygons.resize (5);
  mesher->reconstruct (mesh);
  EXPECT_EQ (trianglesOf (mesh.polygons), expected);
  EXPECT_EQ (mesh.header.frame_id, "scanner");
  EXPECT_EQ (mesh.header.stamp, 1234567U);
  pcl::PCLPointCloud2 whole;
  pcl::toPCLPointCloud2 (*cloud, whole);
  EXPECT_EQ (mesh.cloud.data, whole.data);
  EXPECT_EQ (mesh.cloud.width, whole.width);

  const pcl::PCLSurfaceBase<pcl::PointXYZ>::Ptr surface = mesher;
  surface->reconstruct (mesh);
  EXPECT_EQ (trianglesOf (mesh.polygons), expected);
}

TEST_F (FloaterClass, MeshConstructionPassesOnWhatItIsGiven)
{
  const Cloud::Ptr cloud = heightField ();
  Mesher mesher;
  mesher.floater ().setTopology (Topology::DISC);
  mesher.setInputCloud (cloud);
  Polygons polygons;
  mesher.reconstruct (polygons);
  const Triangles whole = trianglesOf (polygons);
  const Mesher& same = mesher;
  EXPECT_EQ (same.floater ().getReport ().topology, Topology::DISC);
  EXPECT_EQ (same.floater ().getParameters ().size (), cloud->size ());

  const pcl::IndicesPtr indices (new pcl::Indices);
  for (pcl::index_t i = 0; i < 500; i += 2)
    indices->push_back (i);
  mesher.setIndices (indices);
  mesher.reconstruct (polygons);
  EXPECT_EQ (same.floater ().getStatistics ().selected_points, 250U);
  ASSERT_FALSE (polygons.empty ());
  for (const pcl::Vertices& polygon : polygons)
    for (const pcl::index_t p : polygon.vertices)
      EXPECT_EQ (p % 2, 0);
  mesher.setIndices (pcl::IndicesPtr ());

  const pcl::search::KdTree<pcl::PointXYZ>::Ptr tree (new pcl::search::KdTree<pcl::PointXYZ>);
  mesher.setSearchMethod (tree);
  mesher.reconstruct (polygons);
  EXPECT_EQ (trianglesOf (polygons), whole);
  EXPECT_EQ (tree->getInputCloud (), cloud);
  mesher.setSearchMethod (nullptr);
  mesher.reconstruct (polygons);
  EXPECT_EQ (mesher.floater ().getSearchMethod (), nullptr);

  // After another cloud, and after none.
  mesher.floater ().setTopology (Topology::AUTO);
  mesher.setInputCloud (heightField (300));
  mesher.reconstruct (polygons);
  EXPECT_EQ (same.floater ().getStatistics ().used_points, 300U);
  mesher.setInputCloud (nullptr);
  mesher.reconstruct (polygons);
  EXPECT_EQ (same.floater ().getStatus (), RunStatus::NO_INPUT);
  EXPECT_TRUE (polygons.empty ());
  pcl::PolygonMesh mesh;
  mesh.polygons.resize (2);
  mesher.reconstruct (mesh);
  EXPECT_TRUE (mesh.polygons.empty ());
}

// The states have the values of PCL's class, so that programs may compare them with its names.
using Greedy = pcl::GreedyProjectionTriangulation<pcl::PointNormal>;
static_assert (static_cast<int> (State::NONE) == static_cast<int> (Greedy::NONE) &&
                   static_cast<int> (State::FREE) == static_cast<int> (Greedy::FREE) &&
                   static_cast<int> (State::FRINGE) == static_cast<int> (Greedy::FRINGE) &&
                   static_cast<int> (State::BOUNDARY) == static_cast<int> (Greedy::BOUNDARY) &&
                   static_cast<int> (State::COMPLETED) == static_cast<int> (Greedy::COMPLETED),
               "the states are those of PCL's class");

// Two sheets far apart, some of the points not selected, one without a place, and one twice.
TEST_F (FloaterClass, TellsWhatEachPointIsInTheMesh)
{
  const Cloud::Ptr cloud = heightField ();
  constexpr pcl::index_t SHEET = 500;
  for (pcl::index_t i = 0; i < SHEET; ++i) {
    pcl::PointXYZ moved = (*cloud)[i];
    moved.x += 1000.0F;
    cloud->push_back (moved);
  }
  const auto nowhere = static_cast<pcl::index_t> (cloud->size ());
  cloud->push_back (pcl::PointXYZ (std::numeric_limits<float>::quiet_NaN (), 0.0F, 0.0F));
  const auto twice = static_cast<pcl::index_t> (cloud->size ());
  cloud->push_back ((*cloud)[3]);
  const auto unselected = static_cast<pcl::index_t> (cloud->size ());
  cloud->push_back (pcl::PointXYZ (1.0F, 1.0F, 1.0F));
  const pcl::IndicesPtr indices (new pcl::Indices);
  for (pcl::index_t i = 0; i < unselected; ++i)
    indices->push_back (i);

  pcl::FloaterReconstruction<pcl::PointXYZ> floater;
  EXPECT_TRUE (floater.getPartIDs ().empty ());
  EXPECT_TRUE (floater.getPointStates ().empty ());
  floater.setInputCloud (cloud);
  floater.setIndices (indices);
  const Triangles triangles = runWell (floater);
  ASSERT_EQ (floater.getMeshCheck ().components, 2U);

  std::set<std::pair<pcl::index_t, pcl::index_t>> edges;
  for (const auto& t : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      edges.emplace (t[i], t[(i + 1) % 3]);
  std::vector<int> states (cloud->size (), State::NONE), parts (cloud->size (), -1);
  states[static_cast<std::size_t> (twice)] = State::FREE;
  for (const pcl::index_t p : floater.getUnusedIndices ())
    states[static_cast<std::size_t> (p)] = State::FREE;
  for (const auto& [from, to] : edges) {
    const auto p = static_cast<std::size_t> (from);
    states[p] = std::max<int> (states[p], State::BOUNDARY);
    parts[p] = from < SHEET ? 0 : 1;
  }
  std::set<pcl::index_t> border;
  for (const auto& [from, to] : edges)
    if (edges.count ({to, from}) == 0)
      border.insert ({from, to});
  ASSERT_GT (border.size (), 50U);
  for (const auto& [from, to] : edges)
    if (border.count (from) == 0)
      states[static_cast<std::size_t> (from)] = State::COMPLETED;
  EXPECT_EQ (floater.getPointStates (), states);
  EXPECT_EQ (floater.getPartIDs (), parts);
  EXPECT_EQ (states[static_cast<std::size_t> (nowhere)], State::NONE);
  EXPECT_EQ (states[static_cast<std::size_t> (unselected)], State::NONE);
  EXPECT_GT (std::count (states.begin (), states.end (), State::COMPLETED), 800);

  // On the other side of the cloud's order, the other sheet is the first part.
  cloud->resize (2 * SHEET);
  std::reverse (cloud->begin (), cloud->end ());
  floater.setIndices (pcl::IndicesPtr ());
  runWell (floater);
  ASSERT_EQ (floater.getPartIDs ().size (), cloud->size ());
  EXPECT_EQ (floater.getPartIDs ().back (), 1);
  const pcl::FloaterReconstruction<pcl::PointXYZ> copy (floater);
  EXPECT_EQ (copy.getPartIDs (), floater.getPartIDs ());

  floater.setKSearch (5);
  expectFailure (floater, RunStatus::INVALID_OPTION);
  EXPECT_TRUE (floater.getPartIDs ().empty ());
  EXPECT_TRUE (floater.getPointStates ().empty ());
}

} // namespace
} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the classes tell besides the triangles, and what they take from a cloud besides its places:
// states of points, normals, texture coordinates, the place of the sensor; the method of TW 385
// with PCL's own parts.
#include "mesh_check.h"

#include <pcl/PolygonMesh.h>
#include <pcl/conversions.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/floater/vertex_normals.h>
#include <pcl/surface/floater_mesh_construction.h>
#include <pcl/surface/gp3.h>

namespace pcl::floater {
namespace {
using Class = pcl::FloaterReconstruction<pcl::PointXYZ>;
using State = ReconstructionState::PointState;
using NormalCloud = pcl::PointCloud<pcl::PointNormal>;
using Corners = std::vector<std::array<std::uint32_t, 3>>;

std::vector<Eigen::Vector3d>
positionsOf (const Cloud& cloud)
{
  std::vector<Eigen::Vector3d> positions;
  for (const pcl::PointXYZ& point : cloud)
    positions.emplace_back (point.x, point.y, point.z);
  return positions;
}

// As long as twice the area of the triangle.
template <typename PointT>
Eigen::Vector3f
normalOf (const pcl::PointCloud<PointT>& cloud, const pcl::Vertices& triangle)
{
  const auto at = [&] (std::size_t i) { return cloud[triangle.vertices[i]].getVector3fMap (); };
  return (at (1) - at (0)).cross (at (2) - at (0));
}

TEST (FloaterClass, MeshConstructionPassesOnWhatItIsGiven)
{
  const Cloud::Ptr cloud = heightField ();
  pcl::FloaterMeshConstruction<pcl::PointXYZ> mesher;
  mesher.floater ().setTopology (Topology::DISC);
  mesher.setInputCloud (cloud);
  Polygons polygons;
  mesher.reconstruct (polygons);
  const Triangles whole = trianglesOf (polygons);
  const auto& floater = std::as_const (mesher).floater ();
  EXPECT_EQ (floater.getReport ().topology, Topology::DISC);

  const pcl::IndicesPtr indices (new pcl::Indices);
  for (pcl::index_t i = 0; i < 500; i += 2)
    indices->push_back (i);
  mesher.setIndices (indices);
  mesher.reconstruct (polygons);
  EXPECT_EQ (floater.getStatistics ().selected_points, 250U);
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

  mesher.setInputCloud (nullptr);
  mesher.reconstruct (polygons);
  EXPECT_EQ (floater.getStatus (), RunStatus::NO_INPUT);
  EXPECT_TRUE (polygons.empty ());
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
TEST (FloaterClass, TellsWhatEachPointIsInTheMesh)
{
  constexpr std::size_t SHEET = 500, NOT_FINITE = 1000, TWICE = 1001, UNSELECTED = 1002;
  const Cloud::Ptr cloud = heightField (SHEET);
  for (std::size_t i = 0; i < SHEET; ++i) {
    pcl::PointXYZ moved = (*cloud)[i];
    moved.x += 1000.0F;
    cloud->push_back (moved);
  }
  cloud->push_back (pcl::PointXYZ (std::nanf (""), 0.0F, 0.0F));
  cloud->push_back ((*cloud)[3]);
  cloud->push_back (pcl::PointXYZ (1.0F, 1.0F, 1.0F));
  const pcl::IndicesPtr indices (new pcl::Indices (UNSELECTED));
  std::iota (indices->begin (), indices->end (), 0);

  Class floater;
  EXPECT_TRUE (floater.getPartIDs ().empty () && floater.getPointStates ().empty ());
  floater.setInputCloud (cloud);
  floater.setIndices (indices);
  const Triangles triangles = runWell (floater);
  ASSERT_EQ (floater.getMeshCheck ().components, 2U);

  std::set<std::pair<pcl::index_t, pcl::index_t>> edges;
  for (const auto& t : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      edges.emplace (t[i], t[(i + 1) % 3]);
  std::vector<int> states (cloud->size (), State::NONE), parts (cloud->size (), -1);
  states[TWICE] = State::FREE;
  for (const pcl::index_t p : floater.getUnusedIndices ())
    states[static_cast<std::size_t> (p)] = State::FREE;
  for (const auto& [from, to] : edges) {
    states[static_cast<std::size_t> (from)] = State::COMPLETED;
    parts[static_cast<std::size_t> (from)] = from < static_cast<pcl::index_t> (SHEET) ? 0 : 1;
  }
  for (const auto& [from, to] : edges)
    if (edges.count ({to, from}) == 0)
      for (const pcl::index_t p : {from, to})
        states[static_cast<std::size_t> (p)] = State::BOUNDARY;
  EXPECT_EQ (floater.getPointStates (), states);
  EXPECT_EQ (floater.getPartIDs (), parts);
  EXPECT_EQ (states[NOT_FINITE], State::NONE);
  EXPECT_EQ (states[UNSELECTED], State::NONE);
  EXPECT_GT (std::count (states.begin (), states.end (), State::BOUNDARY), 50);
  EXPECT_GT (std::count (states.begin (), states.end (), State::COMPLETED), 800);

  floater.setKSearch (5);
  expectFailure (floater, RunStatus::INVALID_OPTION);
  EXPECT_TRUE (floater.getPartIDs ().empty () && floater.getPointStates ().empty ());
}

// A sphere around the origin whose normals point to its middle.
NormalCloud::Ptr
bodyWithInwardNormals ()
{
  NormalCloud::Ptr cloud = makeCloud<pcl::PointNormal> (SurfaceKind::SPHERE, 2000);
  for (pcl::PointNormal& point : *cloud) {
    point.getNormalVector3fMap () = -point.getVector3fMap ().normalized ();
    point.curvature = 0.5F;
  }
  return cloud;
}

TEST (FloaterClass, TakesTheNormalsOfPointsIfAskedTo)
{
  const NormalCloud::Ptr cloud = bodyWithInwardNormals ();
  pcl::FloaterReconstruction<pcl::PointNormal> floater;
  floater.setInputCloud (cloud);
  Polygons polygons;
  const auto faces_outwards = [&] (Facing facing, bool use_normals) {
    floater.setFacing (facing);
    floater.setUseInputNormals (use_normals);
    floater.reconstruct (polygons);
    EXPECT_EQ (floater.getStatus (), RunStatus::SUCCESS) << floater.getMessage ();
    const auto a = (*cloud)[polygons.front ().vertices[0]].getVector3fMap ();
    return normalOf (*cloud, polygons.front ()).dot (a) > 0.0F;
  };
  EXPECT_TRUE (faces_outwards (Facing::AUTO, false));
  EXPECT_FALSE (faces_outwards (Facing::NORMALS, false));
  EXPECT_FALSE (faces_outwards (Facing::AUTO, true));
  EXPECT_TRUE (faces_outwards (Facing::OUTWARDS, true));

  // They are those of the planes as well. Zones with crossing triangles would be made anew without planes.
  floater.setRemoveSelfIntersections (false);
  EXPECT_TRUE (faces_outwards (Facing::OUTWARDS, false));
  const Triangles fitted = trianglesOf (polygons);
  for (pcl::PointNormal& point : *cloud)
    point.getNormalVector3fMap () = Eigen::Vector3f::UnitX ();
  (void)faces_outwards (Facing::OUTWARDS, true);
  EXPECT_NE (trianglesOf (polygons), fitted);
}

// The neighbours and planes of PCL give the mesh that the core's own give, but for ties; of
// selected points, with one that is not finite, and with a search method of the user's as well.
TEST (FloaterClass, TheMethodOfTheReportTakesPclsOwnParts)
{
  const Cloud::Ptr cloud = heightField (3000);
  const pcl::IndicesPtr indices (new pcl::Indices);
  for (pcl::index_t i = 0; i < static_cast<pcl::index_t> (cloud->size ()); ++i)
    if ((*cloud)[i].x < 40.0F)
      indices->push_back (i);
  const pcl::index_t nowhere = (*indices)[10];
  (*cloud)[nowhere].z = std::numeric_limits<float>::infinity ();
  Class floater;
  floater.setDiscOptions (DiscOptions::tw385 ());
  floater.setInputCloud (cloud);
  floater.setIndices (indices);
  const Triangles by_pcl = runWell (floater);
  EXPECT_EQ (floater.getNonFiniteIndices (), pcl::Indices{nowhere});
  floater.setSearchMethod (
      pcl::search::Search<pcl::PointXYZ>::Ptr (new pcl::search::KdTree<pcl::PointXYZ>));
  EXPECT_EQ (runWell (floater).size (), by_pcl.size ());

  Options options;
  options.disc = DiscOptions::tw385 ();
  const Result own = reconstruct (positionsOf (Cloud (*cloud, *indices)), options);
  ASSERT_EQ (own.report.status, RunStatus::SUCCESS) << own.report.message;
  std::size_t same = 0;
  for (const auto& t : own.triangles) {
    std::array<pcl::index_t, 3> corners{(*indices)[t[0]], (*indices)[t[1]], (*indices)[t[2]]};
    std::rotate (corners.begin (), std::min_element (corners.begin (), corners.end ()),
                 corners.end ());
    same += by_pcl.count (corners);
  }
  EXPECT_EQ (own.triangles.size (), by_pcl.size ());
  EXPECT_GE (same * 100, by_pcl.size () * 99);
}

TEST (FloaterClass, NormalsOfTheMeshAreFieldsOfItsCloud)
{
  const Cloud::Ptr cloud = heightField ();
  cloud->points[7].x = std::nanf (""); // in no triangle, as the first point, which is not selected
  const pcl::IndicesPtr indices (new pcl::Indices (499));
  std::iota (indices->begin (), indices->end (), 1);
  Class floater;
  floater.setInputCloud (cloud);
  floater.setIndices (indices);
  pcl::PolygonMesh plain, mesh;
  floater.reconstruct (plain);
  EXPECT_TRUE (floater.getNormals ().empty ());
  floater.setComputeNormals (true);
  floater.reconstruct (mesh);
  ASSERT_EQ (floater.getStatus (), RunStatus::SUCCESS) << floater.getMessage ();
  EXPECT_EQ (trianglesOf (mesh.polygons), trianglesOf (plain.polygons));
  EXPECT_EQ (plain.cloud.fields.size () + 3, mesh.cloud.fields.size ());
  NormalCloud points;
  pcl::fromPCLPointCloud2 (mesh.cloud, points);
  ASSERT_EQ (points.size (), cloud->size ());
  Corners corners;
  for (const pcl::Vertices& polygon : mesh.polygons) {
    const std::vector<std::uint32_t> t (polygon.vertices.begin (), polygon.vertices.end ());
    corners.push_back ({t[0], t[1], t[2]});
  }
  const std::vector<Eigen::Vector3f> normals = vertexNormals (positionsOf (*cloud), corners);
  EXPECT_EQ (floater.getNormals (), normals);
  for (std::size_t p = 0; p < points.size (); ++p) {
    EXPECT_EQ (points[p].getNormalVector3fMap (), normals[p]);
    EXPECT_TRUE (p == 7 || points[p].getVector3fMap () == (*cloud)[p].getVector3fMap ());
    EXPECT_EQ (normals[p].norm () == 0.0F, p == 7 || p == 0) << p;
  }
  // Nothing of them is left by a run that fails.
  floater.setKSearch (1);
  expectFailure (floater, RunStatus::INVALID_OPTION);
  EXPECT_TRUE (floater.getNormals ().empty ());
}

TEST (FloaterClass, NormalsOfTheMeshReplaceThoseOfTheInput)
{
  const NormalCloud::Ptr cloud = bodyWithInwardNormals ();
  pcl::FloaterReconstruction<pcl::PointNormal> floater;
  floater.setInputCloud (cloud);
  floater.setComputeNormals (true);
  NormalCloud points, of_mesh;
  Polygons polygons;
  floater.reconstruct (points, polygons);
  pcl::PolygonMesh mesh;
  floater.reconstruct (mesh);
  ASSERT_EQ (floater.getStatus (), RunStatus::SUCCESS) << floater.getMessage ();
  pcl::fromPCLPointCloud2 (mesh.cloud, of_mesh);
  for (const NormalCloud& made : {points, of_mesh}) {
    ASSERT_EQ (made.size (), cloud->size ());
    for (std::size_t p = 0; p < made.size (); ++p) {
      EXPECT_EQ (made[p].getNormalVector3fMap (), floater.getNormals ()[p]);
      EXPECT_GT (made[p].getNormalVector3fMap ().dot (made[p].getVector3fMap ()), 0.0F);
      EXPECT_EQ (made[p].curvature, 0.5F);
      EXPECT_LT ((*cloud)[p].getNormalVector3fMap ().dot ((*cloud)[p].getVector3fMap ()), 0.0F);
    }
  }
}

// Points that are not selected, or not finite, have no texture coordinates.
TEST (FloaterClass, TextureCoordinatesAreThoseOfTheMesh)
{
  const auto make = [] (SurfaceKind kind) {
    const Cloud::Ptr cloud = makeCloud<pcl::PointXYZ> (kind, 1500);
    cloud->insert (cloud->begin (), 5, pcl::PointXYZ (1.0F, 2.0F, std::nanf ("")));
    return cloud;
  };
  const pcl::IndicesPtr indices (new pcl::Indices (1502));
  std::iota (indices->begin (), indices->end (), 3);
  Class floater;
  floater.setInputCloud (make (SurfaceKind::SPHERE));
  floater.setIndices (indices);
  Polygons polygons;
  floater.reconstruct (polygons);
  EXPECT_EQ (floater.getTextureCoordinates ().status, RunStatus::NOT_RUN);
  floater.setComputeTextureCoordinates (true);
  const auto charts = [&] {
    floater.reconstruct (polygons);
    const TextureCoordinates& texture = floater.getTextureCoordinates ();
    EXPECT_EQ (texture.status, RunStatus::SUCCESS);
    EXPECT_EQ (texture.corners.size (), polygons.size ());
    for (std::size_t t = 0; t < texture.corners.size (); ++t)
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ (texture.points[texture.corners[t][i]], polygons[t].vertices[i]);
    return texture.chart_count;
  };
  const std::size_t by_default = charts ();
  EXPECT_GT (by_default, 1U);
  floater.setLargestStretch (1.001);
  EXPECT_GT (charts (), by_default);
  floater.setInputCloud (make (SurfaceKind::FINGER));
  floater.setTopology (Topology::DISC);
  EXPECT_EQ (charts (), 1U);
  // A later run without them forgets them.
  floater.setComputeTextureCoordinates (false);
  floater.reconstruct (polygons);
  EXPECT_TRUE (floater.getTextureCoordinates ().coordinates.empty ());
}

TEST (FloaterClass, TextureFailuresAreThoseOfTheRun)
{
  Class floater;
  floater.setInputCloud (makeCloud<pcl::PointXYZ> (SurfaceKind::SPHERE, 600));
  floater.setComputeTextureCoordinates (true);
  floater.setLargestStretch (0.5);
  expectFailure (floater, RunStatus::INVALID_OPTION);
  EXPECT_TRUE (floater.getPartIDs ().empty ());
  EXPECT_NE (floater.getMessage ().find ("stretch"), std::string::npos);

  // Progress goes through both parts, and the second one can be cancelled as well.
  floater.setLargestStretch (1.06);
  std::vector<double> fractions;
  floater.setProgressCallback ([&fractions] (double done) { fractions.push_back (done); });
  runWell (floater);
  EXPECT_TRUE (std::is_sorted (fractions.begin (), fractions.end ()));
  EXPECT_EQ (std::count (fractions.begin (), fractions.end (), 1.0), 1);
  floater.setCancelledCallback ([&fractions] { return fractions.back () >= 0.5; });
  fractions.assign (1, 0.0);
  Polygons polygons;
  floater.reconstruct (polygons);
  EXPECT_EQ (floater.getStatus (), RunStatus::CANCELLED);
  EXPECT_EQ (floater.getTextureCoordinates ().status, RunStatus::CANCELLED);
}

// The hills lie on their backs, as a sensor below them sees them; the output has the rows of the cloud.
TEST (FloaterClass, TakesTheSensorOriginAndTheRowsOfACloud)
{
  const Cloud::Ptr cloud = heightField ();
  cloud->width = 50;
  cloud->height = 10;
  Class floater;
  floater.setFacing (Facing::VIEWPOINT);
  floater.setViewUse (ViewUse::NEVER);
  for (const float height : {-40.0F, 40.0F}) {
    cloud->sensor_origin_ = {10.0F, 10.0F, height, 0.0F};
    floater.setInputCloud (cloud);
    Cloud points;
    Polygons polygons;
    floater.reconstruct (points, polygons);
    ASSERT_EQ (floater.getStatus (), RunStatus::SUCCESS) << floater.getMessage ();
    EXPECT_EQ (points.width, 50U);
    EXPECT_EQ (points.height, 10U);
    EXPECT_GT (normalOf (points, polygons.front ()).z () * height, 0.0F);
  }
}

} // namespace
} // namespace pcl::floater

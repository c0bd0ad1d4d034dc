// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Input and output of FloaterReconstruction: clouds, indices, search methods, callbacks, failures;
// what an object consists of, and its copies.
#include "mesh_check.h"

#include <pcl/console/print.h>
#include <pcl/search/brute_force.h>
#include <pcl/search/kdtree.h>
#include <pcl/search/octree.h>
#include <pcl/surface/floater_mesh_construction.h>

#include <thread>
#include <type_traits>

namespace pcl::floater {
namespace {
constexpr float NOWHERE = std::numeric_limits<float>::quiet_NaN ();

// Each class of ours in the place of PCL's: with the header, the points and all of the mesh.
TEST (FloaterClass, IsDropInThroughTheBaseClasses)
{
  using Mesher = pcl::FloaterMeshConstruction<pcl::PointXYZ>;
  const Cloud::Ptr cloud = heightField ();
  cloud->header.frame_id = "scanner";
  cloud->header.seq = 7;
  cloud->header.stamp = 1234567;
  pcl::PCLPointCloud2 whole;
  pcl::toPCLPointCloud2 (*cloud, whole);
  pcl::FloaterReconstruction<pcl::PointXYZ> alone;
  alone.setInputCloud (cloud);
  const Triangles expected = runWell (alone);

  const pcl::SurfaceReconstruction<pcl::PointXYZ>::Ptr reconstruction (
      new pcl::FloaterReconstruction<pcl::PointXYZ>);
  const pcl::MeshConstruction<pcl::PointXYZ>::Ptr mesher (new Mesher);
  const std::vector<pcl::PCLSurfaceBase<pcl::PointXYZ>::Ptr> surfaces{reconstruction, mesher};
  for (const auto& surface : surfaces) {
    surface->setInputCloud (cloud);
    pcl::PolygonMesh mesh;
    mesh.polygons.resize (5);
    surface->reconstruct (mesh);
    EXPECT_EQ (mesh.header, cloud->header);
    EXPECT_EQ (mesh.cloud.data, whole.data);
    EXPECT_EQ (mesh.cloud.width, whole.width);
    EXPECT_EQ (mesh.cloud.header, cloud->header);
    EXPECT_EQ (trianglesOf (mesh.polygons), expected);
  }
  Cloud points;
  Polygons polygons (5);
  reconstruction->reconstruct (points, polygons);
  EXPECT_EQ (points.header, cloud->header);
  ASSERT_EQ (points.size (), cloud->size ());
  for (std::size_t i = 0; i < points.size (); ++i)
    EXPECT_EQ (points[i].getVector3fMap (), (*cloud)[i].getVector3fMap ());
  EXPECT_EQ (trianglesOf (polygons), expected);
  polygons.resize (5);
  mesher->reconstruct (polygons);
  EXPECT_EQ (trianglesOf (polygons), expected);
}

template <typename PointT>
class FloaterClassOf : public testing::Test
{
};

using OtherTypes =
    testing::Types<pcl::PointXYZI, pcl::PointXYZRGB, pcl::PointXYZRGBA, pcl::PointNormal,
                   pcl::PointXYZINormal, pcl::PointXYZRGBNormal, pcl::PointWithRange>;
TYPED_TEST_SUITE (FloaterClassOf, OtherTypes, );

// Whatever a point has besides its place is in the mesh.
TYPED_TEST (FloaterClassOf, IsInstantiatedAndKeepsAllFields)
{
  auto cloud = makeCloud<TypeParam> (SurfaceKind::HEIGHT_FIELD, 100);
  pcl::PCLPointCloud2 whole;
  pcl::toPCLPointCloud2 (*cloud, whole);
  for (const pcl::PCLPointField& field : whole.fields)
    for (std::size_t i = 0; field.name.size () > 1 && i < cloud->size (); ++i) // not x, y and z
      whole.data[i * whole.point_step + field.offset] = static_cast<std::uint8_t> (i);
  pcl::fromPCLPointCloud2 (whole, *cloud);
  pcl::toPCLPointCloud2 (*cloud, whole);
  pcl::FloaterReconstruction<TypeParam> floater;
  floater.setTopology (Topology::DISC);
  floater.setInputCloud (cloud);
  pcl::PolygonMesh mesh;
  floater.reconstruct (mesh);
  ASSERT_EQ (floater.getStatus (), RunStatus::SUCCESS);
  expectDisc (trianglesOf (mesh.polygons), 100, floater.getBoundaryLoop ().size ());
  EXPECT_EQ (mesh.cloud.data, whole.data);
}

TEST (FloaterClass, IndicesSelectAndPolygonsCountInTheWholeCloud)
{
  // Every third point is on the surface; the others are a heap beside it.
  const Cloud::Ptr surface = heightField ();
  const std::size_t n = surface->size ();
  RandomStream random (SEED);
  Cloud::Ptr cloud (new Cloud (static_cast<std::uint32_t> (3 * n), 1));
  for (pcl::PointXYZ& point : *cloud)
    for (float& coordinate : point.data)
      coordinate = static_cast<float> (random.uniform ());
  pcl::IndicesPtr indices (new pcl::Indices);
  for (std::size_t i = 0; i < n; ++i) {
    indices->push_back (static_cast<pcl::index_t> (3 * i));
    (*cloud)[3 * i] = (*surface)[i];
  }
  Floater floater;
  floater.setInputCloud (surface);
  Triangles expected;
  for (const auto& t : runWell (floater))
    expected.insert ({3 * t[0], 3 * t[1], 3 * t[2]});

  floater.setInputCloud (cloud);
  floater.setIndices (indices);
  Cloud points;
  Polygons polygons;
  floater.reconstruct (points, polygons);
  ASSERT_EQ (floater.getStatus (), RunStatus::SUCCESS);
  EXPECT_EQ (points.size (), cloud->size ());
  EXPECT_EQ (trianglesOf (polygons), expected);
  EXPECT_EQ (floater.getParameters ().size (), cloud->size ());
  EXPECT_TRUE (std::isnan (floater.getParameters ()[1].x ()));
  EXPECT_EQ (floater.getStatistics ().selected_points, n);

  // An index given again changes nothing.
  pcl::IndicesPtr repeated (new pcl::Indices (*indices));
  repeated->insert (repeated->end (), indices->begin (), indices->begin () + 50);
  floater.setIndices (repeated);
  EXPECT_EQ (runWell (floater), expected);
  EXPECT_EQ (floater.getStatistics ().selected_points, n);
  EXPECT_TRUE (floater.getDuplicates ().empty ());
  EXPECT_EQ (repeated->size (), n + 50);
}

TEST (FloaterClass, RefusesNoInputAndIndicesOutsideTheCloud)
{
  Floater floater;
  expectFailure (floater, RunStatus::NO_INPUT);
  EXPECT_EQ (floater.getSearchMethod (), nullptr);
  floater.setInputCloud (Cloud::Ptr (new Cloud));
  expectFailure (floater, RunStatus::NO_INPUT);
  floater.setInputCloud (heightField (100));
  for (const pcl::index_t outside : {100, -1, std::numeric_limits<pcl::index_t>::max ()}) {
    pcl::IndicesPtr indices (new pcl::Indices (50));
    std::iota (indices->begin (), indices->end (), 0);
    indices->push_back (outside);
    floater.setIndices (indices);
    expectFailure (floater, RunStatus::INVALID_INDICES);
    EXPECT_NE (floater.getMessage ().find (std::to_string (outside)), std::string::npos);
  }
  floater.setIndices (pcl::IndicesPtr (new pcl::Indices));
  expectFailure (floater, RunStatus::TOO_FEW_POINTS);
  floater.setIndices (pcl::IndicesPtr ());
  const Triangles disc = runWell (floater);
  expectDisc (disc, 100, floater.getBoundaryLoop ().size ());
  floater.setInputCloud (nullptr);
  expectFailure (floater, RunStatus::NO_INPUT);
  EXPECT_TRUE (floater.getBoundaryLoop ().empty ());
}

TEST (FloaterClass, TellsWhichPointsAreLeftOut)
{
  const Cloud::Ptr clean = heightField ();
  Floater floater;
  floater.setInputCloud (clean);
  const Triangles expected = runWell (floater);

  const auto n = static_cast<pcl::index_t> (clean->size ());
  const Cloud::Ptr cloud (new Cloud (*clean));
  cloud->push_back (pcl::PointXYZ (NOWHERE, 0.0F, 0.0F));
  cloud->push_back ((*clean)[17]);
  cloud->push_back (pcl::PointXYZ (0.0F, 0.0F, std::numeric_limits<float>::infinity ()));
  cloud->push_back ((*clean)[3]);
  cloud->is_dense = true; // and it is not
  pcl::Indices island;
  for (int i = 0; i < 36; ++i) {
    island.push_back (static_cast<pcl::index_t> (cloud->size ()));
    const int row = i / 6;
    cloud->push_back (
        pcl::PointXYZ (100.0F + static_cast<float> (i % 6), static_cast<float> (row), 50.0F));
  }
  floater.setInputCloud (cloud);
  EXPECT_EQ (runWell (floater), expected); // which expects the warnings on the console
  EXPECT_FALSE (floater.getReport ().warnings.empty ());
  EXPECT_EQ (floater.getUnusedIndices (), island);
  EXPECT_EQ (floater.getNonFiniteIndices (), (pcl::Indices{n, n + 2}));
  const std::vector<std::array<pcl::index_t, 2>> duplicates{{n + 1, 17}, {n + 3, 3}};
  EXPECT_EQ (floater.getDuplicates (), duplicates);
  EXPECT_TRUE (std::isnan (floater.getParameters ()[n].x ()));
  EXPECT_EQ (floater.getParameters ()[n + 1], floater.getParameters ()[17]);
}

TEST (FloaterClass, ServesOneCloudAfterAnother)
{
  const Cloud::Ptr large = heightField (700);
  const Cloud::Ptr small = makeCloud<pcl::PointXYZ> (SurfaceKind::HEMISPHERE, 300);
  const auto alone = [] (const Cloud::Ptr& cloud) {
    Floater floater;
    floater.setInputCloud (cloud);
    return runWell (floater);
  };
  Floater floater;
  const Cloud::Ptr line (new Cloud (10, 1, pcl::PointXYZ (1.0F, 2.0F, 3.0F)));
  for (const Cloud::Ptr& cloud : {large, small, line, large}) {
    floater.setInputCloud (cloud);
    if (cloud == line)
      expectFailure (floater, RunStatus::TOO_FEW_POINTS);
    else
      EXPECT_EQ (runWell (floater), alone (cloud));
  }
  // The results of a run are kept until the next run.
  const pcl::Indices loop = floater.getBoundaryLoop ();
  floater.setInputCloud (small);
  EXPECT_EQ (floater.getBoundaryLoop (), loop);
  // A cloud that shrinks in place.
  large->resize (650);
  floater.setInputCloud (large);
  EXPECT_EQ (runWell (floater), alone (large));
}

using Search = pcl::search::Search<pcl::PointXYZ>;

/// Counts its queries.
class CountingSearch : public pcl::search::KdTree<pcl::PointXYZ>
{
public:
  using pcl::search::KdTree<pcl::PointXYZ>::nearestKSearch;

  int nearestKSearch (const pcl::PointXYZ& point, int k, pcl::Indices& indices,
                      std::vector<float>& sqr_distances) const override
  {
    ++queries;
    return pcl::search::KdTree<pcl::PointXYZ>::nearestKSearch (point, k, indices, sqr_distances);
  }

  mutable std::size_t queries = 0;
};

TEST (FloaterClass, AsksTheUsersSearchMethod)
{
  const Cloud::Ptr cloud = heightField ();
  pcl::IndicesPtr indices (new pcl::Indices);
  for (pcl::index_t i = static_cast<pcl::index_t> (cloud->size ()) - 1; i >= 0; --i)
    if ((*cloud)[i].x < 18.0F)
      indices->push_back (i);
  ASSERT_GT (indices->size (), 300U);
  ASSERT_LT (indices->size (), cloud->size ());
  (*cloud)[indices->back ()].y = NOWHERE;

  Floater floater;
  floater.setInputCloud (cloud);
  floater.setIndices (indices);
  const Triangles expected = runWell (floater);
  EXPECT_EQ (floater.getSearchMethod (), nullptr);
  const pcl::shared_ptr<CountingSearch> counting (new CountingSearch);
  const std::vector<Search::Ptr> methods{Search::Ptr (new pcl::search::Octree<pcl::PointXYZ> (1.5)),
                                         Search::Ptr (new pcl::search::BruteForce<pcl::PointXYZ>),
                                         counting};
  for (const Search::Ptr& method : methods) {
    SCOPED_TRACE (method->getName ());
    method->setInputCloud (heightField (60)); // of an earlier use
    floater.setSearchMethod (method);
    EXPECT_EQ (runWell (floater), expected);
    EXPECT_EQ (floater.getSearchMethod (), method);
    EXPECT_EQ (method->getInputCloud (), cloud);
    ASSERT_NE (method->getIndices (), nullptr);
    EXPECT_EQ (method->getIndices ()->size (), indices->size () - 1); // not the point with a NaN
  }
  EXPECT_EQ (counting->queries, indices->size () - 1);
}

TEST (FloaterClass, CallsBackAndCanBeCancelled)
{
  std::vector<Stage> stages;
  double done = -1.0;
  Floater floater;
  floater.setInputCloud (heightField ());
  floater.setStageCallback ([&stages] (Stage stage) { stages.push_back (stage); });
  floater.setProgressCallback ([&done] (double fraction) { done = fraction; });
  ASSERT_TRUE (floater.getStageCallback () && floater.getProgressCallback ());
  runWell (floater);
  EXPECT_EQ (stages.size (), 9U);
  EXPECT_EQ (done, 1.0);

  floater.setCancelledCallback ([&done] { return done > 0.1; });
  ASSERT_TRUE (floater.getCancelledCallback ());
  done = 0.0;
  expectFailure (floater, RunStatus::CANCELLED);

  // That is no error: who wants to see errors only sees nothing.
  const auto printed = [&floater] {
    pcl::PolygonMesh mesh;
    testing::internal::CaptureStderr ();
    floater.reconstruct (mesh);
    return testing::internal::GetCapturedStderr ();
  };
  const pcl::console::VERBOSITY_LEVEL level = pcl::console::getVerbosityLevel ();
  pcl::console::setVerbosityLevel (pcl::console::L_ERROR);
  done = 0.0;
  EXPECT_EQ (printed (), "");
  EXPECT_EQ (floater.getStatus (), RunStatus::CANCELLED);
  floater.setKSearch (-1);
  EXPECT_NE (printed (), "");
  pcl::console::setVerbosityLevel (level);
}

TEST (FloaterClass, EightObjectsInEightThreads)
{
  const auto run = [] (std::size_t i) {
    constexpr SurfaceKind KINDS[] = {SurfaceKind::HEIGHT_FIELD, SurfaceKind::FINGER,
                                     SurfaceKind::TORUS, SurfaceKind::CUT_OUT};
    pcl::FloaterReconstruction<pcl::PointXYZ> floater;
    floater.setTopology (i % 4 < 2 ? Topology::DISC : Topology::AUTO);
    floater.setNumberOfThreads (static_cast<unsigned int> (1 + i / 4));
    floater.setInputCloud (makeCloud<pcl::PointXYZ> (KINDS[i % 4], 1500));
    Polygons polygons;
    floater.reconstruct (polygons);
    return trianglesOf (polygons);
  };
  std::array<Triangles, 8> expected;
  std::array<std::size_t, 8> right{};
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 8; ++t)
    expected[t] = run (t);
  for (std::size_t t = 0; t < 8; ++t)
    threads.emplace_back ([&, t] {
      for (int round = 0; round < 3; ++round)
        right[t] += !expected[t].empty () && run (t) == expected[t] ? 1 : 0;
    });
  for (std::thread& thread : threads)
    thread.join ();
  EXPECT_EQ (right, (std::array<std::size_t, 8>{3, 3, 3, 3, 3, 3, 3, 3}));
}

// Programs have the size of the class compiled into them: it must not grow with the options.
struct BaseAndPointer : pcl::SurfaceReconstruction<pcl::PointXYZ>
{
  std::unique_ptr<int> pointer;
};
static_assert (sizeof (pcl::FloaterReconstruction<pcl::PointXYZ>) == sizeof (BaseAndPointer),
               "the class has nothing but its base and a pointer");
static_assert (sizeof (ReconstructionState) == sizeof (void*), "the state is behind a pointer");
// Nor may anyone take the state for a whole object.
static_assert (!std::is_destructible_v<ReconstructionState> &&
                   !std::is_default_constructible_v<ReconstructionState>,
               "the state is a part of an object");

TEST (FloaterClass, ACopyHasOptionsAndResultsOfItsOwn)
{
  Floater floater;
  const Cloud::Ptr cloud = heightField ();
  floater.setInputCloud (cloud);
  floater.setKSearch (12);
  const Triangles expected = runWell (floater);

  Floater copy (floater);
  EXPECT_EQ (copy.getParameters (), floater.getParameters ());
  EXPECT_EQ (runWell (copy), expected);

  copy.setKSearch (5);
  expectFailure (copy, RunStatus::INVALID_OPTION);
  EXPECT_EQ (floater.getKSearch (), 12);
  EXPECT_EQ (floater.getStatus (), RunStatus::SUCCESS);

  copy = floater;
  const Floater& same = copy;
  copy = same; // to itself
  EXPECT_EQ (copy.getKSearch (), 12);
  EXPECT_EQ (copy.getStatus (), RunStatus::SUCCESS);

  // What is moved from may be used again.
  Floater moved (std::move (copy));
  EXPECT_EQ (moved.getKSearch (), 12);
  copy.setInputCloud (cloud); // NOLINT(bugprone-use-after-move)
  copy.setKSearch (14);
  runWell (copy);
  EXPECT_EQ (moved.getKSearch (), 12);
}

} // namespace
} // namespace pcl::floater

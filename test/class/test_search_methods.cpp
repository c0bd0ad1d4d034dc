// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Search methods that the user gives to FloaterReconstruction.
#include "mesh_check.h"

#include <pcl/search/brute_force.h>
#include <pcl/search/kdtree.h>
#include <pcl/search/octree.h>

#include <limits>
#include <stdexcept>

namespace pcl::floater {
namespace {
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

TEST_F (FloaterClass, AsksTheUsersSearchMethod)
{
  const Cloud::Ptr cloud = heightField ();
  pcl::IndicesPtr indices (new pcl::Indices);
  for (pcl::index_t i = static_cast<pcl::index_t> (cloud->size ()) - 1; i >= 0; --i)
    if ((*cloud)[i].x < 18.0F)
      indices->push_back (i);
  ASSERT_GT (indices->size (), 300U);
  ASSERT_LT (indices->size (), cloud->size ());
  (*cloud)[indices->back ()].y = std::numeric_limits<float>::quiet_NaN ();

  Floater floater;
  floater.setInputCloud (cloud);
  floater.setIndices (indices);
  const Triangles expected = runWell (floater);
  const pcl::shared_ptr<CountingSearch> counting (new CountingSearch);
  const std::vector<Search::Ptr> methods{Search::Ptr (new pcl::search::KdTree<pcl::PointXYZ>),
                                         Search::Ptr (new pcl::search::Octree<pcl::PointXYZ> (1.5)),
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

class ThrowingSearch : public pcl::search::KdTree<pcl::PointXYZ>
{
public:
  using pcl::search::KdTree<pcl::PointXYZ>::nearestKSearch;

  int nearestKSearch (const pcl::PointXYZ&, int, pcl::Indices&, std::vector<float>&) const override
  {
    throw std::runtime_error ("the disk is full");
  }
};

TEST_F (FloaterClass, LetsNoExceptionOut)
{
  Floater floater;
  floater.setInputCloud (heightField (100));
  floater.setSearchMethod (Search::Ptr (new ThrowingSearch));
  expectFailure (floater, RunStatus::INTERNAL_ERROR);
  EXPECT_NE (floater.getMessage ().find ("the disk is full"), std::string::npos);
  floater.setSearchMethod (nullptr);
  runWell (floater);
}

} // namespace
} // namespace pcl::floater

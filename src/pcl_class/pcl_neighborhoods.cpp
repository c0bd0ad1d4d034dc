// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pcl_class/pcl_neighborhoods.h"

#include <pcl/features/impl/normal_3d.hpp>
#include <pcl/features/normal_3d.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/impl/floater_reconstruction.hpp>

#include <limits>

namespace pcl::floater {
namespace {
constexpr float NAN_32 = std::numeric_limits<float>::quiet_NaN ();

// The whole cloud; points that are not selected are not finite.
pcl::PointCloud<pcl::PointXYZ>::Ptr
cloudOf (const Input& input)
{
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>> ();
  cloud->resize (input.cloud_size, pcl::PointXYZ (NAN_32, NAN_32, NAN_32));
  cloud->is_dense = false;
  for (std::size_t row = 0; row < input.positions.size (); ++row)
    (*cloud)[input.cloud_index[row]].getVector3fMap () = input.positions[row].cast<float> ();
  return cloud;
}

} // namespace

std::unique_ptr<NeighborSearch>
makePclSearch (const Input& input)
{
  return std::make_unique<SearchMethod<pcl::PointXYZ>> (
      pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>> (), cloudOf (input));
}

std::vector<Eigen::Vector3f>
estimateNormals (const Input& input, int k)
{
  const auto cloud = cloudOf (input);
  const auto finite = pcl::make_shared<pcl::Indices> ();
  for (std::size_t p = 0; p < cloud->size (); ++p)
    if (pcl::isFinite ((*cloud)[p]))
      finite->push_back (static_cast<pcl::index_t> (p));
  std::vector<Eigen::Vector3f> all (cloud->size (), Eigen::Vector3f::Constant (NAN_32));
  if (finite->empty ())
    return all;
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud (cloud);
  estimation.setIndices (finite);
  estimation.setSearchMethod (pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>> ());
  estimation.setKSearch (k + 1); // PCL counts the point itself
  pcl::PointCloud<pcl::Normal> estimated;
  estimation.compute (estimated);
  for (std::size_t i = 0; i < estimated.size (); ++i)
    all[static_cast<std::size_t> ((*finite)[i])] = estimated[i].getNormalVector3fMap ();
  return all;
}

} // namespace pcl::floater

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
struct PclNeighborhoods::Cloud
{
  explicit Cloud (const Input& input)
      : points (pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>> ()),
        finite (pcl::make_shared<pcl::Indices> ()),
        search (pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>> (), points)
  {
    constexpr float NONE = std::numeric_limits<float>::quiet_NaN ();
    points->resize (input.cloud_size, pcl::PointXYZ (NONE, NONE, NONE));
    points->is_dense = false;
    for (std::size_t row = 0; row < input.positions.size (); ++row) {
      const Eigen::Vector3f position = input.positions[row].cast<float> ();
      (*points)[input.cloud_index[row]] =
          pcl::PointXYZ (position.x (), position.y (), position.z ());
      if (position.allFinite ())
        finite->push_back (static_cast<pcl::index_t> (input.cloud_index[row]));
    }
  }

  pcl::PointCloud<pcl::PointXYZ>::Ptr points;
  pcl::IndicesPtr finite;
  SearchMethod<pcl::PointXYZ> search;
};

PclNeighborhoods::PclNeighborhoods (const Input& input) : cloud_ (std::make_unique<Cloud> (input))
{
}

PclNeighborhoods::~PclNeighborhoods () = default;

NeighborSearch&
PclNeighborhoods::search ()
{
  return cloud_->search;
}

std::vector<Eigen::Vector3f>
PclNeighborhoods::normals (int k) const
{
  constexpr float NONE = std::numeric_limits<float>::quiet_NaN ();
  std::vector<Eigen::Vector3f> all (cloud_->points->size (), Eigen::Vector3f::Constant (NONE));
  if (cloud_->finite->empty ())
    return all;
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud (cloud_->points);
  estimation.setIndices (cloud_->finite);
  estimation.setSearchMethod (pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>> ());
  estimation.setKSearch (k + 1); // PCL counts the point itself
  pcl::PointCloud<pcl::Normal> estimated;
  estimation.compute (estimated);
  for (std::size_t i = 0; i < estimated.size (); ++i)
    all[static_cast<std::size_t> ((*cloud_->finite)[i])] = estimated[i].getNormalVector3fMap ();
  return all;
}

} // namespace pcl::floater

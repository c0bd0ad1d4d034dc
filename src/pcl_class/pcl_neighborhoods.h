// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbours and tangent planes by PCL's own kd-tree and normal estimation.
#pragma once

#include <pcl/surface/floater/reconstruct.h>

#include <memory>

namespace pcl::floater {
/// pcl::search::KdTree as a search method for the core, and normals by pcl::NormalEstimation. The
/// core's own are faster and run on all threads; these are for the method of TW 385 as a user of
/// PCL would put it together.
class PclNeighborhoods
{
public:
  /// Copies the points, in single precision.
  explicit PclNeighborhoods (const Input& input);
  ~PclNeighborhoods ();
  PclNeighborhoods (const PclNeighborhoods&) = delete;
  PclNeighborhoods& operator= (const PclNeighborhoods&) = delete;

  NeighborSearch& search ();

  /// For each point of the whole cloud: the normal of the plane through it and its k nearest; not a
  /// number for points that are not selected or not finite.
  std::vector<Eigen::Vector3f> normals (int k) const;

private:
  struct Cloud;
  std::unique_ptr<Cloud> cloud_;
};

} // namespace pcl::floater

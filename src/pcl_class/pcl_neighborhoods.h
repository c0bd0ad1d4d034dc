// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbours and tangent planes by PCL's own kd-tree and normal estimation.
#pragma once

#include <pcl/surface/floater/reconstruct.h>

#include <memory>

namespace pcl::floater {
/// pcl::search::KdTree as a search method for the core, and normals by pcl::NormalEstimation. Used
/// for TW 385 as built from PCL. The core's own are faster and use all threads.
class PclNeighborhoods
{
public:
  /// Copies the points, in single precision.
  explicit PclNeighborhoods (const Input& input);
  ~PclNeighborhoods ();
  PclNeighborhoods (const PclNeighborhoods&) = delete;
  PclNeighborhoods& operator= (const PclNeighborhoods&) = delete;

  NeighborSearch& search ();

  /// For each point of the whole cloud: normal of the plane through it and its k nearest; NaN for
  /// points that are not selected or not finite.
  std::vector<Eigen::Vector3f> normals (int k) const;

private:
  struct Cloud;
  std::unique_ptr<Cloud> cloud_;
};

} // namespace pcl::floater

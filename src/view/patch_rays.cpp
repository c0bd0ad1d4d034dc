// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/patch_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl::floater {
PatchRays::PatchRays (const std::vector<Eigen::Vector3d>& positions, const RayPatch& patch,
                      const Viewpoint& viewpoint)
    : x_ (patch.size ()), y_ (patch.size ()), z_ (patch.size ()), sqr_distances_ (patch.size ())
{
  Eigen::Vector3d first = Eigen::Vector3d::Zero ();
  for (Eigen::Index i = 0; i < x_.size (); ++i) {
    const Index p = patch[static_cast<std::size_t> (i)];
    const Eigen::Vector3d direction = rayTo (positions[p], viewpoint).direction;
    if (i == 0)
      first = direction;
    const Eigen::Vector3f offset = (direction - first).cast<float> ();
    x_[i] = offset.x ();
    y_[i] = offset.y ();
    z_[i] = offset.z ();
  }
}

// Vectorized over whole arrays: first the least distance, then its index.
PatchRays::Neighbors
PatchRays::neighborsOf (std::size_t ray, bool with_across)
{
  constexpr float NONE_YET = std::numeric_limits<float>::infinity ();
  const auto own = static_cast<Eigen::Index> (ray);
  const float x = x_[own], y = y_[own], z = z_[own];
  Eigen::ArrayXf& sqr_distance = sqr_distances_;
  sqr_distance = (x_ - x).square () + (y_ - y).square () + (z_ - z).square ();
  sqr_distance[own] = NONE_YET;
  const float least = sqr_distance.minCoeff ();
  const auto nearest = static_cast<Eigen::Index> (
      std::find (sqr_distance.begin (), sqr_distance.end (), least) - sqr_distance.begin ());
  if (!(least < NONE_YET) || nearest == sqr_distance.size ())
    return {ray, ray, NONE_YET, NONE_YET, 0.0F};
  sqr_distance[nearest] = NONE_YET;
  Neighbors found{static_cast<std::size_t> (nearest), ray, std::sqrt (least),
                  std::sqrt (sqr_distance.minCoeff ()), 0.0F};
  if (!with_across)
    return found;
  const float along_x = x_[nearest] - x, along_y = y_[nearest] - y, along_z = z_[nearest] - z;
  const float half = 0.5F * least; // squared cosine of 45 degrees
  float least_across = NONE_YET;
  for (Eigen::Index i = 0; i < sqr_distance.size (); ++i) {
    if (!(sqr_distance[i] < least_across) || !(sqr_distance[i] > 0.0F))
      continue;
    const float part = (x_[i] - x) * along_x + (y_[i] - y) * along_y + (z_[i] - z) * along_z;
    if (part * part > half * sqr_distance[i])
      continue;
    least_across = sqr_distance[i];
    found.across = static_cast<std::size_t> (i);
  }
  if (found.across != ray)
    found.across_distance = std::sqrt (least_across);
  return found;
}

} // namespace pcl::floater

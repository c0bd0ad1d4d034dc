// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/patch_rays.h"

#include <cmath>
#include <limits>

namespace pcl
{
namespace floater
{
PatchRays::PatchRays (const std::vector<Eigen::Vector3d>& positions, const RayPatch& patch,
                      const Viewpoint& viewpoint)
    : sqr_distances_ (patch.size ())
{
  x_.reserve (patch.size ());
  y_.reserve (patch.size ());
  z_.reserve (patch.size ());
  Eigen::Vector3d first = Eigen::Vector3d::Zero ();
  for (const Index p : patch) {
    const Eigen::Vector3d direction = rayTo (positions[p], viewpoint).direction;
    if (x_.empty ())
      first = direction;
    const Eigen::Vector3f offset = (direction - first).cast<float> ();
    x_.push_back (offset.x ());
    y_.push_back (offset.y ());
    z_.push_back (offset.z ());
  }
}

// Plain loops over arrays of floats, which compilers turn into vector instructions.
PatchRays::Neighbors
PatchRays::neighborsOf (std::size_t ray, bool with_across)
{
  constexpr float NONE_YET = std::numeric_limits<float>::infinity ();
  const std::size_t size = x_.size ();
  const float x = x_[ray], y = y_[ray], z = z_[ray];
  float* const sqr_distance = sqr_distances_.data ();
  for (std::size_t i = 0; i < size; ++i) {
    const float dx = x_[i] - x, dy = y_[i] - y, dz = z_[i] - z;
    sqr_distance[i] = dx * dx + dy * dy + dz * dz;
  }
  sqr_distance[ray] = NONE_YET;
  Neighbors found{ray, ray, NONE_YET, NONE_YET, 0.0F};
  for (std::size_t i = 0; i < size; ++i) {
    if (sqr_distance[i] >= found.second_distance)
      continue;
    if (sqr_distance[i] < found.nearest_distance) {
      found.second_distance = found.nearest_distance;
      found.nearest_distance = sqr_distance[i];
      found.nearest = i;
    }
    else
      found.second_distance = sqr_distance[i];
  }
  if (with_across && found.nearest != ray) {
    const float along_x = x_[found.nearest] - x, along_y = y_[found.nearest] - y,
                along_z = z_[found.nearest] - z;
    const float half = 0.5F * found.nearest_distance; // squared cosine of 45 degrees
    for (std::size_t i = 0; i < size; ++i) {
      const float part = (x_[i] - x) * along_x + (y_[i] - y) * along_y + (z_[i] - z) * along_z;
      const bool is_across = part * part <= half * sqr_distance[i] && sqr_distance[i] > 0.0F;
      sqr_distance[i] = is_across ? sqr_distance[i] : NONE_YET;
    }
    sqr_distance[ray] = NONE_YET;
    float least = NONE_YET;
    for (std::size_t i = 0; i < size; ++i)
      if (sqr_distance[i] < least) {
        least = sqr_distance[i];
        found.across = i;
      }
    found.across_distance = found.across == ray ? 0.0F : std::sqrt (least);
  }
  found.nearest_distance = std::sqrt (found.nearest_distance);
  found.second_distance = std::sqrt (found.second_distance);
  return found;
}

} // namespace floater
} // namespace pcl

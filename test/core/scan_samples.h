// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Scans of a small scene: a floor, two walls, a ball, and a thin post before the walls.
#pragma once

#include "samples.h"

namespace pcl::floater::samples {
/// How a sensor spaces its rays.
enum class Raster
{
  CAMERA,   ///< pixels of a plane
  RINGS,    ///< cones around the upright, 6 times as far apart as the rays in each
  SPHERE,   ///< all angles alike, all around but the lowest 40 degrees
  PARALLEL, ///< parallel rays
  LINES     ///< parallel rays along lines, 5 times as far apart as the rays in each
};

struct Scan
{
  Positions points;
  std::vector<int> object;   ///< of each point: which surface was hit
  Eigen::Vector3d viewpoint; ///< of parallel rays, their direction
  bool is_far = false;
};

/// How depths are disturbed.
struct DepthNoise
{
  double share = 0.0;   ///< standard deviation, in depths
  double quantum = 0.0; ///< step of the inverse depth, as of a camera with two lenses
};

/// A scan of the scene, from a place and in a direction that hang on the seed. About 20,000 rays.
/// The frame is turned and moved at random, too.
Scan
scanScene (Raster raster, DepthNoise noise, std::uint64_t seed);

/// A scan by 32 rings of a yard of 80 by 80: sloping ground, posts, and balls that rest on it. The
/// sensor stands 1.2 to 2.6 above the ground, near the middle. About 40,000 points, not turned.
Scan
scanYard (DepthNoise noise, std::uint64_t seed);

} // namespace pcl::floater::samples

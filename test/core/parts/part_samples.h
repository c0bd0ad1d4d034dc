// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces, and what the stages before the parts find out about them.
#pragma once

#include "local/local_geometry.h"
#include "points/point_samples.h"

#include <vector>

namespace pcl::floater::samples {
struct Prepared
{
  Points points;
  LocalGeometry geometry;
};

inline Prepared
prepare (const Positions& positions)
{
  StarSettings settings;
  settings.reach_beyond = true;
  settings.with_offsets = false;
  Prepared prepared;
  prepared.points = makePoints (positions, indices (positions.size ()), 1);
  prepared.geometry = makeLocalGeometry (
      prepared.points,
      fitLocalPlanes (prepared.points, findNeighbors (prepared.points, {}, 1), {}, settings, 1),
      settings, 1);
  return prepared;
}

} // namespace pcl::floater::samples

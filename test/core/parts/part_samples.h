// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces, and what the stages before the parts find out about them.
#pragma once

#include "local/local_geometry.h"
#include "points/neighbors.h"
#include "points/points.h"
#include "samples.h"
#include "surfaces.h"

#include <vector>

namespace pcl::floater::samples {
inline Positions
surface (SurfaceKind kind, std::size_t points, double noise = 0.0)
{
  SurfaceSpec spec;
  spec.kind = kind;
  spec.points = points;
  spec.noise = noise;
  return generateSurface (spec);
}

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

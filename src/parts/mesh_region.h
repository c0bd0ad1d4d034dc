// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A submesh around some points.
#pragma once

#include "core/types.h"

#include <vector>

namespace pcl::floater {
/// Triangles of a mesh, and their corners, in the numbers of the mesh.
struct MeshRegion
{
  std::vector<Index> points;            ///< ascending
  std::vector<std::uint8_t> is_partial; ///< of each: some of its triangles are outside the region
  std::vector<Index> triangles;         ///< ascending
};

/// All triangles with a corner fewer than `rings` edges away from a seed, additional triangles, and
/// the seeds. O(rings n).
/// \param points number of points of the mesh
/// \param seeds points of the mesh; need not be vertices
/// \param besides of each triangle: 1 to include it anyway; empty: none
MeshRegion
regionAround (const std::vector<Triangle>& triangles, std::size_t points,
              const std::vector<Index>& seeds, std::size_t rings,
              const std::vector<std::uint8_t>& besides = {});

} // namespace pcl::floater

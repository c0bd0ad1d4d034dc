// SPDX-License-Identifier: GPL-3.0-or-later
// Nearest neighbours of a block's own points, and of the points around them that matter.
#pragma once

#include "blocks/point_block.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Neighbours of a block; rows are those of the block. The own points' stars and triangles are made
/// of nothing else.
struct BlockNeighbors
{
  FlatLists near;           ///< of all rows that are needed, nearest first; the others are empty
  std::vector<Index> found; ///< rows that have neighbours: planes are needed there
  std::vector<Index> stars; ///< rows whose stars are needed: own points, their neighbours, and the
                            ///< nearest of those, over which crease normals are taken
  std::vector<Index> corners; ///< rows that may be corners of the triangles: own points and their
                              ///< neighbours
  std::vector<Ball> missing;  ///< if not empty, where points outside the block may be nearer
};

/// O(m log m) for m points of the block. \param k below the number of points of the cloud
BlockNeighbors
findBlockNeighbors (const PointBlock& block, std::size_t k, int threads);

} // namespace floater
} // namespace pcl

// SPDX-License-Identifier: GPL-3.0-or-later
// What can be told of a block of points without the rest of the cloud.
#pragma once

#include "blocks/point_block.h"
#include "complex/candidate_triangles.h"

#include <pcl/surface/floater/options.h>

#include <vector>

namespace pcl
{
namespace floater
{
/// Of every own point of a block, in order. Indices are those of the working set.
struct BlockSurface
{
  std::vector<Index> near;              ///< nearest points, nearest first, k of each
  std::vector<float> spacing;           ///< see localSpacing
  std::vector<Eigen::Vector3f> normals; ///< of the stars, of arbitrary sign
  std::vector<Eigen::Vector3f> crease;  ///< by which the candidates are judged, see creaseNormals

  /// Triangles whose smallest point is the block's own: those that only wait for the orientation
  /// of the whole, and those, at rims, creases and where stars do not agree, that are chosen when
  /// all blocks are there.
  CandidateLists candidates;

  /// Not empty if the halo is too narrow, and nothing else told: the block is to be cut again with
  /// these balls, too.
  std::vector<Ball> missing;
};

/// Nearest neighbours, planes, stars and triangles of a block. Stars of neighbours are made where
/// triangles ask for them, so that the result is that of the whole cloud, to the last bit, whatever
/// the blocks are; whether the halo is wide enough is not assumed but checked. O(points of the
/// block) but for the kd-tree. \param k below the number of points of the cloud
BlockSurface
makeBlockSurface (const PointBlock& block, int k, bool filter_sheets, int threads);

/// The same from given neighbours, for a block that is the whole cloud.
BlockSurface
makeWholeSurface (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
                  bool filter_sheets, int threads);

} // namespace floater
} // namespace pcl

// SPDX-License-Identifier: GPL-3.0-or-later
// Boundary loops of the complex: borders and holes of the surface, or mere defects.
#pragma once

#include "triangulation/surface_mesh.h"

#include <pcl/surface/floater/options.h>

#include <vector>

namespace pcl
{
namespace floater
{
/// A boundary loop with what tells whether the surface ends there.
struct Rim
{
  std::vector<Index> points; ///< in order, the surface on the left
  Index piece;               ///< of the mesh (see findPieces)
  double length;             ///< in the unit of the positions
  double width;              ///< largest distance between two of its points, same unit
  double spacing;            ///< mean local spacing of its points, same unit
  double open_share;  ///< of its points: those with no neighbour on their sheet in a sector of 130
                      ///< degrees or more
  double empty_share; ///< of its points: those with no neighbour on any sheet in such a sector
  bool stays = false; ///< as a boundary of the surface
};

/// All rims of a mesh, in the order of boundaryLoops ().
/// \param pieces of each triangle
std::vector<Rim>
findRims (const SurfaceMesh& mesh, const std::vector<Index>& pieces,
          const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
          const std::vector<Eigen::Vector3f>& normals, const std::vector<float>& spacing);

/// Decides which rims stay. The automatic policy keeps a rim where four in five points see an empty
/// sector and which is at least 6 of its own steps wide, or long for the size of its piece; one of
/// 4 steps where all points do; and a very long one where half of them do. A gap in the sampling is
/// narrower, and where the complex has a defect there are points on the other side. The policies
/// that count or keep the largest go by the length of the rim along which points see an empty
/// sector. \param unit length of one unit of the cloud in the unit of the positions
void
chooseRims (std::vector<Rim>& rims, const std::vector<std::size_t>& piece_points,
            const Options& options, double unit);

} // namespace floater
} // namespace pcl

// SPDX-License-Identifier: GPL-3.0-or-later
// Delaunay neighbourhoods in the tangent planes (TW 385, section 4.1).
#pragma once

#include "common/types.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// Which of the neighbours are in a star.
enum class StarKind
{
  DELAUNAY, ///< those of the centre in the Delaunay triangulation of its tangent plane
  ALL       ///< all, in anti-clockwise order; several may lie in one direction
};

/// Stars of all points. With the sheet filter, a neighbour on another sheet of the surface is left
/// out, in tiers:
///  1. drop a neighbour whose direction leaves either point's plane by more than 49 degrees (sine
///     0.75) or whose normal is more than 72 degrees away (cosine 0.3);
///  2. where that opens the star, the same in the plane of the mean normal of the 8 nearest points,
///     if that star is closed: on a sharp edge both faces are seen in it;
///  3. else drop only neighbours that leave both planes;
///  4. where that star is open too, take that of all neighbours if it is closed.
/// A star open in all tiers is that of tier 1. O(n k log k).
/// \param normals of each point; the stars' normals are these but for stars of tier 2
Stars
makeStars (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near,
           const std::vector<Eigen::Vector3f>& normals, bool filter_sheets, int threads,
           StarKind kind = StarKind::DELAUNAY);

/// Delaunay stars of some points only: the others' are empty, and their normals zero. Without
/// offsets in the plane, which take 16 bytes per entry.
Stars
makeStarsOf (const Selection& rows, const std::vector<Eigen::Vector3d>& positions,
             const FlatLists& near, const std::vector<Eigen::Vector3f>& normals, bool filter_sheets,
             int threads);

/// Distance scale of the sampling around each point: mean distance of its 6 nearest neighbours.
std::vector<float>
localSpacing (const std::vector<Eigen::Vector3d>& positions, const FlatLists& near, int threads);

/// The same of some points; 0 for the others.
std::vector<float>
localSpacing (const Selection& rows, const std::vector<Eigen::Vector3d>& positions,
              const FlatLists& near, int threads);

} // namespace floater
} // namespace pcl

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Delaunay neighbourhoods in the tangent planes (TW 385, section 4.1).
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "local/sheet.h"
#include "local/star_reach.h"

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

struct StarSettings
{
  bool filter_sheets = true; ///< leave out neighbours on another sheet of the surface
  StarKind kind = StarKind::DELAUNAY;
  bool reach_beyond = false; ///< see StarReach; for makeLocalGeometry
  ReachLimits reach{};
  bool with_offsets = true; ///< keep the neighbours' places in the plane: 16 bytes per entry
  SheetLimits limits{};
};

/// What stars need to reach beyond the neighbours that are given.
struct BeyondNeighbors
{
  const KdTree& tree;                ///< of the positions
  const std::vector<float>& spacing; ///< see localSpacing
  const BesideLines& beside;         ///< its neighbours are at the ends of the rows that are given
  ReachLimits limits{};
};

/// Stars of the points in their tangent planes: neighbours joined to the centre. They are in
/// anti-clockwise order seen along the normal. In an open star the sector from the last neighbour
/// to the first has no triangle. Normals are unit vectors of arbitrary sign, so that stars of
/// neighbours may run opposite ways round.
struct Stars
{
  CsrLists neighbors;
  std::vector<Eigen::Vector2d> offsets_in_plane; ///< parallel to neighbors.ids: place in the plane
                                                 ///< relative to the centre, length as in space
  std::vector<std::uint8_t> open;                ///< 1 if the star does not surround its centre
  std::vector<Eigen::Vector3f> normals;
  CsrLists far_neighbors; ///< of each point: those that were looked at for its star; see makeStars
  std::vector<float> reach; ///< the largest of a star and those around, see reachOf; empty if
                            ///< none was to reach farther
};

/// Stars of all points. With the sheet filter, a neighbour on another sheet of the surface is left
/// out, in tiers:
///  1. drop a neighbour whose direction leaves either point's plane by more than 49 degrees (sine
///     0.75) or whose normal is more than 72 degrees away (cosine 0.3);
///  2. where that opens the star, the same in the plane of the mean normal of the 8 nearest points,
///     if that star is closed: on a sharp edge both faces are seen in it;
///  3. else drop only neighbours that leave both planes;
///  4. where that star is open too, take that of all neighbours if it is closed.
/// A star that is open in all tiers is that of tier 1.
///
/// Stars may reach beyond the neighbours (see StarReach). Far neighbours to which the step is too
/// long for the reach of both ends lie across a hole, and are left out again. O(n k log k).
/// \param normals of each point; the stars' normals are these but for stars of tier 2
/// \param beyond  nullptr: stars are made of the neighbours alone
Stars
makeStars (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
           const std::vector<Eigen::Vector3f>& normals, const StarSettings& settings,
           const RunContext& run, const BeyondNeighbors* beyond = nullptr);

/// Stars of some points only; those of the i-th of them are in row i. Far neighbours across a hole
/// are not left out.
Stars
makeStarsOf (const std::vector<Index>& centres, const std::vector<Eigen::Vector3d>& positions,
             const CsrLists& neighbors, const std::vector<Eigen::Vector3f>& normals,
             const StarSettings& settings, const RunContext& run,
             const BeyondNeighbors* beyond = nullptr);

} // namespace floater
} // namespace pcl

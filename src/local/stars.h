// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Delaunay neighbourhoods in the tangent planes (TW 385, section 4.1).
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "local/sheet.h"
#include "local/star_reach.h"
#include "points/rows.h"

#include <vector>

namespace pcl::floater {
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

/// The lists of some stars, not yet packed.
struct StarRange;
struct StarsInMaking
{
  StarsInMaking ();
  ~StarsInMaking ();
  StarsInMaking (const StarsInMaking&) = delete;
  StarsInMaking& operator= (const StarsInMaking&) = delete;
  StarsInMaking (StarsInMaking&&) noexcept;
  StarsInMaking& operator= (StarsInMaking&&) = delete;

  Stars stars; ///< without the lists; `offsets` has the length of each row instead
  std::vector<StarRange> ranges;
};

/// makeStars in steps, for stars of a part of a cloud: all arrays have a place for each of its
/// points, of which those in `rows` are read and written. The first step looks at the points around
/// with their normals, which must be in the part. Its reach is that of the star alone.
StarsInMaking
beginStars (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
            const std::vector<Eigen::Vector3f>& normals, const Rows& rows,
            const StarSettings& settings, const RunContext& run, const BeyondNeighbors* beyond);

/// The state after the first step of stars whose lists have been packed by endStars.
StarsInMaking
resumeStars (Stars stars, const Rows& rows);

/// The second step: the reach becomes the largest around; then far neighbours across holes are left
/// out.
/// \param neighbors of the points in `rows` and of their far neighbours
/// \param made      the first step; the reach also of those neighbours
void
leaveOutAcrossHoles (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                     const std::vector<Eigen::Vector3f>& normals, const Rows& rows,
                     const StarSettings& settings, double gap_ratio, StarsInMaking& made,
                     const RunContext& run);

/// Packs the lists.
Stars
endStars (StarsInMaking made, const Rows& rows, const StarSettings& settings);

/// Stars of some points only; those of the i-th of them are in row i. Far neighbours across a hole
/// are not left out.
Stars
makeStarsOf (const std::vector<Index>& centres, const std::vector<Eigen::Vector3d>& positions,
             const CsrLists& neighbors, const std::vector<Eigen::Vector3f>& normals,
             const StarSettings& settings, const RunContext& run,
             const BeyondNeighbors* beyond = nullptr);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Delaunay neighbourhoods in the tangent planes (TW 385, section 4.1).
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "local/star_reach.h"
#include "points/neighbors.h"

namespace pcl::floater {
struct StarSettings
{
  bool filter_sheets = true; ///< leave out neighbours on another sheet of the surface
  bool with_all =
      false; ///< all neighbours, of which several may lie in one direction; not only those
             ///< of the centre in the Delaunay triangulation of its tangent plane
  bool reach_beyond = false;  ///< see StarReach; for makeLocalGeometry
  bool with_offsets = true;   ///< keep offsets_in_plane: 16 bytes per entry; not for finishStars
  bool planes_of_all = false; ///< tangent planes use all neighbours (TW 385, section 4.1)
};

/// Stars of the points in their tangent planes: the neighbours connected to the centre,
/// anti-clockwise seen along the normal. In an open star there is no triangle from the last
/// neighbour to the first. Normals are unit vectors of arbitrary sign, so stars of neighbours may
/// have opposite orientations.
struct Stars
{
  CsrLists neighbors;
  std::vector<Vector2d> offsets_in_plane; ///< parallel to neighbors.ids: offset from the
                                          ///< centre in the plane, with the length in space
  Flags open;                             ///< 1 if the star does not surround its centre
  Normals normals;
  CsrLists far_neighbors;   ///< of each point: far neighbours tested for its star; see finishStars
  std::vector<float> reach; ///< maximum reach of a star and those around, see reachOf; empty if no
                            ///< star was to reach farther
};

/// Mean of the normals of a point and its 8 nearest neighbours, unit length, on the side of its
/// own. At a sharp edge the least-squares plane follows one of the faces; the mean lies between
/// them.
Vector3d
meanNormal (const Positions& positions, const CsrLists& neighbors, const Normals& normals, Index p);

/// Stars of some points. The sheet filter removes neighbours on another sheet of the surface, in
/// tiers:
/// 1. remove a neighbour whose direction leaves either point's plane by more than 49 degrees
///   (sine 0.75) or whose normal is more than 72 degrees away (cosine 0.3);
/// 2. if this opens the star, do so in the plane of the mean normal of the 8 nearest points, if
///   that star is closed: on a sharp edge it contains both faces;
/// 3. otherwise remove only neighbours that leave both planes;
/// 4. if this star is open too, use all neighbours if their star is closed.
/// If the star is open in all tiers, tier 1 is used.
///
/// O(n k log k).
/// \param normals of each point; stars of tier 2 replace theirs
/// \param rows    points whose stars are made; arrays have an entry for every point. The normals of
///                the points around are read
/// \param beyond  the planes, for stars that may reach beyond the neighbours (see StarReach), which
///                finishStars () completes
Stars
makeStars (const Positions& positions, const CsrLists& neighbors, const Normals& normals,
           const Rows& rows, const StarSettings& settings, const RunContext& run,
           const LocalPlanes* beyond = nullptr);

/// Second step of stars beyond the neighbours, for all of them: sets each reach to the maximum
/// around, then removes far neighbours across a hole again: those too far for the reach of both
/// ends.
/// \param[in,out] stars results of makeStars ()
void
finishStars (const Positions& positions, const LocalPlanes& planes, const StarSettings& settings,
             const RunContext& run, Stars& stars);

/// Whether test (q, r) is true for a triangle of the star of p with q and r, anti-clockwise. The first
/// such triangle is the last one tested. O(neighbours in the star).
template <typename Test>
bool
anyTriangle (const Stars& stars, Index p, Test&& test)
{
  const Row row = stars.neighbors.row (p);
  for (std::size_t i = 0; i + stars.open[p] < row.size (); ++i)
    if (test (row[i], row[i + 1 < row.size () ? i + 1 : 0]))
      return true;
  return false;
}

/// Whether the star of p has a triangle with q and r, in either order. O(neighbours in the star).
inline bool
hasTriangle (const Stars& stars, Index p, Index q, Index r)
{
  return anyTriangle (
      stars, p, [q, r] (Index a, Index b) { return (a == q && b == r) || (a == r && b == q); });
}

/// Share of the neighbours in each point's star that have the point in theirs; 0 without
/// neighbours. It is 1 for the Delaunay triangulation of a smooth, densely sampled surface, also on
/// ambiguous lattices. O(entries of the stars).
std::vector<float>
starAgreement (const Stars& stars, const RunContext& run);

} // namespace pcl::floater

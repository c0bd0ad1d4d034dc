// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The surface through a place where one tangent plane does not describe it: as the border between
// two sides of space.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "core/types.h"

namespace pcl::floater {
/// A place whose triangles are made anew, and the triangles around it that stay. Points are
/// numbered from 0 in the place.
struct Place
{
  Positions positions;
  Flags is_free;               ///< of each point: all its triangles are made anew
  Flags is_rim;                ///< of each point: not free, but beside triangles that go
  Flags is_boundary;           ///< of each point: on a boundary that stays
  Flags is_whole;              ///< of each point: all its triangles are in the place
  std::vector<Triangle> frame; ///< triangles that stay, none with a free corner
  std::vector<Index> patch_of; ///< of each triangle of the frame: its patch. The triangles of
                               ///< a patch face one side, those of two patches may not
  Index patches = 0;
};

/// The triangles of a place made anew.
struct RemadePlace
{
  std::vector<Triangle> triangles; ///< each with a free corner
  Flags is_turned;                 ///< of each patch: its back is the front of `triangles`
  std::size_t flawed = 0; ///< free points at which the balls tell no two sides. No triangles,
                          ///< if they are noise (see isNoise)
  bool is_right = false;  ///< the new triangles are one fan around each free point
};

constexpr std::size_t LARGE_PLACE = 2048; ///< points

/// Whether points are noise, by the number of the flawed ones of them. Generated bodies with thin
/// walls and sharp edges had at most one in 25, noisy scans one in 8 to 14, or in large places 24.
inline bool
isNoise (std::size_t flawed, std::size_t points)
{
  constexpr std::size_t SHARE = 16, SHARE_OF_LARGE = 24, FEW = 16;
  return flawed > FEW && flawed * (points < LARGE_PLACE ? SHARE : SHARE_OF_LARGE) > points;
}

/// Makes the triangles of a place from the Delaunay triangulation of its points in space.
///
/// Around each point there are two sides of the surface. Two tetrahedra with a common facet are on
/// one side if their circumscribed balls overlap deeply and are of like size. With r the radius of
/// the facet's circle, and x and y the angles under which it sees the two centres above its plane,
/// the overlap is (1 + cos (x - y)) (1 - |cos x - cos y|): the first factor measures the angle
/// between the balls, the second compares their curvatures with that of the circle (compare
/// Kolluri, Shewchuk, O'Brien 2004). Facets are taken by falling overlap; the tetrahedra of each
/// come to the same side, unless a free point would then have one side only, or a triangle of the
/// frame the same side before and behind it; otherwise they are on opposite sides. The surface is
/// between the sides. O(n log n) in practice; one thread.
/// \param only_counts sets RemadePlace::flawed, but makes no triangles
RemadePlace
remakePlace (const Place& place, const RunContext& run, bool only_counts = false);

/// Whether points are on a surface, however near its sheets are to each other: at hardly any of them the
/// balls tell no two sides. Four parts of at most 2,048 points are looked at, each in some 0.1 seconds.
/// \param points ascending, of `positions`; those that are near in this order are near in space
bool
areOnTwoSides (const Positions& positions, const std::vector<Index>& points,
               const CsrLists& neighbors, const RunContext& run);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Where a mesh is wrong because several sheets of the surface are near.
#pragma once

#include "local/local_geometry.h"
#include "mesh/self_intersections.h"
#include "mesh/triangle_mesh.h"

namespace pcl::floater {
/// Points; a loop of no more is no opening.
constexpr std::size_t SMALL_LOOP = 5;

/// How much of a boundary loop is a gap that is closed, where only parts of it are beside another sheet.
enum class GapParts : std::uint8_t
{
  WHOLE_LOOP,  ///< all of it, if a third is
  LONG_PARTS,  ///< parts with long runs of boundary between them
  SHORT_PARTS, ///< parts with runs of boundary between them, longer than a pinhole's loop
};

/// Free points, whose triangles are to be made anew.
struct DisturbedZones
{
  CsrLists points;           ///< of each zone, ascending. Two zones share no triangle
                             ///< corner, and no point of one is a neighbour of another
  Flags is_free;             ///< of each point; empty if there is no zone
  bool may_be_parts = false; ///< some loops look like gaps only in part
  Flags is_boundary;         ///< of each point: on a boundary that stays; not free
  Flags was_boundary;        ///< of each point: on any boundary
};

/// Finds what is wrong: triangles that cross, points without a triangle, and boundary loops that
/// are gaps between sheets, at least in part. What is disturbed around belongs to it: corners of folded
/// triangles, and of bent ones that are no Delaunay facets in space; so do `rings` of triangles around.
/// O(n).
/// \param crossing  all crossing pairs of the mesh
/// \param rings     width of a zone around what is disturbed
/// \param gaps      what of a loop is a gap
/// \param closes_gaps false: no boundary loop counts as a gap
/// \param is_settled  of each point: nothing there counts as wrong; or empty
DisturbedZones
findDisturbedZones (const TriangleMesh& mesh, const Positions& positions,
                    const LocalGeometry& geometry, const std::vector<CrossingPair>& crossing,
                    int rings, GapParts gaps, bool closes_gaps, const Flags& is_settled,
                    const RunContext& run);

} // namespace pcl::floater

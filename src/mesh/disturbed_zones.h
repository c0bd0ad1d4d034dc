// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Where a mesh is wrong because several sheets of the surface are near.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "mesh/self_intersections.h"
#include "mesh/triangle_mesh.h"

namespace pcl::floater {
/// Limits of findDisturbedZones (). Lengths are in local spacings. Chosen on generated bodies with
/// sharp edges, thin walls and contacts, and on clouds with true openings.
struct DisturbanceLimits
{
  double beside = 2.5;          ///< distance up to which two pieces of boundary are side by side
  double same_sheet = 0.87;     ///< cosine between their normals, 30 degrees; below, they belong to
                                ///< two sheets
  double gap_share = 1.0 / 3.0; ///< share of the points of a loop that are beside another sheet,
                                ///< from which on it is a gap. True boundaries had up to 0.15, gaps
                                ///< at edges of bodies 0.6 and more
  double touching = 1.0;        ///< distance of pieces of boundary that the sampling does not show:
                                ///< there they are a gap, also if the loop is open elsewhere,
                                ///< and if they belong to one sheet
  bool closes_gaps = true;      ///< false: no boundary loop counts as a gap
  std::size_t small_loop = 5;   ///< points; a loop of no more is no opening
  std::size_t long_run = 32; ///< points of a loop in a row that are no gap and separate two. Along
                             ///< folds of sheets up to 12 in a row were not touching, on their true
                             ///< boundary 48 and more. On one sheet, pieces of a loop are as
                             ///< far apart along it, times their distance
};

/// Free points, whose triangles are to be made anew.
struct DisturbedZones
{
  CsrLists points;           ///< of each zone, ascending. Two zones share no triangle
                             ///< corner, and no point of one is a neighbour of another
  Flags is_free;             ///< of each point; empty if there is no zone
  bool may_be_parts = false; ///< some loops look like gaps only in part
  Flags is_boundary;         ///< of each point: on a boundary that stays; not free
};

/// Finds what is wrong: triangles that cross, points without a triangle, and boundary loops that
/// are gaps between sheets, at least in part. What is disturbed around belongs to it: corners of folded triangles, and
/// of bent ones that are no Delaunay facets in space; so do `rings` of triangles around. O(1) for a
/// mesh where nothing is wrong, apart from its boundary; otherwise O(n).
/// \param crossing  all crossing pairs of the mesh
/// \param neighbors of each point, nearest first
/// \param spacing   of each point (see localSpacing)
/// \param rings     width of a zone around what is disturbed
/// \param whole_loops whether a loop that is a gap in part counts as one all along
DisturbedZones
findDisturbedZones (const TriangleMesh& mesh, const Positions& positions, const CsrLists& neighbors,
                    const std::vector<float>& spacing, const std::vector<CrossingPair>& crossing,
                    int rings, bool whole_loops, const DisturbanceLimits& limits,
                    const RunContext& run);

} // namespace pcl::floater

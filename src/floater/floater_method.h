// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The method of TW 385: one disc, laid out in the plane.
#pragma once

#include "core/problem.h"
#include "core/run_context.h"
#include "floater/boundary/boundary.h"
#include "floater/solvers/solver.h"
#include "local/stars.h"
#include "mesh/finish.h"

#include <pcl/surface/floater/options.h>

namespace pcl::floater {
/// Per point: 1 if a path along directed neighbours leads from it to the loop. Others take no part in
/// the linear system: for unconnected unknowns, UMFPACK may return OK and put them all on the origin.
/// A reverse breadth-first search, O(entries).
Flags
reachLoop (const CsrLists& neighbors, const std::vector<Index>& loop, const RunContext& run);

/// Parameters of the boundary loop (TW 385, section 2.1): lays it on a convex curve in the unit circle, anti-clockwise. Steps along the circle,
/// or along the sides of a polygon, are proportional to the lengths of the loop's steps, to the square roots of these, or equal (LoopSpacing).
/// The first point of the loop is at angle 0 of the circle, or at the left end of the bottom side of a regular polygon.
///
/// Each corner of a regular polygon gets the loop point that is nearest along the loop, a different
/// one for each, so that no corner is cut off. A loop with fewer points than corners gets a polygon
/// with fewer corners.
///
/// The result is strictly convex, in floating point too, for loops of up to a million points. For
/// this, the sides of polygons bulge with a thousandth of the circle's curvature (by 2.5e-4 in the
/// middle of a square's side), and steps are widened to 4e-6, or to half of the mean step of their
/// side if that is less. On a straight side, an interior point whose neighbours are all on it would
/// fall on it. O(loop).
/// \return parameters, parallel to the loop
std::vector<Vector2d>
layLoop (const Positions& positions, const std::vector<Index>& loop, const DomainOptions& options);

/// The mesh of a disc, or why there is none.
struct Disc
{
  Boundary boundary;
  SystemStatistics figures; ///< of the linear system
  std::vector<Vector2d> uv; ///< per point: parameters; NaN if it is not connected with the loop;
                            ///< empty if there are none
  TriangleMesh mesh;
  MeshFinish finish;
  Problem problem;
};

/// Makes the mesh of a disc from its boundary loop (TW 385, sections 2 and 4). Beyond TW 385:
/// edges are flipped in space, and folds are repaired. Stages WEIGHTS, SOLVE, DELAUNAY and FLIPS.
///
/// On a tube of length L and radius R parameters shrink like exp (-L / R). From an L / R of about 35
/// on, points coincide in the plane; from some 50 on, folds are left.
/// \param geometry its stars, which need their offsets, are consumed, except their normals
/// \param boundary checked (see checkBoundary ())
/// \param options  with as_published: nothing beyond TW 385
/// \param finish   what else it does is chosen here
/// \return with the problem of the boundary; UNREACHABLE if it is not connected with most points; that of the
///     solver; or NOT_A_DISC if too many edges are folded
Disc
makeDisc (const Points& points, LocalGeometry& geometry, Boundary boundary, const Options& options,
          FinishSettings finish, const RunContext& run);

} // namespace pcl::floater

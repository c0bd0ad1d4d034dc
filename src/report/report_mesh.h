// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the stages made of the cloud, as the user reads it: cloud indices, counts, warnings in
// words.
#pragma once

#include "consensus/consensus_method.h"
#include "core/problem.h"
#include "core/types.h"
#include "floater/floater_method.h"
#include "mesh/check.h"
#include "mesh/finish.h"
#include "mesh/trimming.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl::floater {
/// The boundary, figures of the system, and the parameter of every cloud point: of equal points all
/// have the same. Triangles are anti-clockwise in the plane, also where the disc was turned round.
/// Warnings on linked points, and where the loop takes a long step.
void
reportDisc (const Points& points, const Disc& disc, Report& report);

/// A warning if a surface was cut open since it seems one-sided.
/// \param seam triangles left out for that
void
reportOrientationSeam (const Points& points, const std::vector<Triangle>& seam, Report& report);

/// How many holes were filled, the decisions that are not sure, and a warning on loops that stay
/// open since they are too deep to be filled.
void
reportLoops (const Points& points, const Surface& surface, Report& report);

/// How sure it is which side of each part of the mesh is its front, and by which rule. Warnings
/// where that is a guess, and where what was to decide did not.
void
reportFacing (const Points& points, const MeshFacing& facing, Facing wanted, Report& report);

/// Counts of triangles and flips.
void
reportTriangles (std::size_t triangles, const MeshFinish& finish, Report& report);

/// Triangles of points as triangles of cloud indices.
std::vector<Triangle>
inCloud (const Points& points, std::vector<Triangle> triangles);

/// What checkMesh () found: its figures, in a few words if they are why no disc was made, points
/// that are in no triangle, but for those that the report lists as outliers, the longest loop if
/// there is none yet, and warnings with places: on unused points, folds, long edges, triangles
/// without area, components of a few points, and small holes that no option asked for.
/// \return INTERNAL_ERROR if the mesh is no oriented manifold
Problem
reportCheck (const Points& points, const MeshExamination& found, const Options& options,
             Report& report);

/// Counts of what was cut off, and points that lost all their triangles. There is no warning: it
/// was asked for. After reportCheck ().
/// \return DEGENERATE if no triangle is left
Problem
reportTrimming (const Points& points, const Trimming& trimming, const TrimmingOptions& options,
                std::size_t triangles_left, Report& report);

} // namespace pcl::floater

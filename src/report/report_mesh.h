// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reports on the mesh for the user: cloud indices, counts, warnings.
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
/// Reports boundary, figures of the system, and the parameter of every cloud point (equal points
/// share it). Triangles are anti-clockwise in the plane, also if the disc was turned over. Warns of
/// linked points, and of a long edge in the loop.
void
reportDisc (const Points& points, const Disc& disc, Report& report);

/// Reports filled holes and uncertain decisions. Warns of loops that stay open because they are too
/// deep to fill, and if the surface was cut open because it seems one-sided.
void
reportLoops (const Points& points, const Surface& surface, Report& report);

/// Reports rule and confidence of the front of each part of the mesh. Warns of guesses, and where
/// the requested rule did not decide.
void
reportFacing (const Points& points, const MeshFacing& facing, Facing wanted, Report& report);

/// Reports the result of checkMesh (): figures, the reason if no disc was made, points in no
/// triangle (except those listed as outliers), and the longest loop if there is none yet. Warns,
/// with positions, of unused points, folds, long edges, triangles without area, components of a few
/// points, and small holes that no option asked for.
/// \return INTERNAL_ERROR unless the mesh is an oriented manifold
Problem
reportCheck (const Points& points, const MeshExamination& found, const Options& options,
             Report& report);

/// Reports what was trimmed, and points that lost all their triangles. Does not warn: it was
/// requested. Call it after reportCheck ().
/// \return DEGENERATE if no triangle is left
Problem
reportTrimming (const Points& points, const Trimming& trimming, const TrimmingOptions& options,
                std::size_t triangles_left, Report& report);

} // namespace pcl::floater

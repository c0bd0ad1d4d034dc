// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reports on the mesh for the user: cloud indices, counts, warnings; and how good it is.
#pragma once

#include "consensus/consensus_method.h"
#include "core/problem.h"
#include "floater/floater_method.h"
#include "mesh/check.h"
#include "mesh/finish.h"
#include "mesh/trimming.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl::floater {
/// Reports boundary, figures of the system, and the parameter of every cloud point (equal points
/// share it). Triangles are anti-clockwise in the plane. Warns of a long edge in the loop.
void
reportDisc (const Points& points, const Disc& disc, Report& report);

/// Reports filled holes and uncertain decisions. Warns of loops that stay open because they are too
/// deep to fill, and if the surface was cut open because it seems one-sided.
void
reportLoops (const Points& points, const Surface& surface, Report& report);

/// Reports the finished mesh: its examination, what was trimmed, points in no triangle, and which rule
/// turned each part, with what confidence. Warns of flaws, unasked holes, and guesses.
/// \return INTERNAL_ERROR unless it is an oriented manifold; DEGENERATE if trimming left no triangle
Problem
reportMesh (const Points& points, const std::vector<Triangle>& triangles,
            const MeshExamination& found, const MeshFinish& finish, const Trimming& trimming,
            const Options& options, Report& report);

/// Judges a finished mesh. The cause is that of the measure which is farthest beyond its bound.
/// \param report of a successful run, complete but for its verdict
Verdict
judge (const Report& report);

/// Share of the total area that the largest 1 % of the triangles have; 0 if there is no area, or if
/// there are fewer than 100 triangles, of which one may rightly have a large share. O(n).
double
largestAreaShare (const std::vector<Triangle>& triangles, const Positions& positions);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The end of each method: checks the mesh, removes self-intersections, trims, and reports.
#pragma once

#include "local/local_geometry.h"
#include "mesh/check.h"
#include "mesh/finish.h"
#include "mesh/trimming.h"
#include "options/stage_limits.h"
#include "points/points.h"

#include <pcl/surface/floater/reconstruct.h>

#include <optional>

namespace pcl::floater {
/// Examines the finished mesh on the input points, independently of earlier stages.
MeshExamination
examine (const TriangleMesh& mesh, const Points& points, const LocalGeometry& geometry,
         const Request& request);

/// Adds the points that were set aside to the mesh, unless the point that stands for them is not in
/// it; extends the geometry but for the neighbours, and what was made anew.
/// \return all points
Points
addStacked (TriangleMesh& mesh, const Points& points, LocalGeometry& geometry, MeshFinish& finish,
            const Request& request);

/// Repairs the flaws of a mesh with the points that were set aside; the neighbours go.
/// \param points         without these points
/// \param all            as addStacked () returned it
/// \param[in,out] finish gets the crossing pairs, and the repairs
void
repairSplits (TriangleMesh& mesh, const Points& points, const Points& all, LocalGeometry& geometry,
              const Request& request, MeshFinish& finish);

/// Makes the result of a mesh, and reports it. The end of every way.
/// \return INTERNAL_ERROR unless it is an oriented manifold; DEGENERATE if no triangle is left
Problem
useMesh (TriangleMesh mesh, const MeshFinish& finish, MeshExamination found, const Points& points,
         const LocalGeometry& geometry, const Request& request, Result& result);

} // namespace pcl::floater

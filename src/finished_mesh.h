// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The end of every way: the mesh is checked, triangles that cross each other are moved apart, what
// is asked for is cut off, and the rest is reported.
#pragma once

#include "local/local_geometry.h"
#include "mesh/check.h"
#include "mesh/finish.h"
#include "options/request.h"
#include "points/points.h"

#include <pcl/surface/floater/reconstruct.h>

#include <functional>

namespace pcl::floater {
/// Examines the finished mesh on the input points, independently of earlier stages.
MeshExamination
examine (const TriangleMesh& mesh, const Points& points, const LocalGeometry& geometry,
         const Request& request);

/// Whether triangles that cross each other are moved apart. Not where points lie off the surface by
/// noise, so that they were projected to connect them: the true triangles cross each other there,
/// too.
bool
removesCrossings (const Points& points, const Options& options);

/// Finds triangles that cross each other. Where there are any, changes the mesh and examines it
/// again.
/// \param complete called before neighbours and normals of the geometry are read; may be empty
void
uncross (TriangleMesh& mesh, MeshExamination& found, const Points& points, LocalGeometry& geometry,
         const Request& request, Statistics& statistics,
         const std::function<void ()>& complete = {});

/// Makes the result of a mesh.
/// \return INTERNAL_ERROR if it is no oriented manifold, DEGENERATE if it is empty, or
/// nothing is left of it
Problem
useMesh (TriangleMesh mesh, const MeshFinish& finish, MeshExamination found, const Points& points,
         const LocalGeometry& geometry, const Request& request, Result& result);

/// The same of a mesh whose triangles are elsewhere; nothing is cut off.
/// \param triangles number of them
Problem
reportFinished (std::size_t triangles, const MeshFinish& finish, const MeshExamination& found,
                const Points& points, const Request& request, Report& report);

} // namespace pcl::floater

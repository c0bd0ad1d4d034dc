// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The report of the tool on a run, as a page to look at, and the mesh as that draws it.
#pragma once

#include "run_report.h"

#include <pcl/surface/floater/reconstruct.h>

#include <string>

namespace pcl::floater {
/// The report as one page of HTML that refers to nothing outside: outcome, figures, histograms,
/// findings and uncertain decisions with their places, and the mesh, drawn by WebGL. All that
/// depends on the run is in one JSON text, which holds the report of reportJson () without its lists
/// of points. Meshes of more than CommandLine::shown_triangles are thinned, but for triangles with
/// flaws. O(n log n); takes 200 bytes per point, and the text up to 24 MB.
/// \param cloud  the cloud, from which points without finite coordinates may have been removed
/// \param result its triangles are indices into the cloud; none: the points are shown
std::string
htmlReport (const CommandLine& line, const Cloud& cloud, const Result& result,
            const RunFigures& run);

} // namespace pcl::floater

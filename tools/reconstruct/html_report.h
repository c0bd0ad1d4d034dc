// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The report of the tool on a run, as a page to look at, and the mesh as that draws it.
#pragma once

#include "core/types.h"
#include "run_report.h"

#include <Eigen/Geometry>
#include <pcl/surface/floater/reconstruct.h>

#include <string>
#include <vector>

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

/// Triangles of one kind of flaw.
struct Flaw
{
  const char* name;
  std::vector<Index> triangles; // ascending
};

/// The mesh as it is drawn: only its vertices, around the origin, in a unit that float can square.
struct Drawing
{
  Eigen::Vector3d centre = Eigen::Vector3d::Zero (); // of the cloud, where the origin is
  double unit = 1.0;                                 // in units of the cloud; a power of two
  std::vector<Eigen::Vector3d> positions;
  Triangles triangles;
  std::vector<float> spacing; // of each vertex; empty if there is no mesh
  std::vector<float> height;  // of each vertex above those around, in spacings
  std::vector<Flaw> flaws;
  double median_spacing = 0.0;
  bool has_all_flaws = true;
};

/// The box around positions; empty if there are none.
Eigen::AlignedBox3d
boxAround (const std::vector<Eigen::Vector3d>& positions);

/// The mesh of a run, thinned if it has more triangles than the page shows; without triangles after
/// a failure. Spacing, heights and flaws are those of the whole mesh. O(n log n).
Drawing
makeDrawing (const CommandLine& line, const Cloud& cloud, const Result& result);

} // namespace pcl::floater

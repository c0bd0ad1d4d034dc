// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// How good a mesh is, by what a run has found out.
#pragma once

#include "core/types.h"

#include <pcl/surface/floater/report.h>

namespace pcl::floater {
/// Up to which share a mesh is good, and from which on it is poor.
struct VerdictBounds
{
  double good;
  double poor;
};

/// Right meshes of generated bodies have no crossing pair; with noise of half a spacing, most thin
/// and sharp ones have one in 20 triangles. Of 37 generated scans without enough area, or of many
/// parts or folds, 30 leave 2 % of the view open or 0.2 % of the points out; 32 of 123 other scans
/// do so as well. The other bounds are chosen by hand.
struct VerdictLimits
{
  VerdictBounds crossing = {0.0001, 0.05}; ///< crossing pairs for each triangle
  VerdictBounds folds = {0.05, 2.0};       ///< folds for each triangle of a view; never poor by
                                           ///< itself. True meshes of noisy depth cameras: 0.015
  VerdictBounds open = {0.02, 2.0};        ///< share of the triangles of a view that are left open
  VerdictBounds area = {0.25, 0.5}; ///< share of the area in the largest 1 % of the triangles:
                                    ///< 2 % if even, 4 % with noise
  /// The same of a view: 14 % in rooms. Of 64 wrong scans 10 were good without this, and 2 are with it.
  VerdictBounds area_of_view = {0.25, 2.0};
  VerdictBounds unused = {0.002, 0.1};      ///< share of the points without a triangle
  VerdictBounds scatter = {0.05, 0.6};      ///< share of the points on no surface
  VerdictBounds outliers = {0.002, 0.5};    ///< share of the points off any surface
  VerdictBounds noise = {0.1, 2.0};         ///< share of points projected; never poor by itself
  VerdictBounds long_edges = {0.002, 0.05}; ///< long edges for each triangle
  double coarse_step = 0.2; ///< step of the coordinates, in local spacings, that explains flaws
  double many = 0.02;       ///< share of stacked, noisy or scattered points that explains flaws
};

/// Judges a finished mesh. The cause is that of the measure which is farthest beyond its bound.
/// \param report of a successful run, complete but for its verdict
Verdict
judge (const Report& report, const VerdictLimits& limits = {});

/// Share of the total area that the largest 1 % of the triangles have; 0 if there is no area, or if
/// there are fewer than 100 triangles, of which one may rightly have a large share. O(n).
double
largestAreaShare (const std::vector<std::array<std::uint32_t, 3>>& triangles,
                  const Positions& positions);

} // namespace pcl::floater

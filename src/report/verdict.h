// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// How good a mesh is, by what a run has found out.
#pragma once

#include "core/types.h"

#include <pcl/surface/floater/report.h>

namespace pcl::floater {
/// Judges a finished mesh. The cause is that of the measure which is farthest beyond its bound.
/// \param report of a successful run, complete but for its verdict
Verdict
judge (const Report& report);

/// Share of the total area that the largest 1 % of the triangles have; 0 if there is no area, or if
/// there are fewer than 100 triangles, of which one may rightly have a large share. O(n).
double
largestAreaShare (const std::vector<std::array<std::uint32_t, 3>>& triangles,
                  const Positions& positions);

} // namespace pcl::floater

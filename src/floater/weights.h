// SPDX-License-Identifier: GPL-3.0-or-later
// Weights of the points in their neighbours.
#pragma once

#include "core/run_context.h"
#include "local/stars.h"

#include <pcl/surface/floater/options.h>

#include <vector>

namespace pcl
{
namespace floater
{
/// Smallest weight of a row relative to its largest. A weight lost in rounding would cut the graph.
constexpr double SMALLEST_WEIGHT = 1e-10;

/// Weights lambda_ij > 0, parallel to stars.neighbors.ids, that sum to 1 in each row.
///
/// Mean value (TW 385, equations (2) and (3)) and shape preserving (Floater 1997, section 6)
/// weights of a closed star reproduce their centre: sum lambda_ij offset_ij = 0. In an open star (a
/// boundary point that is not on the loop, or a gap in the sampling) the empty sector gives no term
/// to mean value weights, so that they stay positive; shape preserving weights fall back to mean
/// value there. Several neighbours in one direction, as stars of all neighbours have them, get
/// equal mean value weights times length. Stars without extent get uniform weights. O(entries), no
/// allocation per point, the same for every number of threads.
std::vector<double>
computeWeights (const Stars& stars, Weighting weighting, const RunContext& run);

} // namespace floater
} // namespace pcl

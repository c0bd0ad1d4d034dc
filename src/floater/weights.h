// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Weights of each point in its neighbours (TW 385, section 4.1).
#pragma once

#include "core/run_context.h"
#include "local/stars.h"

#include <pcl/surface/floater/options.h>

#include <vector>

namespace pcl::floater {
/// Smallest weight of a row relative to its largest. Far below any weight that matters, and far
/// above rounding: a weight that is lost in rounding would cut the graph.
constexpr double SMALLEST_WEIGHT = 1e-10;

/// Weights lambda_ij > 0 that sum to 1 in each row.
///
/// In a closed star, mean value weights (Floater 2003; TW 385, equations (2) and (3)) and shape
/// preserving weights (Floater 1997, section 6) reproduce the centre: the offsets times their
/// weights sum to 0. In an open star (of a boundary point that is not on the loop, or at a gap in
/// the sampling) mean value weights get no term from the sector without a triangle, so that they
/// stay positive, and mean value weights stand in for shape preserving ones. Several neighbours in
/// one direction, as stars of all neighbours have them, get equal mean value weights but for the
/// division by their distances. A star without extent gets uniform weights. O(entries); the same
/// for every number of threads.
/// \param stars with their offsets
/// \return parallel to stars.neighbors.ids
std::vector<double>
computeWeights (const Stars& stars, Weighting weighting, const RunContext& run);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Weights of the neighbours of each point (TW 385, section 4.1).
#pragma once

#include "core/run_context.h"
#include "local/stars.h"

#include <pcl/surface/floater/options.h>

namespace pcl::floater {
/// Smallest weight of a row relative to its largest. Far below any relevant weight, and far above
/// rounding: a zero weight would cut the graph.
constexpr double SMALLEST_WEIGHT = 1e-10;

/// Weights lambda_ij > 0 that sum to 1 in each row.
///
/// In a closed star, mean value weights (Floater 2003; TW 385, equations (2) and (3)) and shape
/// preserving weights (Floater 1997, section 6) reproduce the centre: the offsets times their
/// weights sum to 0. In an open star (of a boundary point that is not on the loop, or at a gap in
/// the sampling) mean value weights omit the sector without a triangle, which keeps them positive,
/// and also replace shape preserving ones. Several neighbours in one direction, as in stars of all
/// neighbours, get equal mean value weights before the division by their distances. A star without
/// extent gets uniform weights. O(entries); the result does not depend on the number of threads.
/// \param stars with their offsets
/// \return parallel to stars.neighbors.ids
std::vector<double>
computeWeights (const Stars& stars, Weighting weighting, const RunContext& run);

} // namespace pcl::floater

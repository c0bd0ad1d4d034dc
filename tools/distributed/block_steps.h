// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is found out about the points of one block, from the points around it and from what the
// blocks around it have found out in the steps before. Each step writes one file. The results do
// not depend on the blocks.
#pragma once

#include "options/stage_limits.h"
#include "store.h"

namespace pcl::floater {
/// The steps that are done for each block, in order. A step starts when the one before is complete
/// for all blocks. Run chooseOutliersStep () between the first two.
constexpr std::array<const char*, 3> BLOCK_STEPS{"neighbors", "planes", "stars"};

/// All that a step needs.
struct StepContext
{
  Store& store;
  const Plan& plan;
  const Options& options; ///< effective
  const Limits& limits;   ///< effective
  const RunContext& run;
};

/// The nearest neighbours, and which points lie apart from all surfaces.
void
neighborsStep (const StepContext& context, std::size_t block);

/// Of all points at once: which of those that lie apart are outliers. Without these the points are
/// written anew, if there are any.
void
chooseOutliersStep (const StepContext& context);

/// Spacing and tangent planes.
void
planesStep (const StepContext& context, std::size_t block);

/// Delaunay stars, each by itself (see beginStars).
void
starsStep (const StepContext& context, std::size_t block);

/// Does one of BLOCK_STEPS.
void
blockStep (const StepContext& context, const std::string& step, std::size_t block);

/// Outliers that the second step has chosen, ascending.
std::vector<Index>
readOutliers (const StepContext& context);

/// The blocks of so many points.
BlockRanges
blockRanges (const Plan& plan, std::size_t points);

/// The name of the file of the points without outliers.
const char*
pointsLeft (const std::vector<Index>& outliers);

/// Writes a working set and what is needed to cut it.
/// \param name POINTS or POINTS_LEFT
/// \param gross_outliers cloud indices
void
writePoints (Store& store, const std::string& name, std::uint64_t plan, const Points& points,
             const std::vector<Index>& gross_outliers, const RunContext& run);

/// Reads it.
/// \param[out] gross_outliers cloud indices
Points
readPoints (Store& store, const std::string& name, const Plan& plan,
            std::vector<Index>& gross_outliers);

} // namespace pcl::floater

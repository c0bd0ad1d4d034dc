// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is found out about the points of one block, from the points around it and from what the
// blocks around it have found out in the steps before. Each step writes one file. The results do
// not depend on the blocks.
#pragma once

#include "command_line.h"
#include "core/run_context.h"
#include "options/stage_limits.h"
#include "points/points.h"
#include "store.h"

namespace pcl::floater {
/// All that a step needs.
struct StepContext
{
  /// \param store, plan must outlive this
  StepContext (Store& files, const Plan& of, const CommandLine& line, const RunContext& context);

  Store& store;
  const Plan& plan;
  Options options; ///< effective
  Limits limits;   ///< effective
  RunContext run;
};

/// The nearest neighbours.
void
neighborsStep (const StepContext& context, std::size_t block);

/// Of all points at once: the outliers. Without these the points are written anew, if there are any.
void
outliersStep (const StepContext& context);

/// Spacing and tangent planes.
void
planesStep (const StepContext& context, std::size_t block);

/// Delaunay stars, each by itself (see beginStars).
void
starsStep (const StepContext& context, std::size_t block);

/// What a step is for: each block, or the whole cloud.
enum class StepKind
{
  PLAN,
  OF_BLOCK,
  FIND_OUTLIERS,
  JOIN,
  WRITE
};

/// A step of a run.
struct Step
{
  const char* name;
  StepKind kind;
  void (*of_block) (const StepContext&, std::size_t block); ///< nullptr: it is for the whole cloud
  const char* file; ///< which tells that it is finished; nullptr: nothing does, or see blockFile
};

/// All steps, in order. Each starts when the one before is complete for all blocks.
inline constexpr std::array<Step, 7> STEPS{
    {{"plan", StepKind::PLAN, nullptr, MANIFEST},
     {"neighbors", StepKind::OF_BLOCK, neighborsStep, nullptr},
     {"outliers", StepKind::FIND_OUTLIERS, nullptr, OUTLIERS},
     {"planes", StepKind::OF_BLOCK, planesStep, nullptr},
     {"stars", StepKind::OF_BLOCK, starsStep, nullptr},
     {"join", StepKind::JOIN, nullptr, TRIANGLES},
     {"write", StepKind::WRITE, nullptr, nullptr}}};

/// The step of this name; nullptr if there is none.
const Step*
findStep (const std::string& name);

/// Outliers that the second step has chosen, ascending.
std::vector<Index>
readOutliers (const StepContext& context);

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

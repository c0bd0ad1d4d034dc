// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is found out about the points of one block, from the points around it and from what the
// blocks around it have found out in the steps before. Each step writes one file. The results do
// not depend on the blocks.
#pragma once

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

/// Spacing and tangent planes.
void
planesStep (const StepContext& context, std::size_t block);

/// Delaunay stars, each by itself (see makeStars).
void
starsStep (const StepContext& context, std::size_t block);

struct Job;

// The steps of the whole cloud return EXIT_OK, or the exit code of what is wrong, which has been printed.

/// The outliers. Without these the points are written anew, if there are any.
int
outliersStep (const Job& job, FolderStore& store, const Plan& plan);

/// Puts together what the blocks have found out.
int
joinStep (const Job& job, FolderStore& store, const Plan& plan);

/// Writes the mesh, or its tiles: of several input files one for each, of one file one for each
/// block.
int
writeStep (const Job& job, FolderStore& store, const Plan& plan);

/// A step of a run. Of `plan`, which makes the plan that the others need, both functions are nullptr.
struct Step
{
  const char* name;
  void (*of_block) (const StepContext&, std::size_t block); ///< for each block
  int (*of_all) (const Job&, FolderStore&, const Plan&);    ///< for the whole cloud
  const char* file; ///< which tells that it is finished; nullptr: nothing does, or see blockFile

  bool isPlan () const { return of_block == nullptr && of_all == nullptr; }
};

/// All steps, in order. Each starts when the one before is complete for all blocks.
inline constexpr std::array<Step, 7> STEPS{{{"plan", nullptr, nullptr, MANIFEST},
                                            {"neighbors", neighborsStep, nullptr, nullptr},
                                            {"outliers", nullptr, outliersStep, OUTLIERS},
                                            {"planes", planesStep, nullptr, nullptr},
                                            {"stars", starsStep, nullptr, nullptr},
                                            {"join", nullptr, joinStep, TRIANGLES},
                                            {"write", nullptr, writeStep, nullptr}}};

/// The step of this name; nullptr if there is none.
const Step*
findStep (const std::string& name);

/// Outliers that the second step has chosen, ascending.
std::vector<Index>
readOutliers (const StepContext& context);

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

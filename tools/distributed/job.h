// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is asked for, and the steps of a run. Those of a block find out about its points, from the
// points around it and from what the blocks around it have found out in the steps before. Each
// writes one file. The results do not depend on the blocks.
#pragma once

#include "core/run_context.h"
#include "options/check_options.h"
#include "options/stage_limits.h"
#include "points/points.h"
#include "store.h"

namespace pcl::floater {
struct Step;

/// What the user asked for.
struct Job
{
  CommandLine line; ///< options of the reconstruction, and OUTPUT
  std::vector<std::filesystem::path> inputs;
  std::vector<std::string> arguments; ///< as they were typed
  std::filesystem::path work;
  const Step* step = nullptr; ///< nullptr: all
  std::size_t block = 0;      ///< of the step
  bool has_block = false;     ///< it was given
  std::size_t blocks = 0;     ///< 0: chosen by the number of points
  int join_threads = 0;       ///< 0: all cores
  bool writes_tiles = false;  ///< OUTPUT is a folder
  bool frees_disk = false;    ///< files of blocks go when the mesh is known
  bool prints_steps = false;
  bool is_from_manifest = false; ///< files and options are those of the manifest
};

/// All that a step needs. What it refers to must outlive it.
struct StepContext
{
  const Store& store;
  const Plan& plan;
  const CommandLine& line;
  RunContext run;
  Options options = effectiveOptions (line.options);
  Limits limits{};
};

using BlockStep = void (const StepContext& context, std::size_t block);

BlockStep neighborsStep; ///< the nearest neighbours
BlockStep planesStep;    ///< spacing and tangent planes
BlockStep starsStep;     ///< Delaunay stars, each by itself (see makeStars)

/// \return EXIT_OK, or the exit code of what is wrong, which has been printed
using CloudStep = int (const Job& job, const Store& store, const Plan& plan);

CloudStep outliersStep; ///< without these, if there are any, the points are written anew
CloudStep joinStep;     ///< puts together what the blocks have found out
CloudStep writeStep;    ///< the mesh, or its tiles: one for each input file, or each block of one

/// A step of a run. Of `plan`, which makes the plan that the others need, both functions are nullptr.
struct Step
{
  const char* name;
  BlockStep* of_block; ///< for each block
  CloudStep* of_all;   ///< for the whole cloud
  const char* file;    ///< which tells that it is finished; nullptr: nothing does, or see blockFile

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

/// Reads the cloud, sorts its points along the curve and writes them and the manifest.
/// \return EXIT_OK, or the exit code of what is wrong with the cloud, which has been printed
int
planStep (const Job& job, const Store& store);

/// Compares a plan with the parameters of the job and with all bytes of its files.
/// \throws WorkError if they are others
void
requirePlan (const Job& job, const Store& store, const Plan& plan);

} // namespace pcl::floater

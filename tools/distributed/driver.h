// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Runs all steps, on one or more processes of MPI.
#pragma once

#include "job.h"

namespace pcl::floater {
/// Does all steps that are not finished. Called by every process of MPI_COMM_WORLD with the same
/// job. Process 0 does the steps of the whole cloud, deals out blocks, and works on some itself;
/// without MPI, it does all.
/// \return the exit code of all processes
int
runAll (const Job& job, FolderStore& folder);

/// Does one step.
int
runStep (Job job, FolderStore& folder, const std::string& step);

/// Prints the commands of all steps, one in each line; steps between two empty lines may run at the
/// same time.
void
printSteps (const Job& job, FolderStore& folder);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The finished mesh in the work folder. Of a cloud in parts, most of it is where the parts are.
#pragma once

#include "cloud.h"
#include "part_steps.h"

#include <optional>

namespace pcl::floater {
/// A mesh as `join` leaves it.
struct FinishedMesh
{
  Triangles triangles;              ///< with cloud indices as corners; empty if it is in parts
  std::optional<MeshOfParts> parts; ///< with cloud indices as corners of its seam
  bool is_single = true;            ///< its coordinates are written as 32-bit floats
  bool are_blocks_freed = false;    ///< the files of the blocks have been removed
};

/// Writes it. With its file, the step is finished.
void
putMesh (FolderStore& folder, const Plan& plan, const FinishedMesh& mesh);

/// Whether all of it is there.
/// \throws WorkError if a file is damaged
bool
isMeshKnown (const StepContext& context, FolderStore& folder);

/// Whether it is there, and the files of the blocks have been removed.
bool
areBlocksFreed (FolderStore& folder, const Plan& plan);

/// Reads all of it; `parts` is empty.
FinishedMesh
readMesh (const StepContext& context);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is written of a part.
#pragma once

#include "consensus/candidates.h"
#include "parts/part_finish.h"
#include "parts/part_mesh.h"
#include "store.h"

#include <vector>

namespace pcl::floater {
// All that is added must outlive the writer.

void
addRim (const PartRim& rim, ArrayWriter& writer);

PartRim
readRim (ArrayFile& file);

void
addFinished (const FinishedPart& part, ArrayWriter& writer);

/// Without the inner triangles and their buckets.
FinishedPart
readFinished (ArrayFile& file);

void
addChanges (const std::vector<PartChange>& changes, ArrayWriter& writer);

PartChange
readChange (ArrayFile& file, std::size_t part);

/// Lists of marks, one behind the other.
void
addMarks (const std::string& name, const std::vector<std::vector<std::uint8_t>>& lists,
          ArrayWriter& writer);

std::vector<std::vector<std::uint8_t>>
readMarks (ArrayFile& file, const std::string& name);

void
addCandidates (const CandidateLists& candidates, ArrayWriter& writer);

/// Appends those whose first corner is from `first` to before `last`.
void
appendCandidates (ArrayFile& file, Index first, Index last, CandidateLists& all);

} // namespace pcl::floater

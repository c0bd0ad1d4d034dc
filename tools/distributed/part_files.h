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
/// The points of a part, and of how many all parts are: limits of the indices in its files.
struct PartOfPoints
{
  Index first, last; ///< one past the last
  std::size_t all;
};

// All that is added must outlive the writer. What is read is refused if indices are beyond their
// limits, or arrays do not fit each other.

void
addRim (const PartRim& rim, ArrayWriter& writer);

PartRim
readRim (ArrayFile& file, const PartOfPoints& part);

void
addFinished (const FinishedPart& part, ArrayWriter& writer);

/// Without the inner triangles and their buckets.
FinishedPart
readFinished (ArrayFile& file, const PartOfPoints& of);

void
addChanges (const std::vector<PartChange>& changes, ArrayWriter& writer);

PartChange
readChange (ArrayFile& file, std::size_t part, const PartOfPoints& of);

/// Lists of marks, one behind the other.
void
addMarks (const std::string& name, const std::vector<std::vector<std::uint8_t>>& lists,
          ArrayWriter& writer);

std::vector<std::vector<std::uint8_t>>
readMarks (ArrayFile& file, const std::string& name);

void
addCandidates (const CandidateLists& candidates, ArrayWriter& writer);

/// Appends those whose first corner is from `first` to before `last`; all corners are below a limit.
void
appendCandidates (ArrayFile& file, Index first, Index last, std::size_t limit, CandidateLists& all);

} // namespace pcl::floater

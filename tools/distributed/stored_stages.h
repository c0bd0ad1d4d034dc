// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the blocks have found out, as reconstruct () takes it.
#pragma once

#include "block_steps.h"
#include "known_stages.h"

#include <vector>

namespace pcl::floater {
/// Reads the files of all blocks, each when it is needed.
class StoredStages : public KnownStages
{
public:
  /// \param context must outlive this
  /// \param freed   where the files of a step are removed when all of it that is needed has been
  ///                read; nullptr: they stay
  explicit StoredStages (const StepContext& context, const FolderStore* freed = nullptr);

  Points points (Report& report) override;
  std::vector<Index> outliers () override { return outliers_; }
  LocalPlanes planes () override;
  std::vector<AreaSample> areaSamples () override;
  Stars begunStars () override;

private:
  // Calls visit (file of a step, block) for all blocks.
  template <typename Visit>
  void forEachBlock (const char* step, Visit&& visit);

  void remove (const char* step) const;

  const StepContext& context_;
  const FolderStore* freed_;
  std::vector<Index> outliers_;
  BlockRanges ranges_;  // without outliers
  std::size_t own_ = 0; // points of the block that is visited
};

} // namespace pcl::floater

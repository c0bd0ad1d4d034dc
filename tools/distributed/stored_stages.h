// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the blocks have found out, as reconstruct () takes it.
#pragma once

#include "block_steps.h"
#include "known_stages.h"
#include "stored_cloud.h"

#include <vector>

namespace pcl::floater {
/// Reads the files of all blocks, each when it is needed.
class StoredStages : public KnownStages
{
public:
  /// \param context must outlive this
  explicit StoredStages (const StepContext& context);

  Points points (Report& report) override;
  std::vector<Index> outliers () override { return outliers_; }
  LocalPlanes planes () override;
  std::vector<AreaSample> areaSamples () override;
  Stars begunStars () override;

private:
  Slices slices (const char* step) const;
  std::vector<Index> allPoints () const
  {
    return pointsFrom (0, static_cast<Index> (ranges_.points ()));
  }

  const StepContext& context_;
  std::vector<Index> outliers_;
  BlockRanges ranges_; // without outliers
};

} // namespace pcl::floater

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
  CsrLists neighborsOf (const std::vector<Index>& points) override;
  LocalPlanes planes () override;
  std::vector<AreaSample> areaSamples () override;
  NoiseProbes noiseProbes () override;
  LocalGeometry geometry (LocalPlanes planes, bool with_stars) override;
  std::vector<float> spacing () override;
  std::vector<Eigen::Vector3f> normals () override;
  PartSource parts (const Parts& parts) override;
  ProposedTriangles triangles () override
  {
    return proposed (0, static_cast<Index> (ranges_.points ()));
  }

private:
  ArrayFile file (const char* step, std::size_t block) const;
  Slices slices (const char* step) const;
  std::vector<Index> allPoints () const
  {
    return pointsFrom (0, static_cast<Index> (ranges_.points ()));
  }

  // The candidates whose first corner is in a range, and the smoothed normals of its points.
  ProposedTriangles proposed (Index first, Index last) const;

  const StepContext& context_;
  std::vector<Index> outliers_;
  BlockRanges ranges_; // without outliers
};

} // namespace pcl::floater

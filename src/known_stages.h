// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Stage results that were computed before, by other processes, each for a block of the points.
#pragma once

#include "local/local_geometry.h"
#include "options/stage_limits.h"
#include "points/points.h"
#include "view/ray_evidence.h"

#include <pcl/surface/floater/reconstruct.h>

#include <vector>

namespace pcl::floater {
/// Stage results that were computed before. They must equal what reconstruct () would compute; then
/// the mesh is the same. The functions are called in the order of a run.
class KnownStages
{
public:
  virtual ~KnownStages () = default;

  /// The points of takePoints (), which also fills the report.
  virtual Points points (Report& report) = 0;

  /// Points that lie off any surface, ascending.
  virtual std::vector<Index> outliers () = 0;

  /// Planes of all points without outliers, without tree and neighbours beside lines.
  virtual LocalPlanes planes () = 0;

  /// See takeAreaSamples.
  virtual std::vector<AreaSample> areaSamples () = 0;

  /// See beginStars.
  virtual Stars begunStars () = 0;
};

/// Reconstructs a surface from known stages.
/// \param input without points; the rest as usual
Result
reconstruct (Input input, const Options& options, const Limits& limits, KnownStages& known);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Entry point of the core with other limits than the default, or with stages that are known.
#pragma once

#include "local/local_geometry.h"
#include "options/stage_limits.h"
#include "points/points.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl::floater {
/// Stage results that were computed before. They must equal what reconstruct () would compute; then
/// the mesh is the same. The functions are called in the order of a run.
class KnownStages
{
public:
  virtual ~KnownStages () = default;

  /// The points of takePoints (), which also fills the report.
  virtual Points points (Report& report) = 0;

  /// The neighbours of these points, if some lie on others, else none.
  virtual CsrLists neighborsOfStacks () = 0;

  /// Points of the net that lie off any surface, ascending.
  virtual std::vector<Index> outliers () = 0;

  /// Planes of the net without outliers, without tree and neighbours beside lines.
  virtual LocalPlanes planes () = 0;

  /// See makeStars.
  virtual Stars begunStars () = 0;
};

/// See the overload without limits.
/// \param known if not nullptr: stages that are known, of a surface. The input then has no points
Result
reconstruct (Input input, const Options& options, const Limits& limits,
             KnownStages* known = nullptr);

} // namespace pcl::floater

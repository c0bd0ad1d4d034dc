// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The last changes of a mesh in parts where the parts meet.
#pragma once

#include "parts/part_finish.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// The mesh where parts meet.
struct FinishedSeam
{
  std::vector<Triangle> triangles; ///< of all zones, and those between them; corners are points
  std::size_t flips = 0;
  std::size_t folds_after_flips = 0; ///< but for those that parts have told
};

/// Inserts points that have no triangle, flips edges and repairs folds in the zones around the
/// triangles with corners in several parts (see repairMesh). Triangles beside those that are not in
/// a zone stay. O(m log m) at worst, for m points in all zones.
/// \param zones of all parts \param seam see Stitching
FinishedSeam
finishSeam (const std::vector<SeamZone>& zones, const std::vector<Triangle>& seam, bool flip_edges,
            const FinishLimits& limits, const RunContext& run);

} // namespace floater
} // namespace pcl

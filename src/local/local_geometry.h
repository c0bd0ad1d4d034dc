// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The geometry around each point.
#pragma once

#include "local/stars.h"
#include "points/kd_tree.h"
#include "points/points.h"

namespace pcl::floater {
/// The surface around each point, as used by both methods.
struct LocalGeometry
{
  CsrLists neighbors;         ///< nearest first
  std::vector<float> spacing; ///< of the working positions: localSpacing, or REACH_AS_SPACING times
                              ///< the reach of the star if that is larger
  std::vector<float> own_spacing; ///< of the positions, if they differ from the working positions;
                                  ///< otherwise empty
  Stars stars;                    ///< with unit normals

  /// Spacing on the mesh, whose vertices are the input positions.
  const std::vector<float>& meshSpacing () const
  {
    return own_spacing.empty () ? spacing : own_spacing;
  }
};

/// Spacing by the working positions of the points, for fitLocalPlanes ().
/// \param neighbors of each point, nearest first
/// \param known     kd-tree of the working positions; otherwise built if needed
LocalPlanes
beginPlanes (const Points& points, CsrLists neighbors, std::optional<KdTree> known,
             const StarSettings& settings, const RunContext& run);

/// Gives the neighbours of single points as they are after fitLocalPlanes (), which may follow later. Two
/// searches for each point on a line. For one thread.
/// \param points, planes must outlive the result
RowOf
rowsBeside (const Points& points, const LocalPlanes& planes);

/// Adds neighbours beside lines, and tangent planes by the working positions. O(n k). Planes through the
/// 8 nearest neighbours, refitted to all neighbours near that plane, so that a second sheet within reach
/// does not tilt them. If the 8 nearest are nearly collinear, as in scan lines, more are used.
/// \param planes see beginPlanes
LocalPlanes
fitLocalPlanes (const Points& points, LocalPlanes planes, const StarSettings& settings,
                const RunContext& run);

/// Stars and spacing by the working positions of the points. O(n k log k).
/// \param begun results of makeStars () for all points, if known; then `planes` needs no tree
LocalGeometry
makeLocalGeometry (const Points& points, LocalPlanes planes, const StarSettings& settings,
                   const RunContext& run, std::optional<Stars> begun = std::nullopt);

/// Copies the neighbours, spacing and stars of some points. O(n k).
/// \param rows the points, ascending
/// \param to   of as many points
void
copyRows (const LocalGeometry& from, const std::vector<Index>& rows, LocalGeometry& to);

} // namespace pcl::floater

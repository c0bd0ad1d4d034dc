// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Outlines of what is in front of other things, as seen from a viewpoint.
#pragma once

#include "view/ray_evidence.h"

namespace pcl::floater {
/// Limits of areOutlinesClear (), chosen by hand. Rows are those of generated sheets.
struct OutlineLimits
{
  std::size_t rays = 12; ///< nearest ones, at which an outline is looked for
  std::size_t least = 3; ///< rays to either surface; and of a patch at outlines, if it counts
  std::size_t every = 3; ///< of so many rays of the first patches one is looked at: 2 % of the time
                         ///< of a cloud of 2,000 points, 10 % with all
  double slope = 4.0;    ///< smallest step of the depth over the width of half of the rays; as
                         ///< EvidenceLimits::hidden_slope
  double apart = 2.0;    ///< smallest step, in depths of either surface
  std::size_t more = 4;  ///< times as many patches are taken where the first ones do not decide
  double row = 0.2;      ///< rays to a surface are in a row if they are narrower than this share of
                         ///< their length
};

/// Whether outlines tell that a cloud was seen from a viewpoint, however even its points are, such as
/// after a voxel filter. At an outline, near rays end on two surfaces. Seen from the sensor, a line
/// parts the rays to one from those to the other; from elsewhere, the surfaces overlap, and their rays
/// are mixed. Each patch with outlines is for the viewpoint or against it; those for it must be more
/// by two standard deviations of chance, so four at least. If they are more, but not by enough, more
/// patches are taken, and all of their rays. O(patches * points of a patch squared).
bool
areOutlinesClear (const Positions& positions, const std::vector<RayPatch>& patches,
                  const Viewpoint& viewpoint, const OutlineLimits& limits, const RunContext& run);

} // namespace pcl::floater

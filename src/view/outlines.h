// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Outlines of what is in front of other things, as seen from a viewpoint.
#pragma once

#include "view/ray_evidence.h"

namespace pcl::floater {
/// Whether outlines tell that a cloud was seen from a viewpoint, however even its points are, such as
/// after a voxel filter. At an outline, near rays end on two surfaces. Seen from the sensor, a line
/// parts the rays to one from those to the other; from elsewhere, the surfaces overlap, and their rays
/// are mixed. Each patch with outlines is for the viewpoint or against it; those for it must be more
/// by two standard deviations of chance, so four at least. If they are more, but not by enough, more
/// patches are taken, and all of their rays. O(patches * points of a patch squared).
bool
areOutlinesClear (const Positions& positions, const std::vector<RayPatch>& patches,
                  const Viewpoint& viewpoint, const RunContext& run);

} // namespace pcl::floater

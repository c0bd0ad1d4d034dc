// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Refines a viewpoint by the evenness of the rays.
#pragma once

#include "view/ray_evidence.h"

#include <vector>

namespace pcl::floater {
/// Fits a viewpoint to the rays of the patches: in each patch, the distances of the rays to the
/// nearest one should be equal, and so should those to the nearest one across (the next row of a
/// scanner). Least squares of the logarithms of these distances, minus their mean in the patch, by
/// Levenberg-Marquardt with Cauchy weights, which are robust to ends of rows and outlines.
/// O(patches * points of a patch squared) for each of at most twenty steps.
/// \param patches   found at a viewpoint nearby
/// \param is_coarse the start is not fitted yet: all pairs take part in the first steps, not only
///     those that are alike
Viewpoint
fitViewpoint (const std::vector<Eigen::Vector3d>& positions, const std::vector<RayPatch>& patches,
              const Viewpoint& start, bool is_coarse, const RunContext& run);

} // namespace pcl::floater

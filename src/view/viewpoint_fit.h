// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Moves a viewpoint that is nearly right to where the rays are spaced most evenly.
#pragma once

#include "view/ray_evidence.h"

#include <vector>

namespace pcl::floater {
/// Fits a viewpoint to the rays of the patches: in each patch, the distances of the rays to the
/// nearest one shall be alike, and so shall those to the nearest one across (the next row of a
/// scanner). Least squares of the logarithms of these distances about their mean in the patch, by
/// the method of Levenberg and Marquardt, with the weights of Cauchy's distribution, so that ends
/// of rows and outlines do not matter. O(patches * points of a patch squared) for each of at most
/// twenty steps.
/// \param patches   found at a viewpoint nearby
/// \param is_coarse the start is not the result of a fit: all pairs take part in the first steps,
///                  and not only those that are alike
Viewpoint
fitViewpoint (const std::vector<Eigen::Vector3d>& positions, const std::vector<RayPatch>& patches,
              const Viewpoint& start, bool is_coarse, const RunContext& run);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the caller's arrays fit together.
#pragma once

#include "core/problem.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl::floater {
/// INVALID_INDICES unless there is one cloud index for each position, each below the size of the
/// cloud and given once. O(n); one bit per point if they are not ascending.
Problem
checkInput (const Input& input);

/// A sensor position of (0, 0, 0) means: unknown.
bool
isSensorKnown (const std::array<double, 3>& sensor_origin);

/// INVALID_OPTION if the requested facing needs normals or a viewpoint that the input does not
/// have.
Problem
checkFacing (const Input& input, const Options& options);

} // namespace pcl::floater

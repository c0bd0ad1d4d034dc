// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// From the input to the working set.
#pragma once

#include "core/problem.h"
#include "options/request.h"
#include "points/points.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl::floater {
/// First step of a run: removes gross outliers and makes the working set. Frees each array of the
/// input after reading it.
Problem
takePoints (Input& input, const Request& request, Points& points, Report& report);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// From the input to the points that the stages work on.
#pragma once

#include "core/problem.h"
#include "options/request.h"
#include "points/points.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl::floater {
/// The first step of a run: gross outliers are taken out of the input, and the rest becomes the
/// working set. Arrays of the input are freed as soon as they have been read.
Problem
takePoints (Input& input, const Request& request, Points& points, Report& report);

} // namespace pcl::floater

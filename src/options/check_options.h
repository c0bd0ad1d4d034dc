// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Checks before, between and after the stages.
#pragma once

#include "core/problem.h"

#include <pcl/surface/floater/options.h>

namespace pcl::floater {
/// INVALID_OPTION if an option is out of its range, the solver does not take the ordering, or the
/// hole policy or a given loop does not fit the topology. INVALID_LOOP if the given loop has fewer
/// than three points. SOLVER_UNAVAILABLE if the library is without the solver.
Problem
checkOptions (const Options& options);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The entry of the core with other limits than the usual ones, for tests.
#pragma once

#include "options/stage_limits.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl::floater {
/// See the function of the same name that takes no limits.
Result
reconstruct (Input input, const Options& options, const Limits& limits);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Entry point of the core with other limits than the default, for tests.
#pragma once

#include "options/stage_limits.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl::floater {
/// See the overload without limits.
Result
reconstruct (Input input, const Options& options, const Limits& limits);

} // namespace pcl::floater

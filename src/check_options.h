// SPDX-License-Identifier: GPL-3.0-or-later
// Checks before, between and after the stages.
#pragma once

#include "core/problem.h"

#include <pcl/surface/floater/options.h>

namespace pcl
{
namespace floater
{
/// Every option in its range, the solver there and fit for the ordering, the policy for holes and a
/// given loop fit for the topology.
Problem
checkOptions (const Options& options);

} // namespace floater
} // namespace pcl

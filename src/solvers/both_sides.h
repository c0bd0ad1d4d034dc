// SPDX-License-Identifier: GPL-3.0-or-later
// Work on both right-hand sides of a system.
#pragma once

#include "common/parallel.h"

namespace pcl
{
namespace floater
{
/// Calls body (0) and body (1), at the same time where threads allow. The first exception thrown is
/// rethrown here when both have ended.
template <typename Body>
void
bothSides (int threads, const Body& body)
{
  parallelTasks (2, threads, body);
}

} // namespace floater
} // namespace pcl

// SPDX-License-Identifier: GPL-3.0-or-later
// The k nearest neighbours of every point.
#pragma once

#include "common/types.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl
{
namespace floater
{
/// The k nearest other points of every point, nearest first, ties by index; fewer where the set has
/// fewer. By the core's kd-tree in parallel, or by the caller's search structure in one thread;
/// what that one answers twice or outside of the set is ignored.
/// \throw std::length_error if there are 2^32 entries or more
FlatLists
findNearestNeighbors (const WorkingSet& set, int k, NeighborSearch* search, int threads);

} // namespace floater
} // namespace pcl

// SPDX-License-Identifier: GPL-3.0-or-later
// Balls whose radius follows the density (TW 385, section 6).
#pragma once

#include "common/types.h"

#include <pcl/surface/floater/reconstruct.h>

namespace pcl
{
namespace floater
{
/// Neighbours of a point whose mean distance is its local spacing, and the fewest of a ball.
constexpr int SPACING_NEIGHBORS = 6;
/// The most neighbours taken from a ball: next to a jump in density it may hold any number.
constexpr std::size_t MOST_IN_BALL = 200;

/// All other points in a ball around every point, nearest first, ties by index; its radius is
/// `radius` times the mean distance of the point's SPACING_NEIGHBORS nearest. At least as many as
/// these, at most MOST_IN_BALL nearest. By the core's kd-tree in parallel, or by the caller's
/// search structure in one thread. O(n (log n + neighbours)). \throw std::length_error if there are
/// 2^32 entries or more
FlatLists
findBallNeighbors (const WorkingSet& set, double radius, NeighborSearch* search, int threads);

} // namespace floater
} // namespace pcl

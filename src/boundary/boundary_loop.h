// SPDX-License-Identifier: GPL-3.0-or-later
// Section 3 of TW 385: from stars to one ordered loop.
#pragma once

#include "common/problem.h"
#include "common/types.h"

#include <pcl/surface/floater/options.h>

#include <vector>

namespace pcl
{
namespace floater
{
/// The loop that the surface is hung in.
struct Boundary
{
  std::vector<Index> loop;    ///< points in order, each once; empty if there is a problem
  std::size_t candidates = 0; ///< points that look like boundary
  double largest_step = 0.0;  ///< longest edge of the loop, in local spacings ...
  Index longest_from = NONE;  ///< ... and the point where it begins
  Problem problem;            ///< NO_BOUNDARY or INVALID_LOOP
};

/// The user's loop if there is one, else by the method of the options.
Boundary
findBoundary (const WorkingSet& set, const FlatLists& near, const Stars& stars,
              const Options& options);

} // namespace floater
} // namespace pcl

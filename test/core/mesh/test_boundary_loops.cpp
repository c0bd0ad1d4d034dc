// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/boundary_loops.h"

#include <gtest/gtest.h>

namespace pcl
{
namespace floater
{
namespace
{
// Widths of the rims that stay, of rims 1 to 9 wide with spacings of 0.5.
std::vector<double>
staying (double largest_hole, double largest_hole_length, double unit)
{
  std::vector<BoundaryLoop> loops;
  for (int width = 1; width <= 9; ++width) {
    BoundaryLoop loop{};
    loop.width = width;
    loop.spacing = 0.5;
    loops.push_back (loop);
  }
  Options options;
  options.holes.policy = HolePolicy::BY_SIZE;
  options.holes.largest_hole = largest_hole;
  options.holes.largest_hole_length = largest_hole_length;
  chooseOpenLoops (loops, {100}, options, unit);
  std::vector<double> widths;
  for (const BoundaryLoop& loop : loops)
    if (loop.keep_open)
      widths.push_back (loop.width);
  return widths;
}

TEST (Rims, StayIfTheyExceedAnyOfTheSizesGiven)
{
  EXPECT_EQ (staying (14.0, 0.0, 1.0), (std::vector<double>{8.0, 9.0}));
  EXPECT_EQ (staying (0.0, 6.0, 1.0), (std::vector<double>{7.0, 8.0, 9.0}));
  EXPECT_EQ (staying (0.0, 3.0, 2.0), (std::vector<double>{7.0, 8.0, 9.0}));
  EXPECT_EQ (staying (14.0, 6.0, 1.0), (std::vector<double>{7.0, 8.0, 9.0}));
  EXPECT_EQ (staying (12.0, 8.0, 1.0), (std::vector<double>{7.0, 8.0, 9.0}));
}

} // namespace
} // namespace floater
} // namespace pcl

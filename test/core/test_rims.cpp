// SPDX-License-Identifier: GPL-3.0-or-later
#include "complex/rims.h"

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
  std::vector<Rim> rims;
  for (int width = 1; width <= 9; ++width) {
    Rim rim{};
    rim.width = width;
    rim.spacing = 0.5;
    rims.push_back (rim);
  }
  Options options;
  options.holes = HolePolicy::BY_SIZE;
  options.largest_hole = largest_hole;
  options.largest_hole_length = largest_hole_length;
  chooseRims (rims, {100}, options, unit);
  std::vector<double> widths;
  for (const Rim& rim : rims)
    if (rim.stays)
      widths.push_back (rim.width);
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

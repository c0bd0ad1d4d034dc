// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/order_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

namespace pcl::floater {
namespace {
// All ranks of lists of every size up to 40, whose numbers are different or mostly equal.
TEST (OrderStatistics, TwoRanksAreThoseOfTheSortedList)
{
  std::mt19937 random (1);
  for (const int different : {1, 3, 1000})
    for (std::size_t count = 1; count <= 40; ++count) {
      std::uniform_int_distribution<int> number (1, different);
      std::vector<double> numbers (count);
      for (double& value : numbers)
        value = number (random);
      std::vector<double> sorted = numbers;
      std::sort (sorted.begin (), sorted.end ());
      for (std::size_t high = 0; high < count; ++high)
        for (std::size_t low = 0; low <= high; ++low) {
          std::vector<double> values = numbers;
          ASSERT_EQ (valuesAtRanks (values, low, high), std::make_pair (sorted[low], sorted[high]))
              << count << " numbers, ranks " << low << " and " << high;
        }
    }
}

} // namespace
} // namespace pcl::floater

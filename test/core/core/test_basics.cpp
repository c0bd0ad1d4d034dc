// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What all stages use: long lists of lists, and parallel loops. The tests of the stages use the rest.
#include "core/csr_lists.h"
#include "core/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <new>
#include <stdexcept>
#include <vector>

namespace pcl::floater {
namespace {
TEST (Parallel, TasksAndRangesCoverAllOnce)
{
  for (const int threads : {1, 2, 7})
    for (const std::size_t count : {0U, 1U, 2U, 5U, 1000U, 1023U, 1024U, 1025U, 10000U}) {
      std::vector<std::atomic<int>> runs (count);
      parallelTasks (threads, count, [&runs] (std::size_t i) { ++runs[i]; });
      parallelRanges (threads, count, [&] (std::size_t first, std::size_t last) {
        EXPECT_EQ (first % RANGE_LENGTH, 0U);
        EXPECT_EQ (last, std::min (count, first + RANGE_LENGTH));
        for (std::size_t i = first; i < last; ++i)
          runs[i] += 10;
      });
      for (const std::atomic<int>& of_one : runs)
        ASSERT_EQ (of_one, 11);
    }
}

TEST (Parallel, RethrowsWhatATaskThrows)
{
  for (const int threads : {1, 2, 5}) {
    EXPECT_THROW (parallelTasks (threads, 8, [] (std::size_t) { throw std::bad_alloc (); }),
                  std::bad_alloc);
    std::atomic<int> begun{0};
    const auto failAtOnce = [&begun] (std::size_t) {
      ++begun;
      throw std::runtime_error ("in a task");
    };
    EXPECT_THROW (parallelTasks (threads, 100000, failAtOnce), std::runtime_error);
    EXPECT_LE (begun, threads) << "no task begins after the first error";
  }
}

} // namespace
} // namespace pcl::floater

// SPDX-License-Identifier: GPL-3.0-or-later
// A parallel loop over ranges whose result cannot depend on the number of threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace pcl
{
namespace floater
{
/// Number of threads to use: `threads` if positive, else all cores.
inline int
resolveThreads (int threads)
{
  return threads > 0 ? threads
                     : std::max (1, static_cast<int> (std::thread::hardware_concurrency ()));
}

/// Calls body (i) for i from 0 to count - 1, by `threads` threads and in any order, so body must
/// write only to places that belong to i. The first exception thrown by a body is rethrown here.
template <typename Body>
void
parallelTasks (std::size_t count, int threads, Body&& body)
{
  std::atomic<std::size_t> next{0};
  std::exception_ptr error;
  std::mutex error_mutex;
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++)
        body (i);
    }
    catch (...) {
      const std::lock_guard<std::mutex> lock (error_mutex);
      if (!error)
        error = std::current_exception ();
      next = count;
    }
  };
  std::vector<std::thread> helpers;
  const std::size_t wanted =
      std::min<std::size_t> (static_cast<std::size_t> (resolveThreads (threads)), count);
  try {
    for (std::size_t t = 1; t < wanted; ++t)
      helpers.emplace_back (work);
  }
  catch (const std::exception&) {
    // Fewer threads than asked for could be started; those that run do all the work.
  }
  work ();
  for (std::thread& helper : helpers)
    helper.join ();
  if (error)
    std::rethrow_exception (error);
}

/// Length of the ranges of parallelRanges, but for the last: range r begins at r * RANGE_LENGTH.
constexpr std::size_t RANGE_LENGTH = 1024;

/// The same for consecutive ranges that cover 0 to count: body (first, last).
template <typename Body>
void
parallelRanges (std::size_t count, int threads, Body&& body)
{
  parallelTasks ((count + RANGE_LENGTH - 1) / RANGE_LENGTH, threads, [&] (std::size_t range) {
    body (range * RANGE_LENGTH, std::min (count, (range + 1) * RANGE_LENGTH));
  });
}

} // namespace floater
} // namespace pcl

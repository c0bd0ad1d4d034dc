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

/// Length of the ranges of parallelRanges, but for the last: range r begins at r * RANGE_LENGTH.
constexpr std::size_t RANGE_LENGTH = 1024;

/// Calls body (first, last) for consecutive ranges that cover 0 to count. Ranges are handed out to
/// `threads` threads in any order, so body must write only to places that belong to its range. The
/// first exception thrown by a body is rethrown here.
template <typename Body>
void
parallelRanges (std::size_t count, int threads, Body&& body)
{
  const std::size_t chunks = (count + RANGE_LENGTH - 1) / RANGE_LENGTH;
  std::atomic<std::size_t> next{0};
  std::exception_ptr error;
  std::mutex error_mutex;
  const auto work = [&] {
    try {
      for (std::size_t c = next++; c < chunks; c = next++)
        body (c * RANGE_LENGTH, std::min (count, (c + 1) * RANGE_LENGTH));
    }
    catch (...) {
      const std::lock_guard<std::mutex> lock (error_mutex);
      if (!error)
        error = std::current_exception ();
      next = chunks;
    }
  };
  std::vector<std::thread> helpers;
  const std::size_t wanted =
      std::min<std::size_t> (static_cast<std::size_t> (resolveThreads (threads)), chunks);
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

} // namespace floater
} // namespace pcl

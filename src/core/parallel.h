// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Parallel loops whose results do not depend on the number of threads.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "core/types.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <tuple>

namespace pcl::floater {
/// Calls body (i) for every i below `count`, on the threads of the run and in any order. The result
/// does not depend on the number of threads if body writes only to entries that belong to i.
/// Rethrows the first exception of a body, and begins no more tasks then. Reports progress, and
/// ends early if the run is cancelled.
template <typename Body>
void
parallelTasks (const RunContext& run, std::size_t count, Body&& body)
{
  constexpr std::chrono::milliseconds BETWEEN_POLLS{50};
  constexpr std::size_t FEW = 2; // tasks; their inner loops report progress better
  ProgressLoop progress (run, count > FEW ? count : 0);
  std::atomic<std::size_t> next{0};
  std::size_t running = 0;
  std::exception_ptr error;
  std::mutex mutex;
  std::condition_variable ended;
  const auto guarded = [&] (const auto& work) {
    try {
      work ();
    }
    catch (...) {
      const std::lock_guard<std::mutex> lock (mutex);
      if (!error)
        error = std::current_exception ();
      next = count;
    }
  };
  const auto help = [&] {
    guarded ([&] {
      for (std::size_t i = next++; i < count; i = next++)
        body (i);
    });
    const std::lock_guard<std::mutex> lock (mutex);
    --running;
    ended.notify_one ();
  };
  HelperThreads own; // used without a monitor, which has the shared ones
  HelperThreads& helpers = run.helpers () != nullptr ? *run.helpers () : own;
  const std::size_t wanted =
      std::min<std::size_t> (static_cast<std::size_t> (run.threads ()), count);
  try {
    for (std::size_t t = 1; t < wanted; ++t) {
      const std::lock_guard<std::mutex> lock (mutex);
      helpers.start (std::cref (help));
      ++running;
    }
  }
  catch (const std::exception&) {
    // No more threads could be started; the running ones do all the work.
  }
  guarded ([&] {
    for (std::size_t i = next++; i < count; i = next++) {
      body (i);
      progress.reach (i);
    }
  });
  // Only this thread polls for cancellation, also while it waits for the others.
  const auto have_all_ended = [&] {
    std::unique_lock<std::mutex> lock (mutex);
    return ended.wait_for (lock, BETWEEN_POLLS, [&running] { return running == 0; });
  };
  while (!have_all_ended ())
    guarded ([&] { progress.reach (0); });
  if (error)
    std::rethrow_exception (error);
}

/// Sorts values that all differ: halves on the threads of the run, which are merged. Polls for
/// cancellation. O(n log n).
template <typename Iterator, typename IsLess>
void
sortInParallel (Iterator first, Iterator last, const IsLess& isLess, const RunContext& run)
{
  constexpr std::ptrdiff_t SORTED_AT_ONCE = 16384;
  if (last - first <= SORTED_AT_ONCE) {
    run.poll ();
    std::sort (first, last, isLess);
    return;
  }
  const Iterator middle = first + (last - first) / 2;
  const int others = run.threads () / 2;
  const RunContext share = run.withThreads (std::max (1, run.threads () - others));
  parallelTasks (others > 0 ? run.withThreads (2) : run, 2, [&] (std::size_t half) {
    sortInParallel (half == 0 ? first : middle, half == 0 ? middle : last, isLess,
                    half == 0 ? share : run.withThreads (std::max (1, others)));
  });
  std::inplace_merge (first, middle, last, isLess);
}

/// Length of the ranges of parallelRanges; the last may be shorter. Range r begins at
/// r * RANGE_LENGTH.
constexpr std::size_t RANGE_LENGTH = 1024;

/// Calls body (first, last) for consecutive ranges that cover 0 to count, by parallelTasks ().
template <typename Body>
void
parallelRanges (const RunContext& run, std::size_t count, Body&& body)
{
  const std::size_t ranges = (count + RANGE_LENGTH - 1) / RANGE_LENGTH;
  parallelTasks (run, ranges, [&] (std::size_t r) {
    body (r * RANGE_LENGTH, std::min (count, (r + 1) * RANGE_LENGTH));
  });
}

/// Calls body (p, scratch...) for all points p below `count`, in such ranges, each of which has scratch of
/// its own.
template <typename... Scratch, typename Body>
void
parallelPoints (const RunContext& run, std::size_t count, Body&& body)
{
  parallelRanges (run, count, [&] (std::size_t first, std::size_t last) {
    std::tuple<Scratch...> scratch;
    for (auto p = static_cast<Index> (first); p < last; ++p)
      std::apply ([&] (auto&... one) { body (p, one...); }, scratch);
  });
}

/// Values that the ranges of parallelRanges () find, each in a list of its own.
template <typename Value>
class RangeLists
{
public:
  explicit RangeLists (std::size_t count) : lists_ ((count + RANGE_LENGTH - 1) / RANGE_LENGTH) {}

  /// The list of the range that begins at `first`.
  std::vector<Value>& of (std::size_t first) { return lists_[first / RANGE_LENGTH]; }

  std::size_t size () const
  {
    std::size_t sum = 0;
    for (const std::vector<Value>& list : lists_)
      sum += list.size ();
    return sum;
  }

  /// All values in the order of the ranges. Frees the lists.
  std::vector<Value> join ()
  {
    std::vector<Value> all;
    all.reserve (size ());
    for (std::vector<Value>& list : lists_) {
      all.insert (all.end (), list.begin (), list.end ());
      std::vector<Value> ().swap (list);
    }
    return all;
  }

private:
  std::vector<std::vector<Value>> lists_;
};

/// Lists of indices whose rows the ranges of parallelRanges () find, each its own in ascending order.
class RangeRows
{
public:
  /// \param count of what the ranges cover
  /// \param rows  of the lists
  RangeRows (std::size_t count, std::size_t rows) : ids_ (count)
  {
    lists_.offsets.assign (rows + 1, 0);
  }

  /// Appends to a row, by the range that begins at `first`.
  void add (std::size_t first, std::size_t row, Index id)
  {
    ids_.of (first).push_back (id);
    ++lists_.offsets[row + 1];
  }

  /// The lists. O(rows + entries). Frees what the ranges have found.
  /// \throws IndexLimitReached if there are 2^32 - 1 entries or more
  CsrLists join ()
  {
    requireListed (ids_.size ());
    sumRowLengths (lists_.offsets);
    lists_.ids = ids_.join ();
    return std::move (lists_);
  }

private:
  RangeLists<Index> ids_;
  CsrLists lists_; // the length of each row instead of the offsets
};

} // namespace pcl::floater

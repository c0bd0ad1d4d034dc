// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A pool of threads for loops.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace pcl::floater {
/// Threads that are kept between loops: a run has dozens of loops, and starting a thread takes as
/// long as reading some thousand points. Thread-safe.
class HelperThreads
{
public:
  using Work = std::function<void ()>; // must not throw

  ~HelperThreads ();

  /// Gives work to an idle thread or to a new one. It is never queued behind other work, so work
  /// may wait for work that it starts.
  /// \throws std::exception if no thread can be started
  void start (Work work);

private:
  void help ();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Work> begun_; // for which threads were woken or started
  std::size_t waiting_ = 0; // threads without work, less those that were woken
  bool is_ending_ = false;
  std::vector<std::thread> threads_;
};

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Threads that wait for the next loop instead of being started for it.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace pcl::floater {
/// Threads that stay when their work is done. A run has dozens of loops, and a new thread takes as
/// long as looking at some thousand points. May be used by several threads.
class HelperThreads
{
public:
  /// Neither function may throw.
  struct Work
  {
    std::function<void ()> run;
    std::function<void ()> ended; ///< called after it, when the thread can be had again
  };

  HelperThreads () = default;
  ~HelperThreads ();
  HelperThreads (const HelperThreads&) = delete;
  HelperThreads& operator= (const HelperThreads&) = delete;
  HelperThreads (HelperThreads&&) = delete;
  HelperThreads& operator= (HelperThreads&&) = delete;

  /// Gives work to a thread that waits, or to a new one: it never waits for other work, so that
  /// work may wait for work that it starts.
  /// \throws std::exception if no thread can be started
  void start (Work work);

private:
  void help ();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Work> begun_; // for which threads have been woken, or started
  std::size_t waiting_ = 0; // threads without work
  bool is_ending_ = false;
  std::vector<std::thread> threads_;
};

} // namespace pcl::floater

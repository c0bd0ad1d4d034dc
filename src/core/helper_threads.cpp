// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/helper_threads.h"

#include <utility>

namespace pcl::floater {
HelperThreads::~HelperThreads ()
{
  {
    const std::lock_guard<std::mutex> lock (mutex_);
    is_ending_ = true;
  }
  changed_.notify_all ();
  for (std::thread& thread : threads_)
    thread.join ();
}

void
HelperThreads::start (Work work)
{
  const std::lock_guard<std::mutex> lock (mutex_);
  begun_.push_back (std::move (work));
  if (waiting_ > 0) {
    --waiting_;
    changed_.notify_one ();
    return;
  }
  try {
    threads_.emplace_back ([this] { help (); });
  }
  catch (...) {
    begun_.pop_back ();
    throw;
  }
}

void
HelperThreads::help ()
{
  for (;;) {
    Work work;
    {
      std::unique_lock<std::mutex> lock (mutex_);
      changed_.wait (lock, [this] { return is_ending_ || !begun_.empty (); });
      if (begun_.empty ())
        return;
      work = std::move (begun_.back ());
      begun_.pop_back ();
    }
    work ();
    const std::lock_guard<std::mutex> lock (mutex_);
    ++waiting_;
  }
}

} // namespace pcl::floater

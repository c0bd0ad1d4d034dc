// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run_context.h"

#include <algorithm>

namespace pcl::floater {
namespace {
constexpr int REST = 9; // times as long as the last callbacks took, before the next ones ...
constexpr std::chrono::milliseconds QUICK{1}; // ... unless they took less than this
constexpr auto STAGES = static_cast<std::size_t> (Stage::COUNT);
using Shares = std::array<double, STAGES>; // in percent, in the order of the stages

// Measured on a torus of 100,000 points with two cores; a million points have the same shares.
constexpr Shares OF_SURFACE{5, 29, 43, 11, 0, 0, 0, 0, 1, 8, 3};
// Measured on height fields of 100,000 and of a million points with two cores. The share of the
// solver grows with the number of points, from a third to more than half.
constexpr Shares OF_DISC{2, 8, 15, 0, 12, 2, 38, 5, 0, 15, 3};

} // namespace

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

RunMonitor::RunMonitor (Callbacks callbacks, Statistics& statistics, bool is_disc)
    : callbacks_ (std::move (callbacks)), statistics_ (statistics),
      is_watched_ (callbacks_.progress || callbacks_.cancelled), is_disc_ (is_disc)
{
}

void
RunMonitor::beginStage (Stage stage)
{
  if (stage == stage_)
    return;
  stopClock ();
  if (callbacks_.stage)
    callbacks_.stage (stage);
  const Shares& shares = is_disc_ ? OF_DISC : OF_SURFACE;
  const auto index = static_cast<std::size_t> (stage);
  // Shares of skipped stages belong to the next one.
  double share = 0.0, left = 0.0;
  for (std::size_t s = std::min (index, next_stage_); s < STAGES; ++s)
    (s <= index ? share : left) += shares[s];
  left += share;
  next_stage_ = index + 1;
  done_ = stage_begin_ = std::max (done_, stage_end_);
  stage_end_ = stage_begin_ + (1.0 - stage_begin_) * (left > 0.0 ? share / left : 0.0);
  step_end_ = stage_begin_;
  has_step_ = false;
  poll ();
  stage_ = stage;
  stage_start_ = Clock::now ();
}

void
RunMonitor::stopClock ()
{
  if (stage_ == Stage::COUNT)
    return;
  const double seconds = std::chrono::duration<double> (Clock::now () - stage_start_).count ();
  statistics_.seconds[static_cast<std::size_t> (stage_)] += seconds;
  statistics_.total_seconds += seconds;
  stage_ = Stage::COUNT;
}

void
RunMonitor::beginStep (double until)
{
  done_ = step_begin_ = std::max (done_, step_end_);
  step_end_ = std::max (done_, stage_begin_ + until * (stage_end_ - stage_begin_));
  has_step_ = true;
  poll ();
}

void
RunMonitor::poll ()
{
  if (is_cancelled_)
    throw Cancelled ();
  if (!isOwnThread ())
    return;
  const Clock::time_point start = Clock::now ();
  if (start < next_poll_)
    return;
  if (callbacks_.cancelled && callbacks_.cancelled ()) {
    is_cancelled_ = true;
    throw Cancelled ();
  }
  if (callbacks_.progress)
    callbacks_.progress (std::min (done_, 1.0));
  last_poll_ = Clock::now ();
  if (last_poll_ - start > QUICK)
    next_poll_ = last_poll_ + REST * (last_poll_ - start);
}

void
RunMonitor::pollNowAndThen ()
{
  if (is_cancelled_ || (isOwnThread () && Clock::now () - last_poll_ >= between_polls))
    poll ();
}

void
RunMonitor::finish ()
{
  stopClock ();
  done_ = 1.0;
  if (callbacks_.progress)
    callbacks_.progress (done_);
}

RunContext::RunContext (int threads, RunMonitor* monitor)
    : threads_ (threads > 0
                    ? threads
                    : std::max (1, static_cast<int> (std::thread::hardware_concurrency ()))),
      monitor_ (monitor)
{
}

void
RunContext::beginStage (Stage stage) const
{
  if (monitor_ != nullptr && !is_within_stage_)
    monitor_->beginStage (stage);
  else
    poll ();
}

void
RunContext::beginStep (double until) const
{
  if (monitor_ != nullptr && !is_within_stage_)
    monitor_->beginStep (until);
  else
    poll ();
}

ProgressLoop::ProgressLoop (const RunContext& run, std::size_t items)
    : monitor_ (run.monitor_ != nullptr && run.monitor_->isWatched () ? run.monitor_ : nullptr),
      items_ (items)
{
  if (items == 0 || monitor_ == nullptr || run.is_within_stage_ || !monitor_->isOwnThread () ||
      monitor_->is_in_loop_)
    return;
  moves_ = monitor_->is_in_loop_ = true;
  if (!monitor_->has_step_) {
    monitor_->step_begin_ = std::max (monitor_->done_, monitor_->step_end_);
    monitor_->step_end_ = 0.5 * (monitor_->step_begin_ + monitor_->stage_end_);
  }
  monitor_->has_step_ = false;
}

ProgressLoop::~ProgressLoop ()
{
  if (!moves_)
    return;
  monitor_->is_in_loop_ = false;
  monitor_->done_ = std::max (monitor_->done_, monitor_->step_end_);
}

void
ProgressLoop::reach (std::size_t count)
{
  if (monitor_ == nullptr)
    return;
  if (moves_) {
    const double share = std::min (1.0, static_cast<double> (count) / static_cast<double> (items_));
    monitor_->done_ =
        std::max (monitor_->done_,
                  monitor_->step_begin_ + share * (monitor_->step_end_ - monitor_->step_begin_));
  }
  monitor_->pollNowAndThen ();
}

} // namespace pcl::floater

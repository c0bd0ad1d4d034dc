// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/monitor.h"

#include <algorithm>
#include <array>

namespace pcl
{
namespace floater
{
namespace
{
constexpr std::chrono::milliseconds BETWEEN_POLLS{50};

constexpr auto STAGES = static_cast<std::size_t> (Stage::COUNT);
using Shares = std::array<double, STAGES>; // in percent, in the order of the stages

// A torus of 100,000 points on two cores; of a million, where the neighbours are found with the
// stars in blocks, the two have as much together.
constexpr Shares OF_SURFACE{5, 29, 43, 11, 0, 0, 0, 0, 1, 8, 3};
// Height fields of 100,000 and of a million points on two cores. The solver's share grows with
// their number, from a third to more than half.
constexpr Shares OF_DISC{2, 10, 17, 0, 2, 2, 46, 5, 0, 13, 3};

thread_local Monitor* monitor_of_thread = nullptr;

} // namespace

Monitor::Monitor (const Options& options) : options_ (options), outer_ (monitor_of_thread)
{
  // Without callbacks there is nothing to be done in any loop.
  if (options.advance || options.cancelled)
    monitor_of_thread = this;
}

Monitor::~Monitor ()
{
  monitor_of_thread = outer_;
}

Monitor*
Monitor::current ()
{
  return monitor_of_thread;
}

void
Monitor::enterStage (Stage stage)
{
  if (!isMine () || is_in_loop_) {
    poll ();
    return;
  }
  const Shares& shares = is_disc_ ? OF_DISC : OF_SURFACE;
  const auto index = static_cast<std::size_t> (stage);
  // With the stages before it that were left out: their work is done in it.
  double share = 0.0, left = 0.0;
  for (std::size_t s = std::min (index, next_stage_); s < STAGES; ++s) {
    (s <= index ? share : left) += shares[s];
  }
  left += share;
  next_stage_ = index + 1;
  done_ = stage_begin_ = std::max (done_, stage_end_);
  stage_end_ = stage_begin_ + (1.0 - stage_begin_) * (left > 0.0 ? share / left : 0.0);
  step_end_ = stage_begin_;
  has_step_ = false;
  poll ();
}

void
Monitor::enterStep (double until)
{
  if (isMine () && !is_in_loop_) {
    done_ = step_begin_ = std::max (done_, step_end_);
    step_end_ = std::max (done_, stage_begin_ + until * (stage_end_ - stage_begin_));
    has_step_ = true;
  }
  poll ();
}

void
Monitor::poll ()
{
  if (is_stopped_)
    throw Cancelled ();
  if (!isMine ())
    return;
  last_poll_ = Clock::now ();
  if (options_.cancelled && options_.cancelled ()) {
    is_stopped_ = true;
    throw Cancelled ();
  }
  tell ();
}

void
Monitor::pollNowAndThen ()
{
  if (is_stopped_ || (isMine () && Clock::now () - last_poll_ >= BETWEEN_POLLS))
    poll ();
}

void
Monitor::tell ()
{
  if (options_.advance)
    options_.advance (std::min (done_, 1.0));
}

void
Monitor::finish ()
{
  done_ = 1.0;
  tell ();
}

Monitor::Helper::Helper (Monitor* monitor)
{
  monitor_of_thread = monitor;
}

Monitor::Helper::~Helper ()
{
  monitor_of_thread = nullptr;
}

MonitoredLoop::MonitoredLoop (std::size_t items) : monitor_ (Monitor::current ()), items_ (items)
{
  if (items == 0 || !monitor_ || !monitor_->isMine () || monitor_->is_in_loop_)
    return;
  moves_ = monitor_->is_in_loop_ = true;
  if (!monitor_->has_step_) {
    monitor_->step_begin_ = std::max (monitor_->done_, monitor_->step_end_);
    monitor_->step_end_ = 0.5 * (monitor_->step_begin_ + monitor_->stage_end_);
  }
  monitor_->has_step_ = false;
}

MonitoredLoop::~MonitoredLoop ()
{
  if (!moves_)
    return;
  monitor_->is_in_loop_ = false;
  monitor_->done_ = std::max (monitor_->done_, monitor_->step_end_);
}

void
MonitoredLoop::reach (std::size_t count)
{
  if (!monitor_)
    return;
  if (moves_) {
    const double share = std::min (1.0, static_cast<double> (count) / static_cast<double> (items_));
    monitor_->done_ =
        std::max (monitor_->done_,
                  monitor_->step_begin_ + share * (monitor_->step_end_ - monitor_->step_begin_));
  }
  monitor_->pollNowAndThen ();
}

} // namespace floater
} // namespace pcl

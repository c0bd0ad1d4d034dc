// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a stage is given of the run that it belongs to: threads, clock, progress, cancellation.
#pragma once

#include "core/helper_threads.h"

#include <pcl/surface/floater/options.h>
#include <pcl/surface/floater/report.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <thread>

namespace pcl::floater {
/// Unwinds a run that its caller has cancelled. It is no std::exception, so that no stage takes it
/// for a failure of its own.
struct Cancelled
{
};

/// Functions of the caller; each may be empty. All but the last are called by the thread that made
/// the monitor.
struct Callbacks
{
  std::function<void (Stage)> stage;     ///< a stage begins
  std::function<void (double)> progress; ///< the fraction of the run that is done
  std::function<bool ()> cancelled;      ///< whether the run is to be cancelled
  std::function<void ()> task{};         ///< a thread is about to begin a task, or a part of one;
                                         ///< must not throw
};

/// Clock and callbacks of one run. Books wall time by stage, tells the caller how much of the run
/// is done, and asks whether to go on: at the begin of each stage and, from the loops in it
/// (ProgressLoop), up to 20 times a second.
///
/// The fraction that is done is estimated from the shares of the stages in typical runs. Within a
/// stage, steps may be announced. A loop that follows such a step runs through it evenly; any other
/// loop takes half of what is left of its stage.
class RunMonitor
{
public:
  /// \param statistics where time is booked; must outlive the monitor
  RunMonitor (Callbacks callbacks, Statistics& statistics);
  ~RunMonitor () { stopClock (); }
  RunMonitor (const RunMonitor&) = delete;
  RunMonitor& operator= (const RunMonitor&) = delete;
  RunMonitor (RunMonitor&&) = delete;
  RunMonitor& operator= (RunMonitor&&) = delete;

  /// Tells which method makes the mesh from here on, DISC or SURFACE (the default).
  void setMethod (Topology method) { is_disc_ = method == Topology::DISC; }

  /// A stage begins. Its share of the progress includes the shares of skipped stages. Does nothing
  /// if the stage is running already.
  /// \throws Cancelled
  void beginStage (Stage stage);

  /// A step of the stage begins, which ends when the fraction `until` of the stage is done. One
  /// loop is to run through it.
  /// \throws Cancelled
  void beginStep (double until);

  /// No stage is running from here on; time is booked to none.
  void stopClock ();

  /// Asks whether to go on if the last time is long enough ago.
  /// \throws Cancelled
  void pollNowAndThen ();

  /// The run has ended well: tells that all of it is done.
  void finish ();

  /// A thread of the run is about to begin a task. May be called by any of them.
  void beginTask () const
  {
    if (callbacks_.task)
      callbacks_.task ();
  }

  /// Threads for the loops of the run.
  HelperThreads& helpers () { return helpers_; }

  /// Whether there are callbacks for what happens within stages.
  bool isWatched () const { return is_watched_; }

private:
  friend class ProgressLoop;
  using Clock = std::chrono::steady_clock;

  bool isOwnThread () const { return std::this_thread::get_id () == owner_; }
  void poll ();
  void tell ();

  Callbacks callbacks_;
  Statistics& statistics_;
  std::thread::id owner_ = std::this_thread::get_id ();
  bool is_watched_;
  std::atomic<bool> is_cancelled_{false};
  Stage stage_ = Stage::COUNT; // that is running; COUNT: none
  Clock::time_point stage_start_, last_poll_;
  bool is_disc_ = false;
  std::size_t next_stage_ = 0; // after the one that is running
  bool is_in_loop_ = false;
  bool has_step_ = false; // announced, and no loop has run through it yet
  double done_ = 0.0;     // fraction of the whole run, as all below
  double stage_begin_ = 0.0, stage_end_ = 0.0;
  double step_begin_ = 0.0, step_end_ = 0.0;
  HelperThreads helpers_;
};

/// Handle of a run, passed to each stage by value or reference: the number of threads, and the
/// monitor if there is one. A number of threads converts to a context without a monitor.
class RunContext
{
public:
  /// \param threads 0: all cores
  RunContext (int threads, RunMonitor* monitor = nullptr); // implicit, see above

  int threads () const { return threads_; } ///< 1 or more

  /// Threads that stay for the next loop; nullptr without a monitor.
  HelperThreads* helpers () const { return monitor_ != nullptr ? &monitor_->helpers () : nullptr; }

  /// The same run with another number of threads, 1 or more.
  RunContext withThreads (int threads) const
  {
    RunContext context = *this;
    context.threads_ = threads;
    return context;
  }

  /// See RunMonitor. All do nothing without a monitor.
  /// \throws Cancelled
  void beginStage (Stage stage) const;
  void beginStep (double until) const;
  void setMethod (Topology method) const;
  void beginTask () const
  {
    if (monitor_ != nullptr)
      monitor_->beginTask ();
  }
  void poll () const
  {
    if (monitor_ == nullptr || !monitor_->isWatched ())
      return;
    monitor_->beginTask ();
    monitor_->pollNowAndThen ();
  }

  /// The same run for a part of a stage that goes through stages of its own. These are not told to
  /// the caller, and their time belongs to the stage that is running. They can be cancelled.
  RunContext withinStage () const;

private:
  friend class ProgressLoop;

  int threads_;
  RunMonitor* monitor_;
  bool is_within_stage_ = false;
};

/// A loop that moves the fraction that is done, and may be cancelled. Make one before the loop;
/// call next () once for each item, or reach () where it is known how far the loop is. Of loops
/// within loops the outermost one moves the fraction; all may be cancelled. A few ns per item.
///
/// Threads that help the run's own thread may use it as well. They do not tell progress; they see
/// that the run was cancelled, and unwind. Each poll also calls the task callback.
class ProgressLoop
{
public:
  /// \param items how many there will be; 0: not known, the fraction does not move
  explicit ProgressLoop (const RunContext& run, std::size_t items = 0);
  ~ProgressLoop ();
  ProgressLoop (const ProgressLoop&) = delete;
  ProgressLoop& operator= (const ProgressLoop&) = delete;
  ProgressLoop (ProgressLoop&&) = delete;
  ProgressLoop& operator= (ProgressLoop&&) = delete;

  /// One more item. Asks every 256th time; as many take no tenth of a second.
  /// \throws Cancelled
  void next ()
  {
    if (++count_ % ITEMS_PER_POLL == 0)
      reach (count_);
  }

  /// So many items are done. For loops of few and large items.
  /// \throws Cancelled
  void reach (std::size_t count);

private:
  static constexpr std::size_t ITEMS_PER_POLL = 256;

  RunMonitor* monitor_; // nullptr if nobody watches
  std::size_t items_;
  std::size_t count_ = 0;
  bool moves_ = false; // is the outermost loop of the run's own thread
};

} // namespace pcl::floater

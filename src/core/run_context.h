// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The run as a stage uses it: threads, clock, progress, cancellation.
#pragma once

#include <pcl/surface/floater/options.h>
#include <pcl/surface/floater/report.h>

#include <atomic>
#include <cfenv>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace pcl::floater {
/// Unwinds a cancelled run. Not a std::exception, so that no stage handles it as a failure.
struct Cancelled
{
};

/// Functions of the caller; each may be empty. Called by the thread that made the monitor.
struct Callbacks
{
  std::function<void (Stage)> stage;     ///< a stage begins
  std::function<void (double)> progress; ///< fraction of the run done
  std::function<bool ()> cancelled;      ///< whether the run is to be cancelled
};

/// Floating-point numbers as the library needs them, whatever the caller has set: divisions by zero and
/// invalid operations do not end the program. Threads that are started meanwhile have them so as well.
class QuietNumbers
{
public:
  QuietNumbers () { std::feholdexcept (&before_); }
  ~QuietNumbers () { std::fesetenv (&before_); }
  QuietNumbers (const QuietNumbers&) = delete;
  QuietNumbers& operator= (const QuietNumbers&) = delete;

private:
  std::fenv_t before_{};
};

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

/// Clock and callbacks of one run. Measures wall time by stage, reports progress and polls for
/// cancellation: at the begin of each stage and, from its loops (ProgressLoop), up to 20 times a
/// second; less often if the callbacks are slow, so that they take a tenth of the run.
///
/// Progress is estimated from the shares of the stages in typical runs. Steps within a stage may be
/// announced. The loop after a step moves evenly through it; any other loop takes half of the rest
/// of its stage.
class RunMonitor
{
public:
  /// \param statistics receives the times; must outlive the monitor
  /// \param is_disc    the mesh is made as a disc, whose stages take other shares of the run
  RunMonitor (Callbacks callbacks, Statistics& statistics, bool is_disc = false);
  ~RunMonitor () { stopClock (); }
  RunMonitor (const RunMonitor&) = delete; // a copy would count the time twice
  RunMonitor& operator= (const RunMonitor&) = delete;

  /// A stage begins. Its share of the progress includes the shares of skipped stages. Does nothing
  /// if the stage is running already.
  /// \throws Cancelled
  void beginStage (Stage stage);

  /// Begins a step of the stage, which ends at the fraction `until` of the stage. One loop is to
  /// run through it.
  /// \throws Cancelled
  void beginStep (double until);

  /// Ends the stage; the following time is not counted.
  void stopClock ();

  /// Least time between two polls within a stage. Only tests change it.
  static inline std::chrono::milliseconds between_polls{50};

  /// Polls for cancellation if the last poll is long enough ago.
  /// \throws Cancelled
  void pollNowAndThen ();

  /// Reports the end of a successful run: progress 1.
  void finish ();

  /// Threads for the loops of the run.
  HelperThreads& helpers () { return helpers_; }

  /// Whether there are callbacks for events within stages.
  bool isWatched () const { return is_watched_; }

private:
  friend class ProgressLoop;
  using Clock = std::chrono::steady_clock;

  bool isOwnThread () const { return std::this_thread::get_id () == owner_; }
  void poll ();

  QuietNumbers quiet_; // of the run
  Callbacks callbacks_;
  Statistics& statistics_;
  std::thread::id owner_ = std::this_thread::get_id ();
  bool is_watched_, is_disc_;
  std::atomic<bool> is_cancelled_{false};
  Stage stage_ = Stage::COUNT; // running stage; COUNT: none
  Clock::time_point stage_start_, last_poll_, next_poll_;
  std::size_t next_stage_ = 0; // after the running one
  bool is_in_loop_ = false;
  bool has_step_ = false; // announced, but no loop has run through it yet
  double done_ = 0.0;     // fraction of the whole run, like all below
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

  /// Threads that are kept between loops; nullptr without a monitor.
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
  void poll () const
  {
    if (monitor_ != nullptr && monitor_->isWatched ())
      monitor_->pollNowAndThen ();
  }

  /// A context for stages within the running stage. They are not reported to the caller, and their
  /// time belongs to the running stage. They can be cancelled.
  RunContext withinStage () const
  {
    RunContext context = *this;
    context.is_within_stage_ = true;
    return context;
  }

private:
  friend class ProgressLoop;

  int threads_;
  RunMonitor* monitor_;
  bool is_within_stage_ = false;
};

/// A loop that reports progress and can be cancelled. Make one before the loop; call next () for
/// each item, or reach () where progress is known otherwise. In nested loops only the outermost
/// reports progress; all can be cancelled. A few ns per item.
///
/// Helper threads may use it as well. They report no progress; if the run is cancelled, they
/// unwind.
class ProgressLoop
{
public:
  /// \param items expected number; 0: unknown, no progress is reported
  explicit ProgressLoop (const RunContext& run, std::size_t items = 0);
  ~ProgressLoop ();
  ProgressLoop (const ProgressLoop&) = delete;
  ProgressLoop& operator= (const ProgressLoop&) = delete;

  /// Counts one item. Polls at every 256th, which take less than a tenth of a second.
  /// \throws Cancelled
  void next ()
  {
    if (++count_ % ITEMS_PER_POLL == 0)
      reach (count_);
  }

  /// Sets the number of items done. For loops of few and large items.
  /// \throws Cancelled
  void reach (std::size_t count);

private:
  static constexpr std::size_t ITEMS_PER_POLL = 256;

  RunMonitor* monitor_; // nullptr without callbacks
  std::size_t items_;
  std::size_t count_ = 0;
  bool moves_ = false; // the outermost loop of the run's own thread
};

} // namespace pcl::floater

// SPDX-License-Identifier: GPL-3.0-or-later
// How far a run is, told to its caller, who may stop it.
#pragma once

#include <pcl/surface/floater/options.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <thread>

namespace pcl
{
namespace floater
{
/// Unwinds a run that its caller has stopped. No std::exception, so that nothing on the way takes
/// it for a failure of its own.
struct Cancelled
{
};

/// Tells Options::advance how far a run is, and asks Options::cancelled whether to go on: at the
/// begin of every stage and, from the loops in it (MonitoredLoop), up to 20 times a second.
///
/// Stages do not hand it on. It belongs to the thread that made it, for as long as it lives; what
/// that thread calls finds it by itself, and does without where there is none, as in most tests.
/// Threads that help in a loop (Monitor::Helper) do not call back; they see a stop and unwind.
///
/// The fraction done is known by stage, from their shares in a typical run of the method. In a
/// stage, steps may be announced; a loop in a step of its own goes through it evenly, and any other
/// loop takes half of what is left of its stage.
class Monitor
{
public:
  explicit Monitor (const Options& options);
  ~Monitor ();
  Monitor (const Monitor&) = delete;
  Monitor& operator= (const Monitor&) = delete;
  Monitor (Monitor&&) = delete;
  Monitor& operator= (Monitor&&) = delete;

  /// That of this thread, or nullptr.
  static Monitor* current ();

  /// The method that makes the mesh from here on; SURFACE to begin with.
  void setMethod (Topology method) { is_disc_ = method == Topology::DISC; }

  /// A stage begins; what is left of the run is shared out to it, with those left out before it,
  /// and to those after it. Within a loop, where a part of the cloud goes through all stages, only
  /// asks. \throws Cancelled
  void enterStage (Stage stage);

  /// A part of the stage begins, which ends when `until` of the stage is done, 0 to 1. One loop is
  /// to go through it. \throws Cancelled
  void enterStep (double until);

  /// Asks at once. \throws Cancelled
  void poll ();

  /// Asks that of this thread, if there is one and the time has come. \throws Cancelled
  static void look ()
  {
    if (Monitor* monitor = current ())
      monitor->pollNowAndThen ();
  }

  /// The run has ended well: tells that all is done.
  void finish ();

  /// In the scope of one of these a helping thread takes part in the run of another thread.
  class Helper
  {
  public:
    explicit Helper (Monitor* monitor);
    ~Helper ();
    Helper (const Helper&) = delete;
    Helper& operator= (const Helper&) = delete;
    Helper (Helper&&) = delete;
    Helper& operator= (Helper&&) = delete;
  };

private:
  friend class MonitoredLoop;
  using Clock = std::chrono::steady_clock;

  bool isMine () const { return std::this_thread::get_id () == owner_; }
  void pollNowAndThen ();
  void tell ();

  const Options& options_;
  Monitor* outer_; // of this thread, before this one
  std::thread::id owner_ = std::this_thread::get_id ();
  std::atomic<bool> is_stopped_{false};
  Clock::time_point last_poll_;
  bool is_disc_ = false;
  std::size_t next_stage_ = 0; // after the one at hand
  bool is_in_loop_ = false;
  bool has_step_ = false; // announced, and no loop has gone through it yet
  double done_ = 0.0;     // of the whole run, as all below
  double stage_begin_ = 0.0, stage_end_ = 0.0;
  double step_begin_ = 0.0, step_end_ = 0.0;
};

/// A loop that moves the fraction done, and may be stopped: make one before the loop, call next ()
/// once for each item, or reach () where it is known how far the loop is. Of loops within loops the
/// outermost moves the fraction; all may be stopped. A few ns per item.
class MonitoredLoop
{
public:
  /// \param items how many there will be; 0: not known, the fraction does not move
  explicit MonitoredLoop (std::size_t items = 0);
  ~MonitoredLoop ();
  MonitoredLoop (const MonitoredLoop&) = delete;
  MonitoredLoop& operator= (const MonitoredLoop&) = delete;
  MonitoredLoop (MonitoredLoop&&) = delete;
  MonitoredLoop& operator= (MonitoredLoop&&) = delete;

  /// One more item. Every 256th time asks whether to go on; that many take no tenth of a second.
  /// \throws Cancelled
  void next ()
  {
    if (++count_ % ITEMS_PER_LOOK == 0)
      reach (count_);
  }

  /// So many items are done. For loops of few and large items. \throws Cancelled
  void reach (std::size_t count);

private:
  static constexpr std::size_t ITEMS_PER_LOOK = 256;

  Monitor* monitor_;
  std::size_t items_;
  std::size_t count_ = 0;
  bool moves_ = false; // is the outermost loop of the monitor's own thread
};

} // namespace floater
} // namespace pcl

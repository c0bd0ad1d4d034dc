// SPDX-License-Identifier: GPL-3.0-or-later
// Wall time by stage.
#pragma once

#include "common/monitor.h"

#include <pcl/surface/floater/report.h>

#include <chrono>

namespace pcl
{
namespace floater
{
/// Books the time since the last start to the stage that was running, and tells the user's callback
/// and the monitor of the run, if there is one, which stage begins.
class StageClock
{
public:
  StageClock (Statistics& statistics, const std::function<void (Stage)>& progress)
      : statistics_ (statistics), progress_ (progress)
  {
  }
  StageClock (const StageClock&) = delete;
  StageClock& operator= (const StageClock&) = delete;
  ~StageClock () { stop (); }

  void start (Stage stage)
  {
    if (stage == stage_)
      return; // goes on
    stop ();
    if (progress_)
      progress_ (stage);
    if (Monitor* monitor = Monitor::current ())
      monitor->enterStage (stage);
    stage_ = stage;
    begin_ = Clock::now ();
  }

  /// Tells the monitor which method makes the mesh from here on (Monitor::setMethod).
  static void setMethod (Topology method)
  {
    if (Monitor* monitor = Monitor::current ())
      monitor->setMethod (method);
  }

  /// Announces a step of the stage to the monitor (Monitor::enterStep).
  static void step (double until)
  {
    if (Monitor* monitor = Monitor::current ())
      monitor->enterStep (until);
  }

  void stop ()
  {
    if (stage_ == Stage::COUNT)
      return;
    const double seconds = std::chrono::duration<double> (Clock::now () - begin_).count ();
    statistics_.seconds[static_cast<std::size_t> (stage_)] += seconds;
    statistics_.total_seconds += seconds;
    stage_ = Stage::COUNT;
  }

private:
  using Clock = std::chrono::steady_clock;
  Statistics& statistics_;
  const std::function<void (Stage)>& progress_;
  Stage stage_ = Stage::COUNT;
  Clock::time_point begin_;
};

} // namespace floater
} // namespace pcl

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Waits for the monitor of a run, which asks only now and then.
#pragma once

#include "core/run_context.h"

#include <thread>

namespace pcl::floater::samples {
/// Returns when every monitor that has asked by now would ask again. A monitor of its own tells, so
/// that nothing is assumed of the time between two questions.
inline void
waitUntilAPollIsDue ()
{
  int questions = 0;
  Statistics statistics;
  RunMonitor monitor ({{},
                       {},
                       [&questions] {
                         ++questions;
                         return false;
                       }},
                      statistics);
  monitor.beginStage (Stage::WORKING_SET); // asks
  while (questions < 2) {
    std::this_thread::yield ();
    monitor.pollNowAndThen ();
  }
}

} // namespace pcl::floater::samples

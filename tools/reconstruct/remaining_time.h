// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Estimate of the time that a run still takes.
#pragma once

#include <cmath>
#include <string>

namespace pcl::floater {
/// The time that a run still takes, "34 %, 12 s left", if it goes on as it began; empty at the
/// beginning, when that says little, and of runs that end soon.
inline std::string
remainingTime (double seconds, double fraction)
{
  constexpr double FIRST = 1.5, LEAST = 0.02; // seconds, fraction of the run
  if (seconds < FIRST || fraction < LEAST)
    return "";
  constexpr double PERCENT = 100.0, MINUTE = 60.0, LONG = 100.0;
  const auto whole = [] (double number) { return std::to_string (std::lround (number)); };
  const double left = seconds / fraction - seconds;
  return whole (std::floor (PERCENT * fraction)) + " %, " +
         (left < LONG ? whole (std::ceil (left)) + " s" : whole (left / MINUTE) + " min") + " left";
}

} // namespace pcl::floater

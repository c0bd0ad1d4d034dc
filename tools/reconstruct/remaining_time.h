// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Estimate of the time that a run still takes.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace pcl::floater {
/// Estimates the time left from the time passed and the fraction done. The estimate is smoothed,
/// because the fraction does not grow evenly.
class RemainingTime
{
public:
  /// Adds a measurement. Neither number may decrease from one call to the next.
  void update (double seconds, double fraction)
  {
    if (fraction <= 0.0)
      return;
    const double now = seconds / fraction;
    const double weight = left () ? 1.0 - std::exp ((seconds_ - seconds) / SMOOTHING) : 1.0;
    total_ += weight * (now - total_);
    seconds_ = seconds;
    fraction_ = fraction;
  }

  /// Seconds left; nothing at the beginning of a run.
  std::optional<double> left () const
  {
    if (seconds_ < FIRST || fraction_ < LEAST)
      return std::nullopt;
    return std::max (0.0, total_ - seconds_);
  }

  /// "34 %, 12 s left"; empty if left () is nothing.
  std::string text () const
  {
    const std::optional<double> seconds = left ();
    if (!seconds)
      return "";
    constexpr double PERCENT = 100.0, MINUTE = 60.0, LONG = 100.0;
    const auto whole = [] (double number) { return std::to_string (std::lround (number)); };
    return whole (std::floor (PERCENT * fraction_)) + " %, " +
           (*seconds < LONG ? whole (std::ceil (*seconds)) + " s"
                            : whole (*seconds / MINUTE) + " min") +
           " left";
  }

private:
  static constexpr double SMOOTHING =
      3.0; // seconds after which an old estimate has lost most of its weight
  static constexpr double FIRST = 1.5;  // seconds; a run that ends before needs no estimate
  static constexpr double LEAST = 0.02; // fraction of the run; before, an estimate is unreliable

  double seconds_ = 0.0, fraction_ = 0.0;
  double total_ = 0.0; // estimated seconds of the whole run
};

} // namespace pcl::floater

// SPDX-License-Identifier: GPL-3.0-or-later
// How long a run will still take.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace pcl
{
namespace floater
{
/// Estimates the time that is left from the time that has passed and the share that is done,
/// smoothed, since stages do not take their shares exactly.
class RemainingTime
{
public:
  /// To be told every now and then. Both must not decrease.
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

  /// Seconds left; nothing in the first moments and of a run that will soon be over.
  std::optional<double> left () const
  {
    if (seconds_ < FIRST || fraction_ < LEAST)
      return std::nullopt;
    return std::max (0.0, total_ - seconds_);
  }

  /// "34 %, 12 s left", or nothing as above.
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
  static constexpr double SMOOTHING = 3.0; // seconds in which most of an old estimate is forgotten
  static constexpr double FIRST = 1.5;     // seconds; before, there is nothing to wait for
  static constexpr double LEAST = 0.02;    // of the run; before, an estimate is a guess

  double seconds_ = 0.0, fraction_ = 0.0;
  double total_ = 0.0; // seconds of the whole run, estimated
};

} // namespace floater
} // namespace pcl

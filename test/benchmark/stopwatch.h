// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Wall time.
#pragma once

#include <chrono>

namespace pcl
{
namespace floater
{
/// Runs from its construction.
class Stopwatch
{
public:
  double seconds () const
  {
    return std::chrono::duration<double> (std::chrono::steady_clock::now () - start_).count ();
  }

private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now ();
};

} // namespace floater
} // namespace pcl

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Random numbers that are the same with every standard library, unlike its distributions.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace pcl::floater {
class RandomStream
{
public:
  explicit RandomStream (std::uint64_t seed) : engine_ (seed) {}

  /// Uniformly distributed in [0, 1).
  double uniform () { return static_cast<double> (engine_ () >> 11) * 0x1.0p-53; }

  /// An integer, uniformly distributed in [0, n); n far below 2^53.
  std::size_t below (std::size_t n)
  {
    return static_cast<std::size_t> (uniform () * static_cast<double> (n));
  }

  /// Normally distributed with mean 0 and standard deviation 1 (Box and Muller).
  double normal ()
  {
    const double radius = std::sqrt (-2.0 * std::log1p (-uniform ()));
    return radius * std::cos (2.0 * 3.14159265358979323846 * uniform ());
  }

private:
  std::mt19937_64 engine_;
};

} // namespace pcl::floater

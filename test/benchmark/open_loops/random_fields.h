// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Random numbers and fields that shapes and samplings are made of.
#pragma once

#include "core/geometry.h"
#include "random_stream.h"

#include <Eigen/Core>

#include <cmath>
#include <functional>
#include <vector>

namespace pcl
{
namespace floater
{
using Place = Eigen::Vector2d; ///< in the plane of the parameters
using Map = std::function<Eigen::Vector3d (const Place&)>;
using Field = std::function<double (const Place&)>;

/// Evenly distributed.
inline double
between (RandomStream& random, double low, double high)
{
  return low + (high - low) * random.uniform ();
}

/// Evenly distributed in the logarithm.
inline double
logBetween (RandomStream& random, double low, double high)
{
  return low * std::pow (high / low, random.uniform ());
}

/// A sum of waves in random directions, of variance 1.
inline Field
waves (RandomStream& random, double shortest, double longest)
{
  struct Wave
  {
    Place number;
    double phase;
  };
  std::vector<Wave> all;
  for (int i = 0; i < 6; ++i) {
    const double direction = 2.0 * PI * random.uniform ();
    const double number = 2.0 * PI / logBetween (random, shortest, longest);
    all.push_back ({{number * std::cos (direction), number * std::sin (direction)},
                    2.0 * PI * random.uniform ()});
  }
  return [all] (const Place& p) {
    double sum = 0.0;
    for (const Wave& wave : all)
      sum += std::cos (wave.number.dot (p) + wave.phase);
    return sum / std::sqrt (0.5 * static_cast<double> (all.size ()));
  };
}

} // namespace floater
} // namespace pcl

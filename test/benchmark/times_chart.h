// SPDX-License-Identifier: GPL-3.0-or-later
// Time against number of points, both logarithmic.
#pragma once

#include <string>
#include <vector>

namespace pcl
{
namespace floater
{
/// A stage and its seconds, parallel to the numbers of points.
struct TimeSeries
{
  std::string name;
  std::vector<double> seconds;
};

/// The power law c N^p nearest to the times, by least squares of the logarithms.
struct PowerLaw
{
  double factor = 0.0;
  double exponent = 0.0;

  double operator() (double points) const;
};

/// \param points at least two different ones; seconds positive
PowerLaw
fitPowerLaw (const std::vector<double>& points, const std::vector<double>& seconds);

/// Marks for the times, lines for their power laws. Needs an X display.
/// \return the picture as a PNG file
std::vector<unsigned char>
drawTimes (const std::vector<double>& points, const std::vector<TimeSeries>& series);

} // namespace floater
} // namespace pcl

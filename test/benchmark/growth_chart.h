// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Time or memory against number of points, both logarithmic.
#pragma once

#include <string>
#include <vector>

namespace pcl
{
namespace floater
{
/// What is measured at some numbers of points: seconds of a stage, bytes of a method.
struct GrowthSeries
{
  std::string name;
  std::vector<double> points;
  std::vector<double> values; ///< positive; parallel to the numbers of points
};

/// The power law c N^p nearest to the values, by least squares of the logarithms.
struct PowerLaw
{
  double factor = 0.0;
  double exponent = 0.0;

  double operator() (double points) const;
};

/// \param series of at least two different numbers of points
PowerLaw
fitPowerLaw (const GrowthSeries& series);

/// Whether a power law can be fitted: at least two different numbers of points, all values
/// positive.
bool
hasPowerLaw (const GrowthSeries& series);

/// Marks for the values, lines for their power laws. Needs an X display.
/// \param series at least one; all have power laws
/// \param quantity what the values are, with its unit
/// \return the picture as a PNG file
std::vector<unsigned char>
drawGrowth (const std::vector<GrowthSeries>& series, const std::string& quantity);

} // namespace floater
} // namespace pcl

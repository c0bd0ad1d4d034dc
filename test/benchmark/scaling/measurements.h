// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What scaling.sh measured: runs from its CSV file, and the curves that they form.
#pragma once

#include "growth_chart.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace pcl
{
namespace floater
{
/// Figures of one run, or the medians of several; by the names of their columns ("seconds").
struct Figures
{
  std::vector<std::string> names;
  std::vector<double> values; ///< parallel to the names

  /// 0 if there is no such figure.
  double operator[] (const std::string& name) const;

  void set (const std::string& name, double value);
};

/// One method on one cloud.
struct Measurement
{
  std::string surface; ///< clouds that belong to one curve
  std::string cloud;
  std::string method;
  double points = 0.0;
  std::string outcome; ///< "ok", or the first of its runs that was something else
  Figures figures;     ///< medians over the runs that ended well
  Figures stages;      ///< the same: seconds by stage
  std::size_t runs = 0;
};

/// Reads the file and joins repeated runs. In order of the file.
/// \throw std::runtime_error that names the file if it cannot be read or understood
std::vector<Measurement>
readMeasurements (const std::filesystem::path& path);

/// What all of these measurements have in common, in order of first appearance.
std::vector<std::string>
namesOf (const std::vector<Measurement>& measurements, std::string Measurement::*name);

/// The measurements of this name, in order.
std::vector<Measurement>
select (const std::vector<Measurement>& measurements, std::string Measurement::*name,
        const std::string& value);

/// Values against points, of the measurements that ended well and are of one curve.
GrowthSeries
seriesOf (const std::string& name, const std::vector<Measurement>& measurements,
          const std::function<double (const Measurement&)>& value);

} // namespace floater
} // namespace pcl

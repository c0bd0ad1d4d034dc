// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shift.h"

#include "points/outliers.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

namespace pcl::floater {
Eigen::Vector3d
chooseShift (const std::vector<Eigen::Vector3d>& positions, int threads)
{
  constexpr double FINE = 0.01; // spacings
  const GrossOutliers outliers = findGrossOutliers (positions, threads);
  std::vector<bool> is_outlier (positions.size (), false);
  for (const std::vector<Index>* rows : {&outliers.isolated, &outliers.unbearable})
    for (const Index row : *rows)
      is_outlier[row] = true;
  Eigen::AlignedBox3d box;
  std::size_t count = 0;
  for (std::size_t row = 0; row < positions.size (); ++row)
    if (positions[row].allFinite () && !is_outlier[row]) {
      box.extend (positions[row]);
      ++count;
    }
  const double diagonal = box.isEmpty () ? 0.0 : box.diagonal ().stableNorm ();
  if (!(diagonal > 0.0 && std::isfinite (diagonal)))
    return Eigen::Vector3d::Zero ();
  const double largest =
      std::max (box.min ().cwiseAbs ().maxCoeff (), box.max ().cwiseAbs ().maxCoeff ());
  const double float_step = largest * static_cast<double> (std::numeric_limits<float>::epsilon ());
  if (float_step < FINE * diagonal / std::sqrt (static_cast<double> (count)))
    return Eigen::Vector3d::Zero ();
  const double unit = std::pow (10.0, std::floor (std::log10 (diagonal)));
  return unit * (box.center () / unit).array ().round ().matrix ();
}

} // namespace pcl::floater

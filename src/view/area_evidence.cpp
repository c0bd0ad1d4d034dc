// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/area_evidence.h"

#include "core/order_statistics.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl
{
namespace floater
{
std::vector<AreaSample>
takeAreaSamples (const Points& points, const LocalGeometry& geometry, std::size_t count)
{
  const std::vector<Eigen::Vector3d>& positions = points.positions;
  const Stars& stars = geometry.stars;
  std::vector<AreaSample> samples;
  // Every second place is spare: open stars have no area.
  const std::size_t step = std::max<std::size_t> (1, positions.size () / (2 * count));
  for (std::size_t p = step / 2; p < positions.size () && samples.size () < 2 * count; p += step) {
    if (stars.open[p] != 0)
      continue;
    const Row star = stars.neighbors.row (p);
    double area = 0.0;
    for (std::size_t i = 0; i < star.size (); ++i)
      area += (positions[star[i]] - positions[p])
                  .cross (positions[star[(i + 1) % star.size ()]] - positions[p])
                  .norm ();
    if (area > 0.0)
      samples.push_back ({positions[p], stars.normals[p].cast<double> (), area});
  }
  return samples;
}

double
quartileSpread (std::vector<double>& values)
{
  const double upper = quantile (values, 0.75);
  return std::log (upper / quantile (values, 0.25));
}

double
areaSpread (const std::vector<AreaSample>& samples, const Viewpoint& viewpoint,
            std::vector<double>& angles)
{
  // Of points at grazing rays, normal and area are too uncertain to tell a smaller cosine.
  constexpr double LEAST_COSINE = 0.02;
  angles.clear ();
  for (const AreaSample& sample : samples) {
    const Eigen::Vector3d ray =
        viewpoint.is_far ? viewpoint.place : Eigen::Vector3d (sample.position - viewpoint.place);
    const double sqr_distance = ray.squaredNorm ();
    const double cosine = std::abs (sample.normal.dot (ray)) / std::sqrt (sqr_distance);
    angles.push_back (sample.area * std::max (cosine, LEAST_COSINE) / sqr_distance);
  }
  return quartileSpread (angles);
}

} // namespace floater
} // namespace pcl

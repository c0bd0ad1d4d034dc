// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/area_samples.h"

#include "core/geometry.h"
#include "core/order_statistics.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl::floater {
std::vector<RayPatch>
findPointPatches (const std::vector<Eigen::Vector3d>& positions, const RowOf& row_of,
                  std::size_t count, std::size_t size)
{
  std::vector<RayPatch> patches (count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t seed = (2 * k + 1) * positions.size () / (2 * count);
    RayPatch& patch = patches[k];
    patch.assign (1, static_cast<Index> (seed));
    for (std::size_t i = 0; i < patch.size () && patch.size () < size; ++i)
      for (const Index q : row_of (patch[i]))
        if (patch.size () < size && std::find (patch.begin (), patch.end (), q) == patch.end ())
          patch.push_back (q);
    const auto distance = [&] (Index p) { return (positions[p] - positions[seed]).squaredNorm (); };
    std::stable_sort (patch.begin (), patch.end (),
                      [&] (Index a, Index b) { return distance (a) < distance (b); });
  }
  return patches;
}

std::vector<AreaSample>
takePatchSamples (const std::vector<Eigen::Vector3d>& positions, const RowOf& row_of,
                  std::size_t count)
{
  constexpr std::size_t SIZE = 60; // points; noise of a spacing is a quarter of their radius
  std::vector<AreaSample> samples;
  for (const RayPatch& patch : findPointPatches (positions, row_of, count, SIZE)) {
    PlaneFit fit;
    for (const Index p : patch)
      fit.add (positions[p]);
    const Plane plane = fit.plane ();
    double squares = 0.0; // along the plane, from the centre
    for (const Index p : patch) {
      const double height = plane.height (positions[p]);
      squares += (positions[p] - plane.centre).squaredNorm () - height * height;
    }
    // That of an ellipse, up to a factor.
    const double area = squares * std::sqrt (plane.aspect) / (1.0 + plane.aspect);
    if (area > 0.0)
      samples.push_back ({plane.centre, plane.normal, area});
  }
  return samples;
}

double
quartileSpread (std::vector<double>& values)
{
  const auto [lower, upper] = valuesAtRanks (values, values.size () / 4, values.size () * 3 / 4);
  return std::log (upper / lower);
}

double
areaSpread (const std::vector<AreaSample>& samples, const Viewpoint& viewpoint,
            std::vector<double>& angles)
{
  // At grazing rays, normal and area are too uncertain for smaller cosines.
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

} // namespace pcl::floater

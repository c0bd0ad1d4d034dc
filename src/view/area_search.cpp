// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/area_search.h"

#include "core/geometry.h"
#include "core/order_statistics.h"
#include "core/parallel.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace pcl::floater {
double
spreadOfAreas (const std::vector<AreaSample>& samples)
{
  std::vector<double> areas;
  areas.reserve (samples.size ());
  for (const AreaSample& sample : samples)
    areas.push_back (sample.area);
  return quartileSpread (areas);
}

namespace {
// Half of the samples, along each axis.
Eigen::AlignedBox3d
middleBox (const std::vector<AreaSample>& samples)
{
  Eigen::AlignedBox3d box;
  box.setEmpty ();
  std::vector<double> values (samples.size ());
  for (const double share : {0.25, 0.75}) {
    Eigen::Vector3d corner;
    for (int axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < samples.size (); ++i)
        values[i] = samples[i].position[axis];
      corner[axis] = quantile (values, share);
    }
    box.extend (corner);
  }
  return box;
}

// The middles of the cells of a grid over twice a box.
void
addGrid (const Eigen::AlignedBox3d& box, std::size_t n, std::vector<RatedViewpoint>& places)
{
  const auto cells = static_cast<double> (n);
  for (std::size_t i = 0; i < n * n * n; ++i) {
    const std::size_t column = i / n % n, layer = i / (n * n);
    const Eigen::Array3d cell (static_cast<double> (i % n), static_cast<double> (column),
                               static_cast<double> (layer));
    const Eigen::Vector3d offset = (2.0 * (cell + 0.5) / cells - 1.0).matrix ();
    places.push_back ({0.0, {box.center () + offset.cwiseProduct (box.sizes ()), false}});
  }
}

// Viewpoints on grids over the boxes of all and of half of the samples, and far ones, the best ones first.
std::vector<RatedViewpoint>
startingPlaces (const std::vector<AreaSample>& samples, const Eigen::AlignedBox3d& box,
                const Eigen::AlignedBox3d& middle, bool may_be_far, const AreaSearchLimits& limits,
                const RunContext& run)
{
  std::vector<RatedViewpoint> places;
  addGrid (box, limits.cells, places);
  addGrid (middle, limits.cells, places);
  // On spheres around the box, the last of infinite radius.
  for (std::size_t i = 0; i < limits.directions; ++i) {
    const Eigen::Vector3d direction = spiralDirection (i, limits.directions);
    for (const double distance : {1.5, 3.0, 6.0})
      places.push_back (
          {0.0, {box.center () + distance * box.sizes ().norm () * direction, false}});
    if (may_be_far)
      places.push_back ({0.0, {direction, true}});
  }
  parallelRanges (run, places.size (), [&] (std::size_t first, std::size_t last) {
    std::vector<double> angles;
    for (std::size_t i = first; i < last; ++i)
      places[i].cost = areaSpread (samples, places[i].viewpoint, angles);
  });
  std::stable_sort (places.begin (), places.end (), isCheaper);
  return places;
}

} // namespace

std::vector<RatedViewpoint>
searchByAreas (const std::vector<AreaSample>& samples, const Eigen::AlignedBox3d& box,
               bool may_be_far, const AreaSearchLimits& limits, const RunContext& run)
{
  constexpr double SMALLEST_STEP = 4e-3;
  constexpr double NEARER = 0.9; // of the spread of areas from far away
  // A quarter of the samples gives the spread to twice the error.
  constexpr std::size_t EVERY = 4;
  constexpr double ERROR = 0.12;
  std::vector<AreaSample> few;
  for (std::size_t i = 0; i < samples.size (); i += EVERY)
    few.push_back (samples[i]);
  std::vector<RatedViewpoint> places =
      startingPlaces (few, box, middleBox (samples), may_be_far, limits, run);
  if (places.front ().cost > (1.0 + ERROR) * limits.explained * spreadOfAreas (few))
    return {};
  const double cell = 2.0 * box.sizes ().maxCoeff () / static_cast<double> (limits.cells);
  places = keepApart (places, 2.0 * cell, limits.starts);
  parallelTasks (run, places.size (), [&] (std::size_t k) {
    std::vector<double> angles;
    const auto cost = [&] (const Viewpoint& v) { return areaSpread (samples, v, angles); };
    places[k] = patternSearch (places[k].viewpoint, cell, SMALLEST_STEP, box.center (),
                               limits.evaluations, cost);
  });
  places = keepApart (places, 4.0 * SMALLEST_STEP, places.size ());
  std::stable_sort (places.begin (), places.end (), isCheaper);
  const double spread = spreadOfAreas (samples);
  if (places.front ().cost > limits.explained * spread)
    return {};
  const double most = spread - limits.as_good * (spread - places.front ().cost);
  const auto isWorse = [&] (const RatedViewpoint& one) {
    std::vector<double> angles;
    return one.cost > most ||
           // A raster of heights is as even from far away.
           (!may_be_far &&
            one.cost >
                NEARER * areaSpread (samples, farFrom (one.viewpoint, box.center ()), angles));
  };
  places.erase (std::remove_if (places.begin (), places.end (), isWorse), places.end ());
  return places;
}

} // namespace pcl::floater

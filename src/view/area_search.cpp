// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/area_search.h"

#include "core/geometry.h"
#include "core/order_statistics.h"
#include "core/parallel.h"

namespace pcl::floater {
namespace {
// Cells along each axis of a grid of viewpoints over twice the bounding box, and of one over twice
// the box of half of the samples: points are dense around a sensor low above wide ground.
constexpr std::size_t CELLS = 12;

// Logarithm of the ratio of the upper to the lower quartile.
// \param[in,out] values at least one, all positive; their order changes
double
quartileSpread (std::vector<double>& values)
{
  const auto [lower, upper] = valuesAtRanks (values, values.size () / 4, values.size () * 3 / 4);
  return std::log (upper / lower);
}

// Spread of the solid angles of the samples from a viewpoint (see findViewpoint).
// \param angles scratch, one for each sample
double
areaSpread (const std::vector<AreaSample>& samples, const Viewpoint& viewpoint,
            std::vector<double>& angles)
{
  // At grazing rays, normal and area are too uncertain for smaller cosines.
  constexpr double LEAST_COSINE = 0.02;
  angles.clear ();
  for (const AreaSample& sample : samples) {
    const Vector3d ray =
        viewpoint.is_far ? viewpoint.place : Vector3d (sample.position - viewpoint.place);
    const double sqr_distance = ray.squaredNorm ();
    const double cosine = std::abs (sample.normal.dot (ray)) / std::sqrt (sqr_distance);
    angles.push_back (sample.area * std::max (cosine, LEAST_COSINE) / sqr_distance);
  }
  return quartileSpread (angles);
}

// Half of the samples, along each axis.
Eigen::AlignedBox3d
middleBox (const std::vector<AreaSample>& samples)
{
  Eigen::AlignedBox3d box;
  std::vector<double> values (samples.size ());
  for (const double share : {0.25, 0.75}) {
    Vector3d corner;
    for (int axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < samples.size (); ++i)
        values[i] = samples[i].position[axis];
      corner[axis] = quantile (values, share);
    }
    box.extend (corner);
  }
  return box;
}

// Viewpoints on grids over the boxes of all and of half of the samples, and far ones, the best ones first.
std::vector<RatedViewpoint>
startingPlaces (const std::vector<AreaSample>& samples, const Eigen::AlignedBox3d& box,
                const Eigen::AlignedBox3d& middle, bool may_be_far, const RunContext& run)
{
  constexpr std::size_t DIRECTIONS = 100; // of farther viewpoints: 20 degrees apart
  std::vector<RatedViewpoint> places;
  // The middles of the cells of grids over twice the boxes.
  for (const Eigen::AlignedBox3d& one : {box, middle})
    for (std::size_t i = 0; i < CELLS * CELLS * CELLS; ++i) {
      const std::size_t column = i / CELLS % CELLS, layer = i / (CELLS * CELLS);
      const Eigen::Array3d cell (i % CELLS, column, layer);
      const Vector3d offset = (2.0 * (cell + 0.5) / static_cast<double> (CELLS) - 1.0).matrix ();
      places.push_back ({0.0, {one.center () + offset.cwiseProduct (one.sizes ()), false}});
    }
  // On spheres around the box, the last of infinite radius.
  for (std::size_t i = 0; i < DIRECTIONS; ++i) {
    const Vector3d direction = spiralDirection (i, DIRECTIONS);
    for (const double distance : {1.5, 3.0, 6.0})
      places.push_back (
          {0.0, {box.center () + distance * box.sizes ().norm () * direction, false}});
    if (may_be_far)
      places.push_back ({0.0, {direction, true}});
  }
  parallelPoints<std::vector<double>> (run, places.size (), [&] (Index i, auto& angles) {
    places[i].cost = areaSpread (samples, places[i].viewpoint, angles);
  });
  std::stable_sort (places.begin (), places.end ());
  return places;
}

} // namespace

std::vector<RayPatch>
findPointPatches (const Positions& positions, const RowOf& row_of, std::size_t count)
{
  std::vector<RayPatch> patches (count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t seed = (2 * k + 1) * positions.size () / (2 * count);
    RayPatch& patch = patches[k];
    patch.assign (1, static_cast<Index> (seed));
    for (std::size_t i = 0; i < patch.size () && patch.size () < PATCH_POINTS; ++i)
      for (const Index q : row_of (patch[i]))
        if (patch.size () < PATCH_POINTS &&
            std::find (patch.begin (), patch.end (), q) == patch.end ())
          patch.push_back (q);
    const auto distance = [&] (Index p) { return (positions[p] - positions[seed]).squaredNorm (); };
    std::stable_sort (patch.begin (), patch.end (),
                      [&] (Index a, Index b) { return distance (a) < distance (b); });
  }
  return patches;
}

std::vector<AreaSample>
takePatchSamples (const Positions& positions, const RowOf& row_of)
{
  std::vector<AreaSample> samples;
  for (const RayPatch& patch : findPointPatches (positions, row_of, AREA_SAMPLES)) {
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
spreadOfAreas (const std::vector<AreaSample>& samples)
{
  std::vector<double> areas;
  areas.reserve (samples.size ());
  for (const AreaSample& sample : samples)
    areas.push_back (sample.area);
  return quartileSpread (areas);
}

std::vector<RatedViewpoint>
searchByAreas (const std::vector<AreaSample>& samples, const Eigen::AlignedBox3d& box,
               bool may_be_far, const RunContext& run)
{
  // Largest share of the spread of the areas left at the best viewpoint; with more, areas do not
  // come from a view. In scans with noise of 3 spacings, 0.7 is left.
  constexpr double EXPLAINED = 0.8;
  // Share of what the best viewpoint explains, for others to count: on a plane, many explain it.
  constexpr double AS_GOOD = 0.75;
  constexpr std::size_t STARTS = 24;       // best viewpoints, from which descents start
  constexpr std::size_t EVALUATIONS = 200; // in each descent
  constexpr double SMALLEST_STEP = 4e-3;
  constexpr double NEARER = 0.9;   // of the spread of areas from far away
  constexpr std::size_t EVERY = 4; // sample, at first: they give the spread to twice the error
  constexpr double ERROR = 0.12;
  std::vector<AreaSample> few;
  for (std::size_t i = 0; i < samples.size (); i += EVERY)
    few.push_back (samples[i]);
  std::vector<RatedViewpoint> places =
      startingPlaces (few, box, middleBox (samples), may_be_far, run);
  if (places.front ().cost > (1.0 + ERROR) * EXPLAINED * spreadOfAreas (few))
    return {};
  const double cell = 2.0 * box.sizes ().maxCoeff () / static_cast<double> (CELLS);
  places = keepApart (places, 2.0 * cell, STARTS);
  parallelTasks (run, places.size (), [&] (std::size_t k) {
    std::vector<double> angles;
    const auto cost = [&] (const Viewpoint& v) { return areaSpread (samples, v, angles); };
    places[k] =
        patternSearch (places[k].viewpoint, cell, SMALLEST_STEP, box.center (), EVALUATIONS, cost);
  });
  places = keepApart (places, 4.0 * SMALLEST_STEP, places.size ());
  std::stable_sort (places.begin (), places.end ());
  const double spread = spreadOfAreas (samples);
  if (places.front ().cost > EXPLAINED * spread)
    return {};
  const double most = spread - AS_GOOD * (spread - places.front ().cost);
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

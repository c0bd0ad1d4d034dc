// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/ray_evidence.h"

#include "core/geometry.h"
#include "core/order_statistics.h"
#include "core/parallel.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pcl::floater {
RowEvidence
findRows (const Points& points, const CsrLists& neighbors, std::size_t count)
{
  constexpr double OPPOSITE = -0.7; // cosine of 135 degrees
  constexpr double BENT = 0.87;     // cosine of 30 degrees. Noise of 0.3 spacings along the surface
                                    // turns rows by 12 degrees
  constexpr double FEWEST_BENT = 0.02; // of the rows: such noise has 0.012, a body on a table more
  const std::vector<Eigen::Vector3d>& positions = points.positions;
  const std::size_t step = std::max<std::size_t> (1, positions.size () / count);
  std::size_t looked_at = 0;
  std::vector<Eigen::Vector3d> directions;          // of the rows
  Eigen::Matrix3d along = Eigen::Matrix3d::Zero (); // sum of their squares
  for (std::size_t p = step / 2; p < positions.size (); p += step) {
    const Row row = neighbors.row (p);
    if (row.size () < 2)
      continue;
    const Eigen::Vector3d u = (positions[row[0]] - positions[p]).normalized ();
    const Eigen::Vector3d v = (positions[row[1]] - positions[p]).normalized ();
    ++looked_at;
    if (u.dot (v) >= OPPOSITE)
      continue;
    directions.push_back ((u - v).normalized ());
    along += directions.back () * directions.back ().transpose ();
  }
  RowEvidence rows;
  if (directions.empty ())
    return rows;
  const auto axesOf = [] (const Eigen::Matrix3d& squares) -> Eigen::Matrix3d {
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> (squares).eigenvectors ();
  };
  // Most rows may have one direction, which with any other one gives the plane.
  const Eigen::Vector3d usual = axesOf (along).col (2);
  along.setZero ();
  double bent = 0.0;
  for (const Eigen::Vector3d& direction : directions)
    if (std::abs (direction.dot (usual)) < BENT) {
      ++bent;
      along += direction * direction.transpose () + usual * usual.transpose ();
    }
  const auto in_rows = static_cast<double> (directions.size ());
  rows.share = in_rows / static_cast<double> (looked_at);
  rows.across = axesOf (along).col (0);
  rows.are_straight = bent < FEWEST_BENT * in_rows;
  return rows;
}

std::vector<RayPatch>
findPointPatches (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                  std::size_t count, std::size_t size)
{
  std::vector<RayPatch> patches (count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t seed = (2 * k + 1) * positions.size () / (2 * count);
    RayPatch& patch = patches[k];
    patch.assign (1, static_cast<Index> (seed));
    for (std::size_t i = 0; i < patch.size () && patch.size () < size; ++i)
      for (const Index q : neighbors.row (patch[i]))
        if (patch.size () < size && std::find (patch.begin (), patch.end (), q) == patch.end ())
          patch.push_back (q);
    const auto distance = [&] (Index p) { return (positions[p] - positions[seed]).squaredNorm (); };
    std::stable_sort (patch.begin (), patch.end (),
                      [&] (Index a, Index b) { return distance (a) < distance (b); });
  }
  return patches;
}

std::vector<RayPatch>
findRayPatches (const std::vector<Eigen::Vector3d>& positions, const Viewpoint& viewpoint,
                const EvidenceLimits& limits, const RunContext& run)
{
  const std::size_t n = positions.size ();
  std::vector<Eigen::Vector3d> directions (n);
  parallelRanges (run, n, [&] (std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p)
      directions[p] = rayTo (positions[p], viewpoint).direction;
  });
  const KdTree tree (directions, run, PointOrder::ALONG_CURVE);
  std::vector<RayPatch> patches (std::min (limits.patches, n));
  parallelTasks (run, patches.size (), [&] (std::size_t k) {
    std::vector<Neighbor> found;
    tree.nearest (directions[(2 * k + 1) * n / (2 * patches.size ())], limits.patch_points, found);
    for (const Neighbor& neighbor : found)
      patches[k].push_back (neighbor.point);
  });
  return patches;
}

namespace {
// Logarithm of the 90 % quantile over the 10 % quantile; 0 for few values.
double
spreadOf (std::vector<double>& values)
{
  constexpr std::size_t FEW = 10;
  if (values.size () < FEW)
    return 0.0;
  const auto [small, large] = valuesAtRanks (values, values.size () / 10, values.size () * 9 / 10);
  constexpr double LARGEST = 10.0; // maximum of the logarithm, also for patches without rows
  return large < small * std::exp (LARGEST) ? std::log (large / small) : LARGEST;
}

RayEvidence
examinePatch (const std::vector<Eigen::Vector3d>& positions, const RayPatch& patch,
              const Viewpoint& viewpoint, double near_ratio, bool with_rows)
{
  PatchRays rays (positions, patch, viewpoint);
  RayEvidence evidence;
  std::vector<double> between_rays, between_rows, between_points;
  for (std::size_t i = 0; i < patch.size () / 2; ++i) {
    const PatchRays::Neighbors found = rays.neighborsOf (i, with_rows);
    ++evidence.judged;
    evidence.near += found.nearest_distance < near_ratio * found.second_distance ? 1 : 0;
    between_rays.push_back (found.nearest_distance);
    if (with_rows)
      between_rows.push_back (found.across_distance);
    between_points.push_back ((positions[patch[found.nearest]] - positions[patch[i]]).norm ());
  }
  evidence.ray_spread = spreadOf (between_rays);
  evidence.row_spread = spreadOf (between_rows);
  evidence.point_spread = spreadOf (between_points);
  return evidence;
}

} // namespace

RayEvidence
findRayEvidence (const std::vector<Eigen::Vector3d>& positions,
                 const std::vector<RayPatch>& patches, const Viewpoint& viewpoint,
                 const EvidenceLimits& limits, const RunContext& run, bool with_rows)
{
  std::vector<RayEvidence> found (patches.size ());
  parallelTasks (run, patches.size (), [&] (std::size_t k) {
    found[k] = examinePatch (positions, patches[k], viewpoint, limits.near_ratio, with_rows);
  });
  RayEvidence evidence;
  for (const RayEvidence& patch : found) {
    evidence.judged += patch.judged;
    evidence.near += patch.near;
    evidence.ray_spread += patch.ray_spread / static_cast<double> (found.size ());
    evidence.row_spread += patch.row_spread / static_cast<double> (found.size ());
    evidence.point_spread += patch.point_spread / static_cast<double> (found.size ());
  }
  return evidence;
}

bool
isSeenFromThere (const RayEvidence& evidence, const EvidenceLimits& limits)
{
  return evidence.nearShare () <= limits.near_share &&
         evidence.point_spread >= limits.least_spread &&
         evidence.ray_spread <= limits.regularity * evidence.point_spread;
}

namespace {
// Of a ray: distances to its nearest ones, and to the one of limits.density_rank; in space, that of
// the point of this rank.
struct RayDensity
{
  double depth, to_ray, to_point;
  bool is_near, is_hidden;
};

std::vector<RayDensity>
densitiesOf (const std::vector<Eigen::Vector3d>& positions, const RayPatch& patch,
             const Viewpoint& viewpoint, const EvidenceLimits& limits)
{
  std::vector<Ray> rays;
  for (const Index p : patch)
    rays.push_back (rayTo (positions[p], viewpoint));
  std::vector<RayDensity> found;
  std::vector<std::pair<double, std::size_t>> near;
  std::vector<double> squares;
  for (std::size_t i = 0; i < patch.size () / 2 && limits.density_rank + 1 < patch.size (); ++i) {
    near.clear ();
    squares.clear ();
    for (std::size_t k = 0; k < patch.size (); ++k)
      if (k != i) {
        near.emplace_back ((rays[k].direction - rays[i].direction).squaredNorm (), k);
        squares.push_back ((positions[patch[k]] - positions[patch[i]]).squaredNorm ());
      }
    const auto rank = static_cast<std::ptrdiff_t> (limits.density_rank);
    std::partial_sort (near.begin (), near.begin () + rank, near.end ());
    std::nth_element (squares.begin (), squares.begin () + rank - 1, squares.end ());
    const Ray &ray = rays[i], &nearest = rays[near.front ().second];
    const double second = std::sqrt (near[1].first);
    const double width = second * (viewpoint.is_far ? 1.0 : ray.depth);
    const bool is_near = std::sqrt (near.front ().first) < limits.near_ratio * second;
    found.push_back (
        {ray.depth, std::sqrt (near[limits.density_rank - 1].first),
         std::sqrt (squares[limits.density_rank - 1]), is_near,
         is_near && std::abs (nearest.depth - ray.depth) > limits.hidden_slope * width});
  }
  return found;
}

struct DensityEvidence
{
  double near_share = 1.0, hidden_share = 1.0;
  double ray_spread = 0.0, point_spread = 0.0;
  double depth = 0.0; // median of the rays
};

DensityEvidence
findDensityEvidence (const std::vector<Eigen::Vector3d>& positions,
                     const std::vector<RayPatch>& patches, const Viewpoint& viewpoint,
                     const EvidenceLimits& limits, const RunContext& run)
{
  std::vector<std::vector<RayDensity>> of_patch (patches.size ());
  parallelTasks (run, patches.size (), [&] (std::size_t k) {
    of_patch[k] = densitiesOf (positions, patches[k], viewpoint, limits);
  });
  std::vector<double> depths;
  for (const std::vector<RayDensity>& rays : of_patch)
    for (const RayDensity& ray : rays)
      depths.push_back (ray.depth);
  if (depths.empty ())
    return {};
  const double depth = median (depths);
  const double least =
      viewpoint.is_far ? -std::numeric_limits<double>::infinity () : limits.at_sensor * depth;
  std::size_t near = 0, hidden = 0;
  std::vector<double> of_rays, of_points;
  for (const std::vector<RayDensity>& rays : of_patch)
    for (const RayDensity& ray : rays) {
      if (ray.depth < least)
        continue;
      near += ray.is_near ? 1 : 0;
      hidden += ray.is_hidden ? 1 : 0;
      of_rays.push_back (ray.to_ray);
      of_points.push_back (ray.to_point);
    }
  const auto count = static_cast<double> (of_rays.size ());
  return {static_cast<double> (near) / count, static_cast<double> (hidden) / count,
          spreadOf (of_rays), spreadOf (of_points), depth};
}

} // namespace

bool
explainsDensity (const std::vector<Eigen::Vector3d>& positions,
                 const std::vector<RayPatch>& patches, const Viewpoint& viewpoint,
                 const EvidenceLimits& limits, const RunContext& run)
{
  const DensityEvidence found = findDensityEvidence (positions, patches, viewpoint, limits, run);
  const double left = found.ray_spread / std::max (found.point_spread, limits.least_density_spread);
  if (!(found.point_spread >= limits.least_density_spread && left <= limits.density_regularity &&
        found.near_share <= limits.crossing_share &&
        found.hidden_share * left <= limits.hidden_share * limits.density_regularity))
    return false;
  if (viewpoint.is_far || found.ray_spread <= limits.even_density)
    return true;
  EvidenceLimits few = limits;
  few.patches = std::min (limits.patches_beside, limits.patches);
  const auto spreadAt = [&] (const Viewpoint& v) {
    return findDensityEvidence (positions, findRayPatches (positions, v, few, run), v, few, run)
        .ray_spread;
  };
  const double least = limits.less_beside * spreadAt (viewpoint);
  for (int axis = 0; axis < 3; ++axis)
    for (const double aside : {-limits.beside * found.depth, limits.beside * found.depth})
      if (spreadAt ({viewpoint.place + aside * Eigen::Vector3d::Unit (axis), false}) < least)
        return false;
  return true;
}

bool
mayBeSeenFrom (const std::vector<Eigen::Vector3d>& positions, const Viewpoint& viewpoint,
               const EvidenceLimits& limits, const RunContext& run)
{
  return !looksToAllSides (positions, viewpoint, limits) &&
         findDensityEvidence (positions, findRayPatches (positions, viewpoint, limits, run),
                              viewpoint, limits, run)
                 .hidden_share <= limits.hidden_if_told;
}

bool
looksToAllSides (const std::vector<Eigen::Vector3d>& positions, const Viewpoint& viewpoint,
                 const EvidenceLimits& limits)
{
  constexpr std::size_t DIRECTIONS = 200;
  double cosine = 0.0;
  emptyDirection (positions, viewpoint, DIRECTIONS, cosine);
  return cosine > std::cos (limits.all_sides * DEGREE);
}

std::vector<Index>
areaSampleCentres (std::size_t points, std::size_t count)
{
  // Half of them are spare: points with open stars have no area.
  const std::size_t step = std::max<std::size_t> (1, points / (2 * count));
  std::vector<Index> centres;
  for (std::size_t p = step / 2; p < points && centres.size () < 2 * count; p += step)
    centres.push_back (static_cast<Index> (p));
  return centres;
}

std::vector<AreaSample>
takeAreaSamples (const std::vector<Index>& centres, const std::vector<Eigen::Vector3d>& positions,
                 const Stars& stars)
{
  std::vector<AreaSample> samples;
  for (std::size_t k = 0; k < centres.size (); ++k) {
    if (stars.open[k] != 0)
      continue;
    const Eigen::Vector3d& centre = positions[centres[k]];
    const Row star = stars.neighbors.row (static_cast<Index> (k));
    double area = 0.0;
    for (std::size_t i = 0; i < star.size (); ++i)
      area += (positions[star[i]] - centre)
                  .cross (positions[star[(i + 1) % star.size ()]] - centre)
                  .norm ();
    if (area > 0.0)
      samples.push_back ({centre, stars.normals[k].cast<double> (), area});
  }
  return samples;
}

std::vector<AreaSample>
takeAreaSamples (const Points& points, const LocalPlanes& planes, const StarSettings& settings,
                 std::size_t count, const RunContext& run)
{
  const std::vector<Index> centres = areaSampleCentres (points.size (), count);
  return takeAreaSamples (centres, points.positions,
                          makeStarsOf (centres, points, planes, settings, run));
}

std::vector<AreaSample>
takePatchSamples (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
                  std::size_t count)
{
  constexpr std::size_t SIZE = 60; // points; noise of a spacing is a quarter of their radius
  std::vector<AreaSample> samples;
  for (const RayPatch& patch : findPointPatches (positions, neighbors, count, SIZE)) {
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

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/ray_evidence.h"

#include "core/geometry.h"
#include "core/order_statistics.h"
#include "core/parallel.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

// Compiled a second time for processors with vectors of 8 floats, which are chosen at run time. The
// results are the same. Sanitizers do not know such functions.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) &&                             \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define PCL_FLOATER_WIDE __attribute__ ((target_clones ("avx2", "default")))
#else
#define PCL_FLOATER_WIDE
#endif

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
template <typename Value>
double
spreadOf (std::vector<Value>& values)
{
  constexpr std::size_t FEW = 10;
  if (values.size () < FEW)
    return 0.0;
  const auto [low, high] = valuesAtRanks (values, values.size () / 10, values.size () * 9 / 10);
  const auto small = static_cast<double> (low), large = static_cast<double> (high);
  constexpr double LARGEST = 10.0; // maximum of the logarithm, also for patches without rows
  return large < small * std::exp (LARGEST) ? std::log (large / small) : LARGEST;
}

// The mean over the patches. Where the meridians of a scanner meet, rays coincide and there are no rows:
// of the rays from a place, the quarter of the patches with the largest spread is left out. In
// generated scans of rooms such patches were one in 32; the quarter is by hand.
double
meanOver (std::vector<double>& spreads, const Viewpoint& viewpoint)
{
  const std::size_t left_out = viewpoint.is_far ? 0 : spreads.size () / 4;
  const auto last = spreads.end () - static_cast<std::ptrdiff_t> (left_out);
  if (left_out > 0)
    std::nth_element (spreads.begin (), last, spreads.end ());
  return std::accumulate (spreads.begin (), last, 0.0) /
         static_cast<double> (last - spreads.begin ());
}

// The rays to the points of a patch, in single precision relative to the first one, which keeps
// six digits of their small distances; and what is near those of its first half, which are judged.
struct PatchRays
{
  std::vector<float> x, y, z;
  std::vector<float> nearest, second; // distances to the nearest two rays; infinite if none
  std::vector<float> across;     // to the nearest one more than 45 degrees off the direction to the
                                 // nearest: in a scanner's raster, in the next row; 0 if none
  std::vector<std::uint32_t> at; // the nearest, in the patch; the ray itself if there is none

  PatchRays (const std::vector<Eigen::Vector3d>& positions, const RayPatch& patch,
             const Viewpoint& viewpoint, bool with_across)
      : x (patch.size () + LANES), y (x.size ()), z (x.size ()), nearest (x.size ()),
        second (x.size ()), across (x.size ()), at (x.size ())
  {
    Eigen::Vector3d first = Eigen::Vector3d::Zero ();
    for (std::size_t i = 0; i < patch.size (); ++i) {
      const Eigen::Vector3d direction = rayTo (positions[patch[i]], viewpoint).direction;
      if (i == 0)
        first = direction;
      const Eigen::Vector3f offset = (direction - first).cast<float> ();
      x[i] = offset.x ();
      y[i] = offset.y ();
      z[i] = offset.z ();
    }
    const auto size = static_cast<std::uint32_t> (patch.size ());
    for (std::uint32_t i = 0; i < size / 2; i += LANES)
      judge (i, size, with_across);
    for (std::vector<float>* const distances : {&nearest, &second, &across})
      distances->resize (size / 2);
  }

private:
  static constexpr std::uint32_t LANES = 8; // rays that are judged at once, by vector instructions
  static constexpr float NONE_YET = std::numeric_limits<float>::infinity ();
  using Floats = std::array<float, LANES>;

  // Without a branch.
  static bool bothHold (bool one, bool other)
  {
    return (static_cast<int> (one) & static_cast<int> (other)) != 0;
  }

  PCL_FLOATER_WIDE void judge (std::uint32_t first, std::uint32_t size, bool with_across)
  {
    Floats px, py, pz, d1, d2, dx, dy, dz;
    std::array<std::uint32_t, LANES> own, best;
    for (std::uint32_t k = 0; k < LANES; ++k) {
      own[k] = best[k] = first + k;
      px[k] = x[first + k];
      py[k] = y[first + k];
      pz[k] = z[first + k];
      d1[k] = d2[k] = NONE_YET;
    }
    for (std::uint32_t i = 0; i < size; ++i)
      for (std::uint32_t k = 0; k < LANES; ++k) {
        const float u = x[i] - px[k], v = y[i] - py[k], w = z[i] - pz[k];
        const float sum = u * u + v * v + w * w;
        const float square = bothHold (i != own[k], sum < NONE_YET) ? sum : NONE_YET;
        const float one = d1[k], two = d2[k];
        const std::uint32_t at_one = best[k];
        // No choice of integers by floats, which would stay scalar.
        const std::uint32_t mask = square < one ? ~0U : 0U;
        const float rest = square < one ? one : square;
        d1[k] = square < one ? square : one;
        best[k] = (i & mask) | (at_one & ~mask);
        d2[k] = rest < two ? rest : two;
      }
    for (std::uint32_t k = 0; k < LANES; ++k) {
      at[own[k]] = best[k];
      nearest[own[k]] = std::sqrt (d1[k]);
      second[own[k]] = std::sqrt (d2[k]);
      dx[k] = x[best[k]] - px[k];
      dy[k] = y[best[k]] - py[k];
      dz[k] = z[best[k]] - pz[k];
      d1[k] *= 0.5F; // squared cosine of 45 degrees
      d2[k] = NONE_YET;
    }
    if (!with_across)
      return;
    for (std::uint32_t i = 0; i < size; ++i)
      for (std::uint32_t k = 0; k < LANES; ++k) {
        const float u = x[i] - px[k], v = y[i] - py[k], w = z[i] - pz[k];
        const float square = u * u + v * v + w * w;
        const float part = u * dx[k] + v * dy[k] + w * dz[k];
        const bool is_across =
            bothHold (bothHold (i != best[k], square > 0.0F), part * part <= d1[k] * square);
        d2[k] = bothHold (is_across, square < d2[k]) ? square : d2[k];
      }
    for (std::uint32_t k = 0; k < LANES; ++k)
      across[own[k]] = d2[k] < NONE_YET ? std::sqrt (d2[k]) : 0.0F;
  }
};

} // namespace

RayEvidence
findRayEvidence (const std::vector<Eigen::Vector3d>& positions,
                 const std::vector<RayPatch>& patches, const Viewpoint& viewpoint,
                 const EvidenceLimits& limits, const RunContext& run)
{
  std::vector<RayEvidence> found (patches.size ());
  parallelTasks (run, patches.size (), [&] (std::size_t k) {
    const RayPatch& patch = patches[k];
    PatchRays rays (positions, patch, viewpoint, false);
    RayEvidence& evidence = found[k];
    evidence.judged = rays.nearest.size ();
    std::vector<double> between_points;
    for (std::size_t i = 0; i < evidence.judged; ++i) {
      evidence.near += static_cast<double> (rays.nearest[i]) <
                               limits.near_ratio * static_cast<double> (rays.second[i])
                           ? 1
                           : 0;
      between_points.push_back ((positions[patch[rays.at[i]]] - positions[patch[i]]).norm ());
    }
    evidence.ray_spread = spreadOf (rays.nearest);
    evidence.point_spread = spreadOf (between_points);
  });
  RayEvidence evidence;
  for (const RayEvidence& patch : found) {
    evidence.judged += patch.judged;
    evidence.near += patch.near;
    evidence.ray_spread += patch.ray_spread / static_cast<double> (found.size ());
    evidence.point_spread += patch.point_spread / static_cast<double> (found.size ());
  }
  return evidence;
}

double
findRaySpread (const std::vector<Eigen::Vector3d>& positions, const std::vector<RayPatch>& patches,
               const Viewpoint& viewpoint, bool with_rows, const RunContext& run)
{
  std::vector<double> of_rays (patches.size ()), of_rows (patches.size ());
  parallelTasks (run, patches.size (), [&] (std::size_t k) {
    PatchRays rays (positions, patches[k], viewpoint, with_rows);
    of_rays[k] = spreadOf (rays.nearest);
    of_rows[k] = with_rows ? spreadOf (rays.across) : 0.0;
  });
  return meanOver (of_rays, viewpoint) + (with_rows ? meanOver (of_rows, viewpoint) : 0.0);
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

} // namespace pcl::floater

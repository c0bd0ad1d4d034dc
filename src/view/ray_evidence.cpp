// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/ray_evidence.h"

#include "core/geometry.h"
#include "core/order_statistics.h"
#include "core/parallel.h"
#include "points/kd_tree.h"

#include <cstring>

// Compiled a second time for processors with vectors of 8 floats, which are chosen at run time. The
// results are the same. Sanitizers do not know such functions.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) &&                             \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define PCL_FLOATER_WIDE __attribute__ ((target_clones ("avx2", "default")))
#else
#define PCL_FLOATER_WIDE
#endif

namespace pcl::floater {
namespace {
// A ray is near another if their distance is below this share of the next one. On a scanner's
// raster both are the same, or one is half the other at the end of a row.
constexpr double NEAR = 0.45;

// The density is measured by the distance to the neighbour of this rank: lost rays, rings that are
// uneven, and rows of two distances hardly change it.
constexpr std::size_t DENSITY_RANK = 8;

// Numbers that are taken at once.
using Floats = float __attribute__ ((vector_size (32)));
using Ints = std::int32_t __attribute__ ((vector_size (32)));
constexpr std::uint32_t LANES = 8;

// Not returned, since how that is done depends on the processor.
void
load (const std::vector<float>& values, std::size_t first, Floats& loaded)
{
  std::memcpy (&loaded, values.data () + first, sizeof loaded);
}

// As valuesAtRanks () of the first values, by counting what is below each of them: they are few, and
// their order is random, so that comparing them one by one takes longer.
// \param values with some more, for the last lanes
PCL_FLOATER_WIDE std::pair<float, float>
fewAtRanks (const std::vector<float>& values, std::uint32_t size, std::int32_t low,
            std::int32_t high)
{
  std::pair<float, float> found{};
  for (std::uint32_t first = 0; first < size; first += LANES) {
    Floats own;
    load (values, first, own);
    Ints below{}, up_to{};
    for (std::uint32_t i = 0; i < size; ++i) {
      below -= values[i] < own;
      up_to -= values[i] <= own;
    }
    for (std::uint32_t k = 0; k < LANES && first + k < size; ++k) {
      if (below[k] <= low && low < up_to[k])
        found.first = own[k];
      if (below[k] <= high && high < up_to[k])
        found.second = own[k];
    }
  }
  return found;
}

// Logarithm of the ratio of a 90 % quantile over a 10 % quantile.
double
logOfRatio (const std::pair<double, double>& ends)
{
  const auto [small, large] = ends;
  constexpr double LARGEST = 10.0; // maximum of the logarithm, also for patches without rows
  return large < small * std::exp (LARGEST) ? std::log (large / small) : LARGEST;
}

constexpr std::size_t FEWEST_VALUES = 10; // with a spread

double
spreadOf (std::vector<double>& values)
{
  const std::size_t size = values.size ();
  return size < FEWEST_VALUES ? 0.0 : logOfRatio (valuesAtRanks (values, size / 10, size * 9 / 10));
}

// The mean over the patches. Where the meridians of a scanner meet, rays coincide and there are no rows:
// of the rays from a place, the quarter of the patches with the largest spread is left out. In
// generated scans of rooms such patches were one in 32; the quarter is by hand.
double
meanOver (std::vector<double>& spreads, const Viewpoint& viewpoint)
{
  const std::size_t left_out = viewpoint.is_far ? 0 : spreads.size () / 4;
  const auto last = spreads.end () - left_out;
  if (left_out > 0)
    std::nth_element (spreads.begin (), last, spreads.end ());
  return std::accumulate (spreads.begin (), last, 0.0) / (last - spreads.begin ());
}

// The rays to the points of a patch, in single precision relative to the first one, which keeps
// six digits of their small distances; and what is near those of its first half, which are judged.
struct PatchRays
{
  std::uint32_t judged;
  std::vector<float> x, y, z;
  std::vector<float> nearest, second; // distances to the nearest two rays; infinite if none
  std::vector<float> across;     // to the nearest one more than 45 degrees off the direction to the
                                 // nearest: in a scanner's raster, in the next row; 0 if none
  std::vector<std::uint32_t> at; // the nearest, in the patch; the ray itself if there is none

  PatchRays (const Positions& positions, const RayPatch& patch, const Viewpoint& viewpoint,
             bool with_across)
      : judged (patch.size () / 2), x (patch.size () + LANES), y (x.size ()), z (x.size ()),
        nearest (x.size ()), second (x.size ()), across (x.size ()), at (x.size ())
  {
    Vector3d first = Vector3d::Zero ();
    for (std::size_t i = 0; i < patch.size (); ++i) {
      const Vector3d direction = rayTo (positions[patch[i]], viewpoint).direction;
      if (i == 0)
        first = direction;
      const Vector3f offset = (direction - first).cast<float> ();
      x[i] = offset.x ();
      y[i] = offset.y ();
      z[i] = offset.z ();
    }
    for (std::uint32_t i = 0; i < judged; i += LANES)
      judge (i, patch.size (), with_across);
  }

  // Of the distances of the rays that are judged.
  double spreadOf (const std::vector<float>& distances) const
  {
    return judged < FEWEST_VALUES
               ? 0.0
               : logOfRatio (fewAtRanks (distances, judged, judged / 10, judged * 9 / 10));
  }

private:
  PCL_FLOATER_WIDE void judge (std::uint32_t first, std::int32_t size, bool with_across)
  {
    constexpr float NONE_YET = std::numeric_limits<float>::infinity ();
    Floats px, py, pz;
    load (x, first, px);
    load (y, first, py);
    load (z, first, pz);
    const Ints own = Ints{0, 1, 2, 3, 4, 5, 6, 7} + static_cast<std::int32_t> (first);
    Ints best = own;
    Floats d1 = Floats{} + NONE_YET, d2 = d1;
    for (std::int32_t i = 0; i < size; ++i) {
      const Floats u = x[i] - px, v = y[i] - py, w = z[i] - pz;
      const Floats sum = u * u + v * v + w * w;
      const Ints is_other = (own != i) & (sum < NONE_YET);
      const Floats square = is_other ? sum : Floats{} + NONE_YET;
      const Ints is_nearer = square < d1;
      const Floats rest = is_nearer ? d1 : square;
      d1 = is_nearer ? square : d1;
      best = is_nearer ? Ints{} + i : best;
      d2 = rest < d2 ? rest : d2;
    }
    Floats dx, dy, dz;
    for (std::uint32_t k = 0; k < LANES; ++k) {
      const auto b = static_cast<std::uint32_t> (best[k]);
      at[first + k] = b;
      nearest[first + k] = std::sqrt (d1[k]);
      second[first + k] = std::sqrt (d2[k]);
      dx[k] = x[b] - px[k];
      dy[k] = y[b] - py[k];
      dz[k] = z[b] - pz[k];
    }
    if (!with_across)
      return;
    d1 *= 0.5F; // squared cosine of 45 degrees
    d2 = Floats{} + NONE_YET;
    for (std::int32_t i = 0; i < size; ++i) {
      const Floats u = x[i] - px, v = y[i] - py, w = z[i] - pz;
      const Floats square = u * u + v * v + w * w;
      const Floats part = u * dx + v * dy + w * dz;
      const Ints is_across = (best != i) & (square > 0.0F) & (part * part <= d1 * square);
      const Ints is_nearer = is_across & (square < d2);
      d2 = is_nearer ? square : d2;
    }
    for (std::uint32_t k = 0; k < LANES; ++k)
      across[first + k] = d2[k] < NONE_YET ? std::sqrt (d2[k]) : 0.0F;
  }
};

// Of a ray: the distances to the ray and to the point of DENSITY_RANK.
struct RayDensity
{
  double depth, to_ray, to_point;
  bool is_near, is_hidden;
};

std::vector<RayDensity>
densitiesOf (const Positions& positions, const RayPatch& patch, const Viewpoint& viewpoint)
{
  std::vector<Ray> rays;
  for (const Index p : patch)
    rays.push_back (rayTo (positions[p], viewpoint));
  std::vector<RayDensity> found;
  std::vector<double> to_rays, to_points; // squared distances
  for (std::size_t i = 0; i < patch.size () / 2 && DENSITY_RANK + 1 < patch.size (); ++i) {
    to_rays.clear ();
    to_points.clear ();
    double first = std::numeric_limits<double>::infinity (), second = first;
    const Ray &ray = rays[i], *nearest = &ray;
    for (std::size_t k = 0; k < patch.size (); ++k)
      if (k != i) {
        const double square = (rays[k].direction - ray.direction).squaredNorm ();
        if (square < first)
          nearest = &rays[k];
        second = std::min (second, std::max (square, first));
        first = std::min (square, first);
        to_rays.push_back (square);
        to_points.push_back ((positions[patch[k]] - positions[patch[i]]).squaredNorm ());
      }
    const double width = std::sqrt (second) * ray.depth;
    const bool is_near = std::sqrt (first) < NEAR * std::sqrt (second);
    found.push_back ({ray.depth, std::sqrt (valueAtRank (to_rays, DENSITY_RANK - 1)),
                      std::sqrt (valueAtRank (to_points, DENSITY_RANK - 1)), is_near,
                      is_near && std::abs (nearest->depth - ray.depth) > STEEP * width});
  }
  return found;
}

} // namespace

std::vector<RayPatch>
findRayPatches (const Positions& positions, const Viewpoint& viewpoint, const RunContext& run,
                std::size_t count)
{
  const std::size_t n = positions.size ();
  std::vector<Vector3d> directions (n);
  parallelPoints (run, n,
                  [&] (Index p) { directions[p] = rayTo (positions[p], viewpoint).direction; });
  const KdTree tree (directions, run, PointOrder::ALONG_CURVE);
  std::vector<RayPatch> patches (std::min (count, n));
  parallelTasks (run, patches.size (), [&] (std::size_t k) {
    std::vector<Neighbor> found;
    tree.nearest (directions[(2 * k + 1) * n / (2 * patches.size ())], PATCH_POINTS, found);
    for (const Neighbor& neighbor : found)
      patches[k].push_back (neighbor.point);
  });
  return patches;
}

RayEvidence
findRayEvidence (const Positions& positions, const std::vector<RayPatch>& patches,
                 const Viewpoint& viewpoint, const RunContext& run)
{
  std::vector<RayEvidence> found (patches.size ());
  parallelTasks (run, patches.size (), [&] (std::size_t k) {
    const RayPatch& patch = patches[k];
    const PatchRays rays (positions, patch, viewpoint, false);
    RayEvidence& evidence = found[k];
    evidence.judged = rays.judged;
    std::vector<double> between_points;
    for (std::size_t i = 0; i < evidence.judged; ++i) {
      evidence.near += rays.nearest[i] < NEAR * rays.second[i] ? 1 : 0;
      between_points.push_back ((positions[patch[rays.at[i]]] - positions[patch[i]]).norm ());
    }
    evidence.ray_spread = rays.spreadOf (rays.nearest);
    evidence.point_spread = spreadOf (between_points);
  });
  RayEvidence evidence;
  for (const RayEvidence& patch : found) {
    evidence.judged += patch.judged;
    evidence.near += patch.near;
    evidence.ray_spread += patch.ray_spread / found.size ();
    evidence.point_spread += patch.point_spread / found.size ();
  }
  return evidence;
}

double
findRaySpread (const Positions& positions, const std::vector<RayPatch>& patches,
               const Viewpoint& viewpoint, bool with_rows, const RunContext& run)
{
  std::vector<double> of_rays (patches.size ()), of_rows (patches.size ());
  parallelTasks (run, patches.size (), [&] (std::size_t k) {
    const PatchRays rays (positions, patches[k], viewpoint, with_rows);
    of_rays[k] = rays.spreadOf (rays.nearest);
    of_rows[k] = with_rows ? rays.spreadOf (rays.across) : 0.0;
  });
  return meanOver (of_rays, viewpoint) + (with_rows ? meanOver (of_rows, viewpoint) : 0.0);
}

bool
isSeenFromThere (const RayEvidence& evidence, double excess)
{
  // The points of a ball are as even as their rays from its middle.
  constexpr double LEAST_POINT_SPREAD = 0.02;
  return evidence.nearShare () <= NEAR_SHARE && evidence.point_spread >= LEAST_POINT_SPREAD &&
         evidence.ray_spread <= excess * REGULARITY * evidence.point_spread;
}

DensityEvidence
findDensityEvidence (const Positions& positions, const std::vector<RayPatch>& patches,
                     const Viewpoint& viewpoint, const RunContext& run)
{
  std::vector<std::vector<RayDensity>> of_patch (patches.size ());
  parallelTasks (run, patches.size (), [&] (std::size_t k) {
    of_patch[k] = densitiesOf (positions, patches[k], viewpoint);
  });
  std::vector<double> depths;
  for (const std::vector<RayDensity>& rays : of_patch)
    for (const RayDensity& ray : rays)
      depths.push_back (ray.depth);
  if (depths.empty ())
    return {};
  const double depth = median (depths);
  const double least = AT_SENSOR * depth;
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

bool
explainsDensity (const Positions& positions, const DensityEvidence& found,
                 const Viewpoint& viewpoint, double regularity, const RunContext& run)
{
  // Share of hidden rays, where the spread that is left is 1; more if less is left, in proportion. A clean
  // depth frame seen from 60 % of its depth beside the camera has 0.009 at 0.34; scans from a moving car
  // 0.003 to 0.022 at 0.2; from a standing one, 0.003.
  constexpr double HIDDEN = 0.002;
  // Distance of six places around the viewpoint, in median depths, from which the densities must
  // not be more alike than this factor, or at all if too much is hidden, ...
  constexpr double BESIDE = 0.25, LESS_BESIDE = 0.7;
  // ... unless their spread is below this at the viewpoint, and little is hidden. A quarter of the
  // depth nearer to the right place, generated scans have a factor of 0.4 to 0.77; around the right
  // place, 0.89 and more; around that of 40 scans from a car, 1.2 and more. Around one of several
  // lidars whose scans are merged, 0.73 to 1.0.
  constexpr double EVEN = 0.2;
  constexpr std::size_t PATCHES_BESIDE = 32;
  const double left = found.left ();
  if (!(found.point_spread >= DensityEvidence::LEAST_POINT_SPREAD && left <= regularity &&
        found.near_share <= CROSSING_SHARE))
    return false;
  const bool hides_little = found.hidden_share * left <= HIDDEN;
  if (hides_little && found.ray_spread <= EVEN)
    return true;
  const auto spreadAt = [&] (const Viewpoint& v) {
    return findDensityEvidence (positions, findRayPatches (positions, v, run, PATCHES_BESIDE), v,
                                run)
        .ray_spread;
  };
  const double least = (hides_little ? LESS_BESIDE : 1.0) * spreadAt (viewpoint);
  for (int axis = 0; axis < 3; ++axis)
    for (const double aside : {-BESIDE * found.depth, BESIDE * found.depth})
      if (spreadAt ({viewpoint.place + aside * Vector3d::Unit (axis), false}) < least)
        return false;
  return true;
}

bool
looksToAllSides (const Positions& positions, const Viewpoint& viewpoint)
{
  constexpr std::size_t DIRECTIONS = 200;
  constexpr double FARTHEST = 20.0; // degrees from any direction to the nearest ray
  return emptyDirection (positions, viewpoint, DIRECTIONS).second > std::cos (FARTHEST * DEGREE);
}

} // namespace pcl::floater

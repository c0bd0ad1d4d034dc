// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/noise.h"

#include "core/geometry.h"
#include "core/order_statistics.h"
#include "core/parallel.h"

#include <Eigen/Cholesky>

namespace pcl::floater {
namespace {
constexpr std::size_t FEWEST = 10; // points that a residual needs
// Residual in spacings of a scale from which on points are projected. Clean clouds, however thin,
// sharp or coarse, measured up to 0.08; noise of 0.2 spacings in each coordinate measures 0.15 to
// 0.19.
constexpr double STRONG = 0.15;
constexpr std::size_t CENTRES = 8; // noise is measured at one in this many points
constexpr std::size_t AROUND = 10; // centres around a point
constexpr std::size_t PROBES = 8;  // one in this many centres is measured first
// Minimum share of noisy centres. Below, too few stars disagree for strong noise, unless
// noise triples where it is smoothed, and all neighbours there disagree.
constexpr double FEW = 0.01;
constexpr float NO_SURFACE = std::numeric_limits<float>::max (); // points on lines at all scales

// Scales: every point, every fourth, every sixteenth. On a surface, spacings double from one to the next.
constexpr std::size_t SCALES = 3;
constexpr std::array<std::size_t, SCALES> STRIDES{1, 4, 16};
constexpr std::size_t LOOKED_AT = 20; // neighbours at each scale

// Every n-th point along the space-filling curve, so the sample is evenly spread.
struct PointSample
{
  std::size_t stride;
  KdTree tree;

  // The nearest points of the sample, as indices among all points.
  void nearest (const Vector3d& query, std::size_t k, std::vector<Neighbor>& found) const
  {
    tree.nearest (query, k, found);
    for (Neighbor& neighbor : found)
      neighbor.point *= static_cast<Index> (stride);
  }
};

PointSample
takeSample (const Positions& positions, std::size_t stride, const RunContext& run)
{
  Positions kept;
  kept.reserve (positions.size () / stride + 1);
  for (std::size_t p = 0; p < positions.size (); p += stride)
    kept.push_back (positions[p]);
  return {stride, KdTree (kept, run)};
}

// Root mean square distance to the quadric over the plane of the points.
double
quadricResidual (const std::vector<Vector3d>& offsets, const PrincipalAxes& axes)
{
  using Vector6d = Eigen::Matrix<double, 6, 1>;
  auto normal_matrix = Eigen::Matrix<double, 6, 6>::Zero ().eval ();
  Vector6d right_side = Vector6d::Zero ();
  double sqr_heights = 0.0;
  for (const Vector3d& offset : offsets) {
    const Vector3d q = axes.axes.transpose () * (offset - axes.centre) / axes.spread[2];
    Vector6d terms;
    terms << 1.0, q[1], q[2], q[1] * q[1], q[1] * q[2], q[2] * q[2];
    normal_matrix.noalias () += terms * terms.transpose ();
    right_side += q[0] * terms;
    sqr_heights += q[0] * q[0];
  }
  const double explained = right_side.dot (normal_matrix.ldlt ().solve (right_side));
  const double points = static_cast<double> (offsets.size ());
  return axes.spread[2] * std::sqrt (std::max (0.0, sqr_heights - explained) / (points - 6.0));
}

// What is measured at one point.
struct Place
{
  float noise = 0.0F;
  float unevenness = 0.0F; // residual in spacings at the flattest scale; below 0: unknown
  float dimension = 0.0F, smaller_dimension = 0.0F; // 0: unknown
};

// Measures the noise at one point; scratch is reused from point to point.
struct NoiseMeter
{
  const Positions& positions;
  const CsrLists& neighbors;
  std::array<const PointSample*, SCALES> samples;
  std::vector<Neighbor> found{};
  std::vector<Vector3d> offsets{}, local{};
  std::vector<double> heights{};

  Place measure (Index p, bool is_unevenness_needed)
  {
    // Middle over largest eigenvalue of the points; below, they lie on a line, and their residual
    // is meaningless.
    constexpr double LEAST_ASPECT = 0.02;
    // Factor of the residual in spacings, at a larger scale. Between 0.5 (noise) and 1 (crease), a
    // standard error of 20 points nearer to noise.
    constexpr double FALLS_TO = 0.7;
    const auto isRough = [] (double one) { return one >= STRONG; };
    std::size_t lines = 0;
    std::array<double, SCALES> residual{}, relative{}, half{}, whole{};
    const double nearest_spacing = spacingOf (positions, p, neighbors.row (p));
    relative.fill (-1.0); // unknown
    for (std::size_t scale = 0; scale < SCALES; ++scale) {
      // The last scale only confirms noise that a smaller one has shown.
      if (scale + 1 == SCALES && !is_unevenness_needed &&
          std::none_of (relative.begin (), relative.end (), isRough))
        break;
      gather (p, scale);
      if (offsets.size () < FEWEST)
        continue;
      if (offsets.size () > LOOKED_AT) {
        half[scale] = offsets[LOOKED_AT / 2].norm ();
        whole[scale] = offsets[LOOKED_AT].norm ();
      }
      double spacing = 0.0;
      for (std::size_t i = 1; i <= SPACING_NEIGHBORS; ++i)
        spacing += offsets[i].norm () / static_cast<double> (SPACING_NEIGHBORS);
      const PrincipalAxes axes = axesOfOffsets ();
      if (axes.spread[1] * axes.spread[1] < LEAST_ASPECT * axes.spread[2] * axes.spread[2]) {
        ++lines;
        continue;
      }
      residual[scale] = quadricResidual (offsets, axes);
      if (residual[scale] >= STRONG * spacing && keepOwnSheet (axes, nearest_spacing)) {
        if (offsets.size () < FEWEST)
          continue;
        residual[scale] = quadricResidual (offsets, axesOfOffsets ());
      }
      relative[scale] = residual[scale] / spacing;
    }
    double noise = 0.0;
    for (std::size_t scale = 0; scale + 1 < SCALES; ++scale)
      for (std::size_t larger = scale + 1; larger < SCALES; ++larger)
        if (isRough (relative[scale]) && relative[larger] >= 0.0 &&
            relative[larger] < FALLS_TO * relative[scale])
          noise = std::max (noise, residual[scale]);
    float flattest = lines == SCALES ? NO_SURFACE : -1.0F;
    for (const double value : relative)
      if (value >= 0.0 && (flattest < 0.0F || value < flattest))
        flattest = static_cast<float> (value);
    const double smaller = 0.5 * (growth (half[0], half[1]) + growth (whole[0], whole[1]));
    const double dimension = 0.5 * (growth (half[1], half[2]) + growth (whole[1], whole[2]));
    return {static_cast<float> (noise), flattest, static_cast<float> (dimension),
            static_cast<float> (smaller > 0.0 ? smaller : dimension)};
  }

private:
  // By which power of the distance the number of points grows from a scale to the next.
  static double growth (double smaller, double larger)
  {
    return smaller > 0.0 && larger > smaller
               ? std::log (STRIDES[1] / STRIDES[0]) / std::log (larger / smaller)
               : 0.0;
  }

  PrincipalAxes axesOfOffsets () const
  {
    PlaneFit fit;
    for (const Vector3d& offset : offsets)
      fit.add (offset);
    return fit.principalAxes ();
  }

  void gather (Index p, std::size_t scale)
  {
    offsets.assign (1, Vector3d::Zero ());
    if (scale == 0) {
      for (const Index q : neighbors.first (p, LOOKED_AT))
        offsets.emplace_back (positions[q] - positions[p]);
      return;
    }
    samples[scale]->nearest (positions[p], LOOKED_AT + 1, found);
    for (const Neighbor& neighbor : found)
      if (neighbor.point != p)
        offsets.emplace_back (positions[neighbor.point] - positions[p]);
  }

  // If the heights form two distant thin groups, one above the other, they are two sheets. Then
  // keeps only the points on the sheet of the centre.
  // \return whether there are two
  bool keepOwnSheet (const PrincipalAxes& axes, double spacing)
  {
    constexpr double SHEET_GAP = 0.7; // spacings; two sheets at least so far apart are not noise
    local.clear ();
    heights.clear ();
    for (const Vector3d& offset : offsets) {
      local.emplace_back (axes.axes.transpose () * (offset - axes.centre));
      heights.push_back (local.back ()[0]);
    }
    std::sort (heights.begin (), heights.end ());
    const std::size_t count = heights.size ();
    std::size_t below = 0;
    double gap = 0.0;
    for (std::size_t i = 1; i < count; ++i)
      if (heights[i] - heights[i - 1] > gap) {
        gap = heights[i] - heights[i - 1];
        below = i;
      }
    if (below == 0 || gap < SHEET_GAP * spacing ||
        gap < std::max (heights[below - 1] - heights.front (), heights.back () - heights[below]))
      return false;
    // Terraces lie side by side: their centres are farther apart than their points spread, less the
    // error of a mean of few points.
    const double middle = 0.5 * (heights[below - 1] + heights[below]);
    Vector2d lower = Vector2d::Zero (), upper = Vector2d::Zero ();
    for (const Vector3d& point : local)
      (point[0] < middle ? lower : upper) += point.tail<2> ();
    const double apart =
        (lower / static_cast<double> (below) - upper / static_cast<double> (count - below)).norm ();
    const auto fewer = static_cast<double> (std::min (below, count - below));
    if (apart > (0.5 + 1.5 / std::sqrt (fewer)) * axes.spread[1])
      return false;
    const bool is_lower = local.front ()[0] < middle;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i)
      if ((local[i][0] < middle) == is_lower)
        offsets[kept++] = offsets[i];
    offsets.resize (kept);
    return true;
  }
};

// Measurements at each centre.
struct Places
{
  std::vector<Place> at_centre;
  bool are_noisy = true, are_uneven = true; // enough of them
};

Places
measurePlaces (const Positions& positions, const CsrLists& neighbors, const RunContext& run)
{
  constexpr std::size_t LEAST_UNEVEN = 100; // points; with fewer, unevenness is not measured
  const PointSample quarter = takeSample (positions, STRIDES[1], run),
                    sixteenth = takeSample (positions, STRIDES[2], run);
  const std::size_t centres = (positions.size () + CENTRES - 1) / CENTRES;
  Places places;
  places.at_centre.resize (centres);
  for (const std::size_t stride : {PROBES, std::size_t{1}}) {
    const std::size_t count = (centres + stride - 1) / stride;
    parallelRanges (run, count, [&] (std::size_t first, std::size_t last) {
      NoiseMeter meter{positions, neighbors, {nullptr, &quarter, &sixteenth}};
      for (std::size_t i = first * stride; i < last * stride; i += stride)
        places.at_centre[i] = meter.measure (static_cast<Index> (i * CENTRES), places.are_uneven);
    });
    std::size_t noisy = 0, uneven = 0;
    for (const Place& place : places.at_centre) {
      noisy += place.noise > 0.0F ? 1 : 0;
      uneven += static_cast<double> (place.unevenness) >= UNEVEN ? 1 : 0;
    }
    places.are_noisy =
        places.are_noisy && static_cast<double> (noisy) >= FEW * static_cast<double> (count);
    places.are_uneven = places.are_uneven && uneven * stride * CENTRES >= LEAST_UNEVEN;
    if (!places.are_noisy && !places.are_uneven)
      break;
  }
  return places;
}

} // namespace

Noise
measureNoise (const Positions& positions, const CsrLists& neighbors, const RunContext& run)
{
  const std::size_t n = positions.size ();
  Noise noise;
  noise.at_point.assign (n, 0.0F);
  if (n < STRIDES.back () * LOOKED_AT)
    return noise;
  const Places places = measurePlaces (positions, neighbors, run);
  if (!places.are_noisy && !places.are_uneven)
    return noise;
  const PointSample centres = takeSample (positions, CENTRES, run);
  std::vector<Index> nearest (n); // centre of each point, in space: along the curve, values jump
  parallelPoints<std::vector<Neighbor>> (run, n, [&] (Index p, auto& found) {
    centres.nearest (positions[p], 1, found);
    nearest[p] = found.front ().point / CENTRES;
  });
  // A value around each point: around its centre, a quantile of those measured near that.
  const auto around = [&] (float Place::*value, double quantile) {
    std::vector<float> at_centre (places.at_centre.size ());
    parallelPoints<std::vector<Neighbor>, std::vector<float>> (
        run, at_centre.size (), [&] (Index c, auto& found, auto& values) {
          centres.nearest (positions[c * CENTRES], AROUND, found);
          values.clear ();
          for (const Neighbor& neighbor : found)
            values.push_back (places.at_centre[neighbor.point / CENTRES].*value);
          at_centre[c] = valueAtRank (
              values,
              static_cast<std::size_t> (quantile * static_cast<double> (values.size () - 1)));
        });
    return valuesAt (at_centre, nearest);
  };
  if (places.are_uneven) {
    noise.unevenness = around (&Place::unevenness, 0.5);
    noise.dimension = around (&Place::dimension, 0.5);
    noise.smaller_dimension = around (&Place::smaller_dimension, 0.5);
  }
  if (!places.are_noisy)
    return noise;
  // Within a terrace of quantized depth everything is flat.
  noise.at_point = around (&Place::noise, 0.9);
  std::vector<float> relative (n, 0.0F);
  for (std::size_t p = 0; p < n; ++p) {
    // A caller's search may find no neighbours: no spacing.
    const double spacing = spacingOf (positions, static_cast<Index> (p), neighbors.row (p));
    const float here = std::exchange (noise.at_point[p], 0.0F);
    if (here == 0.0F || spacing == 0.0 || here < STRONG * spacing)
      continue;
    noise.at_point[p] = here;
    relative[p] = static_cast<float> (here / spacing);
    ++noise.noisy_points;
  }
  noise.median = static_cast<double> (median (relative));
  noise.quantile_90 = static_cast<double> (quantile (relative, 0.9));
  noise.largest = static_cast<double> (quantile (relative, 1.0));
  return noise;
}

void
keepExplained (const CsrLists& neighbors, const std::vector<float>& before,
               const std::vector<float>& after, Noise& noise)
{
  // Noise explains the disagreement of the stars in a region if projection leaves at most this
  // share of it. It leaves 0.34 or less of sheets with noise of up to one spacing, 0.4 of noise of
  // 1.5 spacings, 0.54 or more of two walls, blades, thin tubes, and noise of 3 spacings.
  constexpr double UNEXPLAINED = 0.5;
  // Or if agreement rises by so much: leaves, two walls with noise of half their distance, and
  // noise of 2 spacings have no good mesh either way, but fewer crossings if projected. Thin
  // things, where projection makes them, gain 0.065 or less.
  constexpr double GAIN = 0.07;
  const std::size_t n = noise.at_point.size ();
  RegionPoints noisy{Flags (n), {}, std::vector<float> (n)};
  for (std::size_t p = 0; p < n; ++p) {
    noisy.is_inside[p] = noise.at_point[p] > 0.0F ? 1 : 0;
    noisy.value[p] = after[p] - before[p];
  }
  noisy.is_counted = noisy.is_inside;
  Flags is_explained (n);
  takeRegions (neighbors, noisy, 1, GAIN, is_explained);
  for (std::size_t p = 0; p < n; ++p) // less what it has to be
    noisy.value[p] -= static_cast<float> (1.0 - UNEXPLAINED) * (1.0F - before[p]);
  takeRegions (neighbors, noisy, 1, 0.0, is_explained);
  noise.noisy_points =
      static_cast<std::size_t> (std::count (is_explained.begin (), is_explained.end (), 1));
  for (std::size_t p = 0; p < n; ++p)
    if (is_explained[p] == 0)
      noise.at_point[p] = 0.0F;
}

Positions
projectNoisyPoints (const Positions& positions, const CsrLists& neighbors, const Noise& noise,
                    const RunContext& run)
{
  // Of the ball for the plane, in the noise of its point: the mean of as many points has a fifth of
  // the noise or less.
  constexpr double RADIUS = 8.0;
  constexpr std::size_t MOST = 60; // points of a plane
  constexpr double NARROWNESS = 4.0;
  constexpr double OUTSIDE = 4.5; // standard deviations at which the weight vanishes
  constexpr int PASSES = 2;
  const std::array<PointSample, SCALES> samples{takeSample (positions, STRIDES[0], run),
                                                takeSample (positions, STRIDES[1], run),
                                                takeSample (positions, STRIDES[2], run)};
  Positions projected = positions;
  parallelPoints<std::vector<Neighbor>> (run, positions.size (), [&] (Index p, auto& found) {
    const auto deviation = static_cast<double> (noise.at_point[p]);
    if (deviation <= 0.0)
      return;
    const Row row = neighbors.first (p, LOOKED_AT);
    const double known = (positions[row[row.size () - 1]] - positions[p]).squaredNorm ();
    const double radius = RADIUS * deviation;
    const double wanted = std::max (static_cast<double> (LOOKED_AT),
                                    static_cast<double> (row.size ()) * radius * radius / known);
    std::size_t scale = 0;
    while (scale + 1 < SCALES && wanted > static_cast<double> (MOST * STRIDES[scale]))
      ++scale;
    const auto count = static_cast<std::size_t> (
        std::min (static_cast<double> (MOST), wanted / static_cast<double> (STRIDES[scale])));
    samples[scale].nearest (positions[p], count, found);
    const double sqr_reach = found.back ().sqr_distance;
    Plane plane;
    for (int pass = 0; pass < PASSES; ++pass) {
      PlaneFit fit;
      for (const Neighbor& neighbor : found) {
        const Vector3d offset = positions[neighbor.point] - positions[p];
        double weight = std::exp (-NARROWNESS * neighbor.sqr_distance / sqr_reach);
        if (pass > 0) {
          const double share = plane.height (offset) / (OUTSIDE * deviation);
          weight *= std::abs (share) < 1.0 ? (1.0 - share * share) * (1.0 - share * share) : 0.0;
        }
        fit.add (offset, weight);
      }
      if (fit.weight () < 1.0)
        break;
      plane = fit.plane ();
    }
    projected[p] = positions[p] - plane.normal * plane.height (Vector3d::Zero ());
  });
  return projected;
}

} // namespace pcl::floater

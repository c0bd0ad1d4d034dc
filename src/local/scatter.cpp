// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/no_surface.h"

#include "core/order_statistics.h"
#include "core/parallel.h"

namespace pcl::floater {
namespace {
// Thresholds of scatter. Measures of a point: its unevenness and its dimension (see Noise), and the
// share of the triangles of the stars around it that are in the stars of all their corners.
// Measured on 24 generated families of 1.4 million points. Points strewn into volumes and lattices
// have an unevenness of 0.49 or more and a share of 0.49 or less, leaves 0.25 to 0.6 and 0.2 to
// 0.85. Sheets with noise of one spacing have 0.37 or less; thin walls, edges and contacts 0.5 or
// less, with a share of 0.4 or more. Neither measure tells these apart, nor both of them at single
// points. Regions of thin, noisy things, such as legs, ears and heads with eyes inside, look the
// same by both, but only a volume has more than two dimensions.
constexpr double STRONG_SHARE = 0.6;    // of agreeing triangles; at most so many at a strong point
constexpr double WEAK_UNEVENNESS = 0.2; // a point may be scatter from here on, ...
constexpr double WEAK_SHARE = 0.9;      // ... and with at most this share
constexpr std::size_t LEAST_STRONG = 250; // strong points of a region
// Mean of the strong points of a region that certainly is scatter: of their dimension, or of the
// one to expect at the next scale, by what it has grown since the scale before. Half way between
// surface and volume. Volumes, lattices, leaves and trees of more than 800 points have 2.57 or
// more; smaller trees 1.5 to 2.5, since the outside of a small volume counts. 16 models of 800 to
// 37,000 points with noise of up to 0.5 spacings have 2.48 or less, sheets with noise of up to 3,
// and two near ones, 2.52.
constexpr double DIMENSION = 2.55;
// Less is enough for a region whose strong points mostly are not noisy, a tree for instance. The
// noise of a sheet or body falls with the scale: these models have 0.72 or less.
constexpr double DIMENSION_IF_NOT_NOISY = 2.31, NOT_NOISY = 0.75;
// Spacing, in medians of the cloud, from which on a point is far: such triangles have 64 times the
// area, so that 2 % of them are more than half of a mesh. And that of points that may belong to a
// region of far ones.
constexpr double FAR_SPACING = 8.0, AROUND_FAR = 2.0;
// Share at far points on no surface. Points strewn into a cone have 0.28 to 0.35 on average, coarse
// walls, terrain and balls with noise of up to 0.3 of their spacings 0.54 or more. Half of the far
// points of a region must have so little.
constexpr double FAR_SHARE = 0.45;
constexpr std::size_t LEAST_FAR = 10; // far points of a region, so that the half is certain

// Share of the triangles of a star that are in the stars of all their corners.
float
agreeingShare (const Stars& stars, Index p)
{
  std::size_t triangles = 0, agreeing = 0;
  anyTriangle (stars, p, [&] (Index q, Index r) {
    ++triangles;
    agreeing += hasTriangle (stars, q, r, p) && hasTriangle (stars, r, p, q) ? 1 : 0;
    return false;
  });
  return triangles == 0 ? 0.0F : static_cast<float> (agreeing) / static_cast<float> (triangles);
}

} // namespace

std::vector<Index>
findScatter (const LocalGeometry& geometry, const Noise& noise, bool is_certain,
             const RunContext& run)
{
  constexpr std::size_t NEAREST = 20;
  const bool may_be_uneven = !noise.unevenness.empty ();
  std::vector<float> spacings = geometry.spacing;
  const auto middle = static_cast<double> (median (spacings));
  const double far_away = FAR_SPACING * middle, around_far = AROUND_FAR * middle;
  const auto far_points = std::count_if (spacings.begin (), spacings.end (), [&] (float x) {
    return static_cast<double> (x) >= far_away;
  });
  const bool may_be_far = static_cast<std::size_t> (far_points) >= LEAST_FAR;
  if (!may_be_uneven && !may_be_far)
    return {};
  const std::size_t n = geometry.spacing.size ();
  std::vector<float> share (n);
  parallelPoints (run, n, [&] (Index p) { share[p] = agreeingShare (geometry.stars, p); });
  RegionPoints strewn{Flags (n), Flags (n), std::vector<float> (n)};
  RegionPoints distant = strewn;
  parallelPoints (run, n, [&] (Index p) {
    const double unevenness = may_be_uneven ? static_cast<double> (noise.unevenness[p]) : 0.0;
    const auto spacing = static_cast<double> (geometry.spacing[p]);
    const bool is_distant = may_be_far && spacing >= around_far;
    if (unevenness < WEAK_UNEVENNESS && !is_distant)
      return;
    const Row row = geometry.neighbors.first (p, NEAREST);
    auto around = static_cast<double> (share[p]);
    for (const Index q : row)
      around += static_cast<double> (share[q]);
    around /= static_cast<double> (row.size () + 1);
    if (unevenness >= WEAK_UNEVENNESS) {
      strewn.is_inside[p] = around <= WEAK_SHARE ? 1 : 0;
      strewn.is_counted[p] = around <= STRONG_SHARE && unevenness >= UNEVEN ? 1 : 0;
      strewn.value[p] = noise.dimension[p];
    }
    distant.is_inside[p] = is_distant && around <= STRONG_SHARE ? 1 : 0;
    distant.is_counted[p] = spacing >= far_away ? 1 : 0;
    distant.value[p] = around <= FAR_SHARE ? 1.0F : 0.0F;
  });
  Flags is_scatter (n), is_not_noise (n);
  const auto take = [&] (double least_mean, Flags& taken) {
    takeRegions (geometry.neighbors, strewn, LEAST_STRONG, is_certain ? least_mean : 0.0, taken);
  };
  take (DIMENSION_IF_NOT_NOISY, is_scatter);
  if (is_certain) {
    for (std::size_t p = 0; p < n; ++p)
      strewn.value[p] = noise.at_point[p] > 0.0F ? 0.0F : 1.0F;
    take (NOT_NOISY, is_not_noise);
    for (std::size_t p = 0; p < n; ++p) {
      is_scatter[p] &= is_not_noise[p];
      strewn.value[p] = may_be_uneven ? noise.dimension[p] : 0.0F;
    }
    take (DIMENSION, is_scatter);
    for (std::size_t p = 0; p < n && may_be_uneven; ++p)
      strewn.value[p] += noise.dimension[p] - noise.smaller_dimension[p]; // at the next scale
    take (DIMENSION, is_scatter);
  }
  takeRegions (geometry.neighbors, distant, LEAST_FAR, 0.5, is_scatter);
  std::vector<Index> scatter;
  for (Index p = 0; p < n; ++p)
    if (is_scatter[p] != 0)
      scatter.push_back (p);
  return scatter;
}

} // namespace pcl::floater

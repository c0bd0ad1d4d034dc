// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/scatter.h"

#include "core/order_statistics.h"
#include "core/parallel.h"

namespace pcl::floater {
namespace {
// Share of the triangles of a star that are in the stars of all their corners.
float
agreeingShare (const Stars& stars, Index p)
{
  const Row row = stars.neighbors.row (p);
  const std::size_t triangles = row.size () - (stars.open[p] != 0 && row.size () > 0 ? 1 : 0);
  std::size_t agreeing = 0;
  for (std::size_t i = 0; i < triangles; ++i) {
    const Index q = row[i], r = row[i + 1 < row.size () ? i + 1 : 0];
    if (hasTriangle (stars, q, r, p) && hasTriangle (stars, r, p, q))
      ++agreeing;
  }
  return triangles == 0 ? 0.0F : static_cast<float> (agreeing) / static_cast<float> (triangles);
}

} // namespace

std::vector<Index>
findScatter (const LocalGeometry& geometry, const Noise& noise, double uneven, bool is_certain,
             const ScatterLimits& limits, const RunContext& run)
{
  constexpr std::size_t NEAREST = 20;
  const bool may_be_uneven = !noise.unevenness.empty ();
  std::vector<float> spacings = geometry.spacing;
  const auto middle = static_cast<double> (median (spacings));
  const double far_away = limits.far_spacing * middle, around_far = limits.around_far * middle;
  const auto far_points = std::count_if (spacings.begin (), spacings.end (), [&] (float x) {
    return static_cast<double> (x) >= far_away;
  });
  const bool may_be_far = static_cast<std::size_t> (far_points) >= limits.least_far;
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
    if (unevenness < limits.weak_unevenness && !is_distant)
      return;
    const Row row = geometry.neighbors.first (p, NEAREST);
    auto around = static_cast<double> (share[p]);
    for (const Index q : row)
      around += static_cast<double> (share[q]);
    around /= static_cast<double> (row.size () + 1);
    if (unevenness >= limits.weak_unevenness) {
      strewn.is_inside[p] = around <= limits.weak_share ? 1 : 0;
      strewn.is_counted[p] = around <= limits.strong_share && unevenness >= uneven ? 1 : 0;
      strewn.value[p] = noise.dimension[p];
    }
    distant.is_inside[p] = is_distant && around <= limits.strong_share ? 1 : 0;
    distant.is_counted[p] = spacing >= far_away ? 1 : 0;
    distant.value[p] = around <= limits.far_share ? 1.0F : 0.0F;
  });
  Flags is_scatter (n), is_not_noise (n);
  const auto take = [&] (double least_mean, Flags& taken) {
    takeRegions (geometry.neighbors, strewn, limits.least, is_certain ? least_mean : 0.0, taken);
  };
  take (limits.dimension_if_not_noisy, is_scatter);
  if (is_certain) {
    for (std::size_t p = 0; p < n; ++p)
      strewn.value[p] = noise.at_point[p] > 0.0F ? 0.0F : 1.0F;
    take (limits.not_noisy, is_not_noise);
    for (std::size_t p = 0; p < n; ++p) {
      is_scatter[p] &= is_not_noise[p];
      strewn.value[p] = may_be_uneven ? noise.dimension[p] : 0.0F;
    }
    take (limits.dimension, is_scatter);
    for (std::size_t p = 0; p < n && may_be_uneven; ++p)
      strewn.value[p] += noise.dimension[p] - noise.smaller_dimension[p]; // at the next scale
    take (limits.dimension, is_scatter);
  }
  takeRegions (geometry.neighbors, distant, limits.least_far, 0.5, is_scatter);
  std::vector<Index> scatter;
  for (Index p = 0; p < n; ++p)
    if (is_scatter[p] != 0)
      scatter.push_back (p);
  return scatter;
}

} // namespace pcl::floater

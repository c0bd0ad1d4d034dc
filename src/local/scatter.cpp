// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/scatter.h"

#include "core/disjoint_sets.h"
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
findScatter (const CsrLists& neighbors, const Stars& stars, const std::vector<float>& unevenness,
             double uneven, bool is_certain, const ScatterLimits& limits, const RunContext& run)
{
  constexpr std::size_t NEAREST = 20;
  const double strong_share = is_certain ? limits.certain_share : limits.strong_share;
  const std::size_t least = is_certain ? limits.certain_least : limits.least;
  const std::size_t n = unevenness.size ();
  std::vector<float> share (n);
  parallelRanges (run, n, [&] (std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p)
      share[p] = agreeingShare (stars, static_cast<Index> (p));
  });
  std::vector<std::uint8_t> is_weak (n), is_strong (n);
  parallelRanges (run, n, [&] (std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p) {
      const auto here = static_cast<double> (unevenness[p]);
      if (here < limits.weak_unevenness)
        continue;
      const Row row = neighbors.first (static_cast<Index> (p), NEAREST);
      auto around = static_cast<double> (share[p]);
      for (const Index q : row)
        around += static_cast<double> (share[q]);
      around /= static_cast<double> (row.size () + 1);
      is_weak[p] = around <= limits.weak_share ? 1 : 0;
      is_strong[p] = around <= strong_share && here >= uneven ? 1 : 0;
    }
  });
  DisjointSets regions (n);
  for (Index p = 0; p < n; ++p)
    if (is_weak[p] != 0)
      for (const Index q : neighbors.first (p, NEAREST))
        if (is_weak[q] != 0)
          regions.join (p, q);
  std::vector<std::size_t> strong (n, 0);
  for (Index p = 0; p < n; ++p)
    strong[regions.find (p)] += is_strong[p];
  std::vector<Index> scatter;
  for (Index p = 0; p < n; ++p)
    if (is_weak[p] != 0 && strong[regions.find (p)] >= least)
      scatter.push_back (p);
  return scatter;
}

} // namespace pcl::floater

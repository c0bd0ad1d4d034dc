// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "floater/boundary/gaps.h"

#include "core/geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl::floater {
namespace {
// Circumradius of the triangle of the origin, a and b: the product of its sides over four times its
// area.
double
circumradius (const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  const double area4 = 2.0 * std::abs (cross (a, b));
  return a.norm () * b.norm () * (a - b).norm () /
         std::max (area4, std::numeric_limits<double>::min ());
}

} // namespace

std::vector<Gap>
findGaps (const Stars& stars, const std::vector<float>& spacing, double circumradius_ratio,
          const RunContext& run)
{
  ProgressLoop progress (run, stars.neighbors.rows ());
  std::vector<Gap> gaps;
  std::vector<std::uint8_t>
      missing; // per sector of a star: sector i goes from neighbour i to the next
  for (Index p = 0; p < stars.neighbors.rows (); ++p) {
    progress.next ();
    const Row star = stars.neighbors.row (p);
    const Eigen::Vector2d* offsets = stars.offsets_in_plane.data () + stars.neighbors.offsets[p];
    const std::size_t count = star.size ();
    if (count == 0)
      continue;
    missing.assign (count, 0);
    std::size_t present = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t j = (i + 1) % count;
      const double mean_spacing = (spacing[p] + spacing[star[i]] + spacing[star[j]]) / 3.0;
      const bool has_no_triangle = stars.open[p] != 0 && i + 1 == count;
      missing[i] = has_no_triangle ||
                           circumradius (offsets[i], offsets[j]) > circumradius_ratio * mean_spacing
                       ? 1
                       : 0;
      present += missing[i] == 0 ? 1 : 0;
    }
    if (present == count)
      continue;
    if (present == 0) {
      std::size_t nearest = 0;
      for (std::size_t i = 1; i < count; ++i)
        if (offsets[i].squaredNorm () < offsets[nearest].squaredNorm ())
          nearest = i;
      gaps.push_back ({p, star[nearest], star[nearest]});
      continue;
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (missing[i] == 0 || missing[(i + count - 1) % count] != 0)
        continue;
      std::size_t end = i;
      while (missing[end % count] != 0)
        ++end;
      gaps.push_back ({p, star[i], star[end % count]});
    }
  }
  return gaps;
}

} // namespace pcl::floater

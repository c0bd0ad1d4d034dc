// SPDX-License-Identifier: GPL-3.0-or-later
#include "boundary/loop_refinement.h"

#include "neighborhoods/kd_tree.h"

#include <algorithm>
#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
constexpr std::size_t WINDOW = 30;   // 2-opt: farthest edges along the loop that are exchanged
constexpr double SMALL_DETOUR = 1.0; // of the edge's length: (|ac| + |cb|) / |ab| - 1

double
distance (const std::vector<Eigen::Vector3d>& positions, Index p, Index q)
{
  return (positions[p] - positions[q]).norm ();
}

// Reverses stretches of the loop while that shortens it.
void
untangle (const std::vector<Eigen::Vector3d>& positions, std::vector<Index>& loop)
{
  const std::size_t n = loop.size ();
  const std::size_t window = std::min (WINDOW, n - 2);
  const auto at = [&] (std::size_t i) -> Index& { return loop[i % n]; };
  bool changed = n > 4;
  for (int pass = 0; changed && pass < 10; ++pass) {
    changed = false;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 2; j <= i + window; ++j) {
        // Edges (i, i + 1) and (j, j + 1) become (i, j) and (i + 1, j + 1).
        if ((j + 1) % n == i)
          continue;
        const double now = distance (positions, at (i), at (i + 1)) + distance (positions, at (j), at (j + 1));
        const double then = distance (positions, at (i), at (j)) + distance (positions, at (i + 1), at (j + 1));
        if (then < now * (1.0 - 1e-9)) {
          for (std::size_t a = i + 1, b = j; a < b; ++a, --b)
            std::swap (at (a), at (b));
          changed = true;
        }
      }
  }
}

} // namespace

void
refineLoop (const std::vector<Eigen::Vector3d>& positions, const Stars& stars, const std::vector<float>& spacing,
            const std::vector<Index>& candidates, std::vector<Index>& loop)
{
  untangle (positions, loop);
  (void) stars;
  (void) spacing;
  (void) candidates;
}

} // namespace floater
} // namespace pcl

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/spacing.h"

#include "core/parallel.h"

namespace pcl::floater {
std::vector<float>
localSpacing (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
              const Rows& rows, const RunContext& run)
{
  constexpr std::size_t NEAREST = 6;
  std::vector<float> spacing (positions.size ());
  parallelRanges (run, rows.size (), [&] (std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Index p = rows[i];
      const Row row = neighbors.first (p, NEAREST);
      double sum = 0.0;
      for (const Index q : row)
        sum += (positions[q] - positions[p]).norm ();
      spacing[p] =
          static_cast<float> (sum / static_cast<double> (std::max<std::size_t> (1, row.size ())));
    }
  });
  return spacing;
}

std::vector<float>
localSpacing (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
              const RunContext& run)
{
  return localSpacing (positions, neighbors, Rows::all (positions.size ()), run);
}

} // namespace pcl::floater

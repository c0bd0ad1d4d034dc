// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/star_agreement.h"

#include "core/parallel.h"

#include <algorithm>

namespace pcl::floater {
bool
hasTriangle (const Stars& stars, Index p, Index q, Index r)
{
  const Row row = stars.neighbors.row (p);
  const std::size_t count = row.size ();
  for (std::size_t i = 0; i < count; ++i) {
    if (row[i] != q)
      continue;
    const bool last = i + 1 == count;
    if (!(last && stars.open[p] != 0) && row[last ? 0 : i + 1] == r)
      return true;
    return !(i == 0 && stars.open[p] != 0) && row[i == 0 ? count - 1 : i - 1] == r;
  }
  return false;
}

std::vector<float>
starAgreement (const Stars& stars, const RunContext& run)
{
  std::vector<float> agreement (stars.open.size (), 0.0F);
  parallelRanges (run, agreement.size (), [&] (std::size_t first, std::size_t last) {
    for (std::size_t point = first; point < last; ++point) {
      const auto p = static_cast<Index> (point);
      const Row row = stars.neighbors.row (p);
      std::size_t mutual = 0;
      for (const Index q : row) {
        const Row other = stars.neighbors.row (q);
        mutual += std::find (other.begin (), other.end (), p) != other.end () ? 1 : 0;
      }
      if (row.size () > 0)
        agreement[p] = static_cast<float> (mutual) / static_cast<float> (row.size ());
    }
  });
  return agreement;
}

} // namespace pcl::floater

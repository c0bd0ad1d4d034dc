// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/star_agreement.h"

#include "core/parallel.h"

namespace pcl
{
namespace floater
{
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
      const std::size_t count = row.size ();
      const std::size_t sectors = stars.open[p] != 0 && count > 0 ? count - 1 : count;
      std::size_t agreed = 0;
      for (std::size_t s = 0; s < sectors; ++s) {
        const Index q = row[s], r = row[s + 1 == count ? 0 : s + 1];
        agreed += hasTriangle (stars, q, r, p) && hasTriangle (stars, r, p, q) ? 1 : 0;
      }
      if (sectors > 0)
        agreement[p] = static_cast<float> (agreed) / static_cast<float> (sectors);
    }
  });
  return agreement;
}

} // namespace floater
} // namespace pcl

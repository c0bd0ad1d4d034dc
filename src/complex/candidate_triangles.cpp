// SPDX-License-Identifier: GPL-3.0-or-later
#include "complex/candidate_triangles.h"

#include "common/parallel.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
// True if q and r are joined by a triangle of the star of p, in either order.
bool
starHas (const Stars& stars, Index p, Index q, Index r)
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

// Sets size and agreement.
void
measure (const std::vector<Eigen::Vector3d>& positions, const std::vector<Eigen::Vector3f>& normals,
         const std::vector<float>& spacing, Candidate& candidate)
{
  const auto& [a, b, c] = candidate.corners;
  const Eigen::Vector3d ab = positions[b] - positions[a];
  const Eigen::Vector3d ac = positions[c] - positions[a];
  const Eigen::Vector3d normal = ab.cross (ac);
  const double double_area = normal.norm ();
  const double mean_spacing = (spacing[a] + spacing[b] + spacing[c]) / 3.0;
  const double circumradius =
      ab.norm () * ac.norm () * (positions[c] - positions[b]).norm () / (2.0 * double_area);
  candidate.size = static_cast<float> (circumradius / mean_spacing);
  const Eigen::Vector3f unit = (normal / double_area).cast<float> ();
  candidate.agreement = 1.0F;
  for (Index p : candidate.corners)
    candidate.agreement = std::min (candidate.agreement, std::abs (unit.dot (normals[p])));
}

} // namespace

std::vector<Candidate>
findCandidates (const std::vector<Eigen::Vector3d>& positions, const Stars& stars,
                const std::vector<Eigen::Vector3f>& normals, const std::vector<float>& spacing,
                const CandidateLimits& limits, int threads)
{
  const std::size_t n = positions.size ();
  std::vector<std::vector<Candidate>> ranges ((n + RANGE_LENGTH - 1) / RANGE_LENGTH);
  parallelRanges (n, threads, [&] (std::size_t first, std::size_t last) {
    std::vector<Candidate>& range = ranges[first / RANGE_LENGTH];
    range.reserve (5 * (last - first) / 2);
    for (std::size_t i = first; i < last; ++i) {
      const auto p = static_cast<Index> (i);
      const Row row = stars.neighbors.row (p);
      if (row.size () < 2)
        continue;
      const std::size_t sectors = stars.open[p] != 0 ? row.size () - 1 : row.size ();
      for (std::size_t s = 0; s < sectors; ++s) {
        const Index q = row[s], r = row[s + 1 == row.size () ? 0 : s + 1];
        const bool in_q = starHas (stars, q, r, p), in_r = starHas (stars, r, p, q);
        if ((in_q && q < p) || (in_r && r < p))
          continue; // theirs to propose
        Candidate candidate{{p, q, r}, static_cast<std::uint8_t> (1 + in_q + in_r), 0.0F, 0.0F};
        measure (positions, normals, spacing, candidate);
        const std::size_t rank = candidate.votes - 1U;
        if (candidate.size <= limits.size[rank] && candidate.agreement >= limits.agreement[rank])
          range.push_back (candidate);
      }
    }
  });
  std::vector<Candidate> candidates;
  std::size_t count = 0;
  for (const std::vector<Candidate>& range : ranges)
    count += range.size ();
  candidates.reserve (count);
  for (std::vector<Candidate>& range : ranges) {
    candidates.insert (candidates.end (), range.begin (), range.end ());
    std::vector<Candidate> ().swap (range);
  }
  return candidates;
}

} // namespace floater
} // namespace pcl

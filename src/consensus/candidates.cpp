// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "consensus/candidates.h"

#include "core/geometry.h"
#include "core/parallel.h"

#include <algorithm>
#include <cmath>

namespace pcl::floater {
namespace {
void
setCircumradiusRatio (const std::vector<Eigen::Vector3d>& positions,
                      const std::vector<float>& spacing, const std::vector<float>& reach,
                      Candidate& candidate)
{
  const auto& [a, b, c] = candidate.corners;
  double mean_spacing = (spacing[a] + spacing[b] + spacing[c]) / 3.0;
  if (!reach.empty ())
    mean_spacing =
        std::max (mean_spacing, static_cast<double> (REACH_AS_SPACING *
                                                     std::max ({reach[a], reach[b], reach[c]})));
  candidate.circumradius_ratio =
      static_cast<float> (circumradius (positions[a], positions[b], positions[c]) / mean_spacing);
}

// Sets the normal agreement and `clockwise` from the corners.
void
setNormalAgreement (const std::vector<Eigen::Vector3d>& positions,
                    const std::vector<Eigen::Vector3f>& normals, Candidate& candidate)
{
  const auto& [a, b, c] = candidate.corners;
  const Eigen::Vector3d normal = areaVector (positions[a], positions[b], positions[c]);
  const Eigen::Vector3f unit = (normal / normal.norm ()).cast<float> ();
  candidate.normal_agreement = 1.0F;
  candidate.clockwise = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3f& at_corner = normals[candidate.corners[i]];
    candidate.normal_agreement =
        std::min (candidate.normal_agreement, std::abs (unit.dot (at_corner)));
    if (normal.dot (at_corner.cast<double> ()) < 0.0)
      candidate.clockwise = static_cast<std::uint8_t> (candidate.clockwise | (1U << i));
  }
}

} // namespace

std::vector<Candidate>
findCandidates (const std::vector<Eigen::Vector3d>& positions, const Stars& stars,
                const std::vector<Eigen::Vector3f>& normals, const std::vector<float>& spacing,
                const CandidateLimits& limits, const RunContext& run)
{
  RangeLists<Candidate> ranges (positions.size ());
  parallelRanges (run, positions.size (), [&] (std::size_t first, std::size_t last) {
    std::vector<Candidate>& range = ranges.of (first);
    range.reserve (2 * (last - first));
    for (auto p = static_cast<Index> (first); p < last; ++p) {
      const Row row = stars.neighbors.row (p);
      if (row.size () < 2)
        continue;
      const std::size_t sectors = stars.open[p] != 0 ? row.size () - 1 : row.size ();
      for (std::size_t s = 0; s < sectors; ++s) {
        const Index q = row[s], r = row[s + 1 == row.size () ? 0 : s + 1];
        const bool in_q = hasTriangle (stars, q, r, p), in_r = hasTriangle (stars, r, p, q);
        if ((in_q && q < p) || (in_r && r < p))
          continue; // q or r is its first corner
        Candidate candidate{{p, q, r}, static_cast<std::uint8_t> (1 + in_q + in_r), 0, false, 0.0F,
                            0.0F};
        setCircumradiusRatio (positions, spacing, stars.reach, candidate);
        setNormalAgreement (positions, normals, candidate);
        const std::size_t rank = candidate.votes - 1U;
        if (candidate.circumradius_ratio <= limits.circumradius_ratio[rank] &&
            candidate.normal_agreement >= limits.normal_agreement[rank])
          range.push_back (candidate);
      }
    }
  });
  return ranges.join ();
}

} // namespace pcl::floater

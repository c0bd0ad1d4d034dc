// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "consensus/candidates.h"

#include "core/geometry.h"
#include "core/parallel.h"
#include "local/stars.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

void
append (const Candidate& candidate, std::size_t sure_ranks, CandidateLists& lists)
{
  const std::size_t rank = normalAgreementRank (candidate);
  if (candidate.votes == 3 && rank < sure_ranks)
    lists.sure.push_back (
        {candidate.corners, candidate.clockwise, static_cast<std::uint8_t> (rank), false});
  else
    lists.doubtful.push_back (candidate);
}

// Joins the lists of all ranges, and frees each one after it is copied.
CandidateLists
concatenate (std::vector<CandidateLists>& ranges)
{
  if (ranges.size () == 1)
    return std::move (ranges.front ());
  std::size_t sure = 0, doubtful = 0;
  for (const CandidateLists& range : ranges) {
    sure += range.sure.size ();
    doubtful += range.doubtful.size ();
  }
  CandidateLists all;
  all.sure.reserve (sure);
  all.doubtful.reserve (doubtful);
  for (CandidateLists& range : ranges) {
    all.sure.insert (all.sure.end (), range.sure.begin (), range.sure.end ());
    all.doubtful.insert (all.doubtful.end (), range.doubtful.begin (), range.doubtful.end ());
    range = {};
  }
  return all;
}

} // namespace

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

CandidateLists
findCandidates (const std::vector<Eigen::Vector3d>& positions, const Stars& stars,
                const std::vector<Eigen::Vector3f>& normals, const std::vector<float>& spacing,
                const Rows& rows, const CandidateLimits& limits, const RunContext& run)
{
  const std::size_t sure_ranks = limits.sure_ranks;
  std::vector<CandidateLists> ranges ((rows.size () + RANGE_LENGTH - 1) / RANGE_LENGTH);
  parallelRanges (run, rows.size (), [&] (std::size_t first, std::size_t last) {
    CandidateLists& range = ranges[first / RANGE_LENGTH];
    range.sure.reserve (2 * (last - first));
    for (std::size_t i = first; i < last; ++i) {
      const Index p = rows[i];
      const Row row = stars.neighbors.row (p);
      if (row.size () < 2)
        continue;
      const std::size_t sectors = stars.open[p] != 0 ? row.size () - 1 : row.size ();
      for (std::size_t s = 0; s < sectors; ++s) {
        const Index q = row[s], r = row[s + 1 == row.size () ? 0 : s + 1];
        const bool in_q = hasTriangle (stars, q, r, p), in_r = hasTriangle (stars, r, p, q);
        if ((in_q && q < p) || (in_r && r < p))
          continue; // q or r is its first corner
        Candidate candidate{{p, q, r}, static_cast<std::uint8_t> (1 + in_q + in_r), 0, 0.0F, 0.0F};
        setCircumradiusRatio (positions, spacing, stars.reach, candidate);
        setNormalAgreement (positions, normals, candidate);
        const std::size_t rank = candidate.votes - 1U;
        if (candidate.circumradius_ratio <= limits.circumradius_ratio[rank] &&
            candidate.normal_agreement >= limits.normal_agreement[rank])
          append (candidate, sure_ranks, range);
      }
    }
  });
  CandidateLists all = concatenate (ranges);
  all.sure_ranks = limits.sure_ranks;
  return all;
}

} // namespace pcl::floater

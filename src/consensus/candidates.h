// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Candidate triangles, from the stars.
#pragma once

#include "local/stars.h"

#include <array>
#include <cstddef>
#include <vector>

namespace pcl::floater {
/// A triangle in the stars of one, two or all three of its corners.
struct Candidate
{
  Triangle corners;         ///< the first is the smallest one whose star has the triangle;
                            ///< anti-clockwise seen from the normal of that corner
  std::uint8_t votes;       ///< corners whose stars have it, 1 to 3
  std::uint8_t clockwise;   ///< bit i: clockwise seen from the normal of corner i
  bool is_taken;            ///< into the consensus
  float circumradius_ratio; ///< circumradius over the mean spacing of its corners
  float normal_agreement;   ///< least |cosine| between its normal and those of its corners
};

/// Number of classes of normal agreement, evenly spaced in the cosine from 1 to 0.
constexpr std::size_t AGREEMENT_RANKS = 32;

/// Class of a candidate's normal agreement: 0 for the best, below AGREEMENT_RANKS.
inline std::size_t
normalAgreementRank (const Candidate& candidate)
{
  const auto steps = static_cast<std::size_t> ((1.0F - candidate.normal_agreement) *
                                               static_cast<float> (AGREEMENT_RANKS));
  return steps < AGREEMENT_RANKS ? steps : AGREEMENT_RANKS - 1;
}

/// Thresholds of candidates, stricter for fewer votes. Chosen by hand; no measurement is recorded.
struct CandidateLimits
{
  std::array<float, 3> circumradius_ratio{2.0F, 2.0F, 3.0F}; ///< maximum for 1, 2 and 3 votes;
                                                             ///< circumradii over spacings
  std::array<float, 3> normal_agreement{0.4F, 0.2F, 0.1F};   ///< minimum for 1, 2 and 3 votes;
                                                             ///< cosines
  std::size_t sure_ranks = 4; ///< classes of normal agreement in which a candidate of three votes
                              ///< is sure, as most triangles are: it enters the consensus unless it
                              ///< contradicts the orientation. At most AGREEMENT_RANKS; 4: cosines
                              ///< above 0.875
};

/// The triangles of all stars that are within the limits, each once, ordered by their first corner
/// and around it. O(entries of the stars).
/// \param normals for the normal agreement: those of the stars, or others on the same side
/// \param spacing of each point (see localSpacing)
std::vector<Candidate>
findCandidates (const std::vector<Eigen::Vector3d>& positions, const Stars& stars,
                const std::vector<Eigen::Vector3f>& normals, const std::vector<float>& spacing,
                const CandidateLimits& limits, const RunContext& run);

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The triangles that stars propose for the surface.
#pragma once

#include "local/stars.h"
#include "points/rows.h"

#include <array>
#include <cstddef>
#include <vector>

namespace pcl::floater {
/// A triangle of the star of one, two or all three of its corners.
struct Candidate
{
  Triangle corners;         ///< the first is the smallest one whose star has the triangle;
                            ///< anti-clockwise if the normal of that corner points to the viewer
  std::uint8_t votes;       ///< corners whose stars have it, 1 to 3
  std::uint8_t clockwise;   ///< bit i: clockwise if the normal of corner i points to the viewer
  float circumradius_ratio; ///< circumradius by the mean spacing of its corners
  float normal_agreement;   ///< least |cosine| between its normal and those of its corners
};

/// A candidate of three votes with a good normal agreement. It is in the consensus unless it
/// contradicts the orientation. Most triangles are of this kind, so it takes 16 bytes only.
struct SureTriangle
{
  Triangle corners;
  std::uint8_t clockwise; ///< as in Candidate
  std::uint8_t rank;      ///< see normalAgreementRank; below CandidateLimits::sure_ranks
  bool is_taken;          ///< it is in the consensus (see buildConsensus)
};

struct CandidateLists
{
  std::vector<SureTriangle> sure;  ///< ordered by their first corners
  std::vector<Candidate> doubtful; ///< all others, in the same order
  std::uint8_t sure_ranks = 0;     ///< the ranks of sure triangles are below
};

/// Number of classes of normal agreement. They divide the cosines from 1 down to 0 evenly.
constexpr std::size_t AGREEMENT_RANKS = 32;

/// The class of a candidate's normal agreement: 0 for the best, below AGREEMENT_RANKS.
inline std::size_t
normalAgreementRank (const Candidate& candidate)
{
  const auto steps = static_cast<std::size_t> ((1.0F - candidate.normal_agreement) *
                                               static_cast<float> (AGREEMENT_RANKS));
  return steps < AGREEMENT_RANKS ? steps : AGREEMENT_RANKS - 1;
}

/// Which triangles of stars become candidates. Those of fewer votes must be better. All values were
/// chosen by hand; no measurement is recorded.
struct CandidateLimits
{
  std::array<float, 3> circumradius_ratio{2.0F, 2.0F, 3.0F}; ///< the largest of 1, 2 and 3 votes;
                                                             ///< circumradii by spacings
  std::array<float, 3> normal_agreement{0.4F, 0.2F, 0.1F};   ///< the least of 1, 2 and 3 votes;
                                                             ///< cosines
  std::uint8_t sure_ranks = 4; ///< classes of normal agreement in which a candidate of three votes
                               ///< is sure, at most AGREEMENT_RANKS; 4: cosines above 0.875
};

/// Sets the normal agreement and `clockwise` from the corners. The normals are unit vectors.
void
setNormalAgreement (const std::vector<Eigen::Vector3d>& positions,
                    const std::vector<Eigen::Vector3f>& normals, Candidate& candidate);

/// The triangles of all stars that are within the limits, each once, ordered by their first corner
/// and around it. O(entries of the stars).
/// \param normals for the normal agreement: those of the stars, or others on the same side of each
///                point
/// \param spacing of each point (see localSpacing)
/// \param rows    points whose stars are looked at; a candidate is found if its first corner is
///                one of them, and all arrays have to be right at its corners
CandidateLists
findCandidates (const std::vector<Eigen::Vector3d>& positions, const Stars& stars,
                const std::vector<Eigen::Vector3f>& normals, const std::vector<float>& spacing,
                const Rows& rows, const CandidateLimits& limits, const RunContext& run);

} // namespace pcl::floater

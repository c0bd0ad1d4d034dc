// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles that the stars propose for the surface.
#pragma once

#include "local/stars.h"

#include <array>
#include <cstddef>
#include <vector>

namespace pcl
{
namespace floater
{
/// A triangle of one, two or three stars.
struct Candidate
{
  Triangle corners;         ///< the first is the smallest point whose star has the triangle;
                            ///< anti-clockwise seen along that point's normal
  std::uint8_t votes;       ///< stars of its corners that have it, 1 to 3
  std::uint8_t clockwise;   ///< bit i: it runs clockwise seen along the normal of corner i
  float circumradius_ratio; ///< circumradius in mean spacings of its corners
  float normal_agreement;   ///< smallest |cosine| between its normal and those of its corners
};

/// A candidate of three votes whose normal agrees so well with those of its corners that only a
/// contradiction of orientations keeps it out of the consensus. Most triangles are of this kind.
struct SureTriangle
{
  Triangle corners;
  std::uint8_t clockwise; ///< as in Candidate
  std::uint8_t rank;      ///< class of agreement, the best 0, below SURE_RANKS
  bool is_taken;          ///< it is in the consensus; see surface_complex.h
};

/// Candidates, 16 bytes for each that is sure.
struct CandidateLists
{
  std::vector<SureTriangle> sure;  ///< ordered by their first corner
  std::vector<Candidate> doubtful; ///< the others, in the same order
};

/// Classes of agreement, evenly from cosine 1 down to 0.
constexpr std::size_t AGREEMENT_RANKS = 32;
constexpr std::size_t SURE_RANKS = 4; ///< cosine above 0.875: tells alone how normals are oriented

/// Class of a candidate's agreement, below AGREEMENT_RANKS.
inline std::size_t
normalAgreementRank (const Candidate& candidate)
{
  const auto steps = static_cast<std::size_t> ((1.0F - candidate.normal_agreement) *
                                               static_cast<float> (AGREEMENT_RANKS));
  return steps < AGREEMENT_RANKS ? steps : AGREEMENT_RANKS - 1;
}

/// How large and how far turned away from its corners' normals a triangle may be, by its votes:
/// what few stars agree on must look the better.
struct CandidateLimits
{
  std::array<float, 3> circumradius_ratio{2.0F, 2.0F, 3.0F}; ///< of 1, 2 and 3 votes, in spacings
  std::array<float, 3> normal_agreement{0.4F, 0.2F, 0.1F};   ///< cosines
};

/// Sets agreement and clockwise.
void
setNormalAgreement (const std::vector<Eigen::Vector3d>& positions,
                    const std::vector<Eigen::Vector3f>& normals, Candidate& candidate);

/// Triangles of stars within the limits whose first corner is one of `rows`, each once, ordered by
/// their first corner and around it. Needs the stars of the points of these stars, and those
/// points' normals and spacings. O(entries).
/// \param normals by which triangles are judged: those of the stars, or others on the same side
/// \param spacing of each point (see localSpacing)
CandidateLists
findCandidates (const std::vector<Eigen::Vector3d>& positions, const Stars& stars,
                const std::vector<Eigen::Vector3f>& normals, const std::vector<float>& spacing,
                const CandidateLimits& limits, const RunContext& run);

} // namespace floater
} // namespace pcl

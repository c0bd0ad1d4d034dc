// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles that the stars propose for the surface.
#pragma once

#include "common/types.h"

#include <vector>

namespace pcl
{
namespace floater
{
/// A triangle of one, two or three stars.
struct Candidate
{
  Triangle corners;   ///< the first is the smallest point whose star has the triangle;
                      ///< anti-clockwise seen along that point's normal
  std::uint8_t votes; ///< stars of its corners that have it, 1 to 3
  float size;         ///< circumradius in mean spacings of its corners
  float agreement;    ///< smallest |cosine| between its normal and those of its corners
};

/// How large and how far turned away from its corners' normals a triangle may be, by its votes:
/// what few stars agree on must look the better.
struct CandidateLimits
{
  std::array<float, 3> size{2.0F, 2.0F, 3.0F};      ///< of 1, 2 and 3 votes, in spacings
  std::array<float, 3> agreement{0.4F, 0.2F, 0.1F}; ///< cosines
};

/// All triangles of stars within the limits, each once, ordered by their first corner and around
/// it. O(entries).
/// \param normals by which triangles are judged: those of the stars, or others on the same side
/// \param spacing of each point (see localSpacing)
std::vector<Candidate>
findCandidates (const std::vector<Eigen::Vector3d>& positions, const Stars& stars,
                const std::vector<Eigen::Vector3f>& normals, const std::vector<float>& spacing,
                const CandidateLimits& limits, int threads);

} // namespace floater
} // namespace pcl

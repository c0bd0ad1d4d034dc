// SPDX-License-Identifier: GPL-3.0-or-later
// An order of the unknowns that keeps the factors small, from where their points lie.
#pragma once

#include "floater/solvers/linear_system.h"

#include <array>
#include <vector>

namespace pcl
{
namespace floater
{
/// A set of unknowns that follow each other in the order: those of its halves, then its cut.
struct DissectedSet
{
  Index begin, cut, end;       ///< places in the order: all of it, where its cut begins, its end
  std::array<Index, 2> halves; ///< the sets before the cut; NONE: there is none
};

/// Nested dissection (George 1973): the unknowns are parted in two halves by a set between them,
/// the cut, that comes last, and so on in each half.
struct Dissection
{
  std::vector<int> order;         ///< the unknown that comes i-th, for every i
  std::vector<DissectedSet> sets; ///< all unknowns first, a set before its halves
};

/// Halves are told by the coordinate in which a set is widest; the cut is the smallest one (see
/// vertex_cut.h) within a band around the median. No pair of the pattern joins two halves. On a
/// surface the factors are about as small as with METIS, and a tenth to a quarter smaller than with
/// AMD, in a quarter of METIS's time. O(n log n) in practice; the same for every number of threads.
/// \param pattern   symmetric, without the diagonal (see symmetricPattern)
/// \param points    of each unknown
/// \param positions per point
Dissection
dissect (const CsrLists& pattern, const std::vector<Index>& points,
         const std::vector<Eigen::Vector3d>& positions, const RunContext& run);

/// The pattern of A + A^T without the diagonal.
CsrLists
symmetricPattern (const LinearSystem& system);

/// The order alone.
std::vector<int>
dissectUnknowns (const LinearSystem& system, const std::vector<Eigen::Vector3d>& positions,
                 const RunContext& run);

} // namespace floater
} // namespace pcl

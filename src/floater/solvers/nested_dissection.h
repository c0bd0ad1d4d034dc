// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// An order of the unknowns by where their points are, which keeps the factors small.
#pragma once

#include "floater/solvers/linear_system.h"

#include <array>
#include <vector>

namespace pcl::floater {
/// A set of unknowns that are consecutive in the order: those of its two halves, then its cut.
struct DissectedSet
{
  Index begin;                 ///< place in the order at which the set begins
  Index cut;                   ///< place at which its cut begins
  Index end;                   ///< one past its last place
  std::array<Index, 2> halves; ///< the sets before the cut; NONE: there is none
};

/// Nested dissection (George 1973): a cut parts the unknowns into two halves and comes last, and so
/// on in each half.
struct Dissection
{
  std::vector<int> order;         ///< entry i is the unknown that comes i-th
  std::vector<DissectedSet> sets; ///< the set of all unknowns first; a set comes before its halves
};

/// Dissects by where the points are: the halves of a set lie on either side of the median of the
/// coordinate in which the set is widest, and the cut is the smallest one within a band around the
/// median (see vertex_cut.h). No pair of the pattern joins two halves. On surfaces the factors are
/// about as small as with METIS, in a quarter of its time, and a tenth to a quarter smaller than
/// with AMD. O(n log n) in practice; the same for every number of threads.
/// \param pattern   symmetric, without the diagonal (see symmetricPattern ())
/// \param points    the point of each unknown
/// \param positions per point
Dissection
dissect (const CsrLists& pattern, const std::vector<Index>& points,
         const std::vector<Eigen::Vector3d>& positions, const RunContext& run);

/// The pattern of A + A^T without the diagonal. O(entries log (row length)).
CsrLists
symmetricPattern (const LinearSystem& system);

/// The order of dissect () for a system.
/// \param positions per point
std::vector<int>
dissectUnknowns (const LinearSystem& system, const std::vector<Eigen::Vector3d>& positions,
                 const RunContext& run);

} // namespace pcl::floater

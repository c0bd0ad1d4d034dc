// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fillings of loops that cross other sheets of the mesh, and others for these loops.
#pragma once

#include "mesh/loops.h"
#include "mesh/self_intersections.h"
#include "mesh/triangle_cost.h"

namespace pcl::floater {
/// Finds loops whose fillings cross the mesh, and fills them by triangles of least cost that do not: a gap
/// between sheets is no place for another one. Both are kept: crossings show where sheets are near,
/// and making zones anew there in space may be better than another filling.
class CrossedFillings
{
public:
  /// O(n), and O(1) without fillings; plus some microseconds for each of the m^2 edges in a loop of m
  /// points that is crossed.
  /// \param mesh   with the fillings, which are its last triangles
  /// \param before number of triangles before they came
  /// \param loops  of the mesh before
  CrossedFillings (const TriangleMesh& mesh, std::size_t before,
                   const std::vector<BoundaryLoop>& loops, const Positions& positions,
                   const TriangleCost& cost, const RunContext& run);

  /// Whether no filling crosses the mesh. Other fillings do not count.
  bool empty () const { return before_.empty (); }

  /// Replaces crossed fillings at chosen points. A loop without another filling is left open if it may
  /// be, and if some of what it crosses is at no loop. (Where two loops are linked, each has only the
  /// other's surroundings in its way.)
  /// \param is_chosen of each point, such as a corner of a crossing pair
  /// \param[in,out] loops keep_open and LoopJudgement::is_too_deep are set for those that are left open
  /// \return the mesh before with these fillings; empty if none would be replaced
  std::vector<Triangle> replaced (const Flags& is_chosen, bool may_stay_open,
                                  std::vector<BoundaryLoop>& loops) const;

private:
  Index loopOf (const Triangle& t) const { return loop_of_[t[0]]; }

  std::vector<Index> loop_of_;          // of each point, or NONE
  Flags is_crossed_, is_pierced_;       // of each loop; the latter by triangles that are at no loop
  Flags is_clear_;                      // of each loop: it has another filling
  std::vector<Triangle> before_;        // the mesh without fillings
  std::vector<Triangle> first_, other_; // fillings, of all loops and of those that are crossed
};

} // namespace pcl::floater

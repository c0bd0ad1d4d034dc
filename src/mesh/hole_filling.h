// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fills boundary loops by triangulated polygons.
#pragma once

#include "mesh/loops.h"
#include "mesh/triangle_cost.h"

namespace pcl::floater {
/// Triangulates polygons at least cost by dynamic programming over their sub-polygons (Barequet and
/// Sharir 1995 "Filling gaps in the boundary of a polyhedron"; Liepa 2003 "Filling holes in
/// meshes"). O(m^3) time and 16 m^2 bytes for m corners. Reuses its memory.
class PolygonFilling
{
  static constexpr auto ALL = [] (Index, Index, Index) { return true; };

public:
  explicit PolygonFilling (const RunContext& run) : run_ (run) {}

  /// Triangles of least total cost between the corners of a closed polygon.
  /// \param polygon corners, anti-clockwise
  /// \param cost    (p, q, r): of a triangle, 0 or more
  /// \param allowed (p, q): whether an edge may join two corners that are not adjacent
  /// \param fits    (p, q, r): whether a triangle is allowed; asked from the cheapest on, since that may
  ///                take more time than the costs
  /// \return m - 2 triangles, anti-clockwise; empty if m < 3 or no triangulation is allowed
  template <typename Cost, typename Allowed, typename Fits = decltype (ALL)>
  std::vector<Triangle> fill (const std::vector<Index>& polygon, Cost&& cost, Allowed&& allowed,
                              const Fits& fits = ALL)
  {
    const std::size_t m = polygon.size ();
    best_.assign (m * m, {0.0, 0});
    ProgressLoop progress (run_);
    for (std::size_t span = 2; span < m; ++span)
      for (std::size_t i = 0; i + span < m; ++i) {
        progress.next ();
        const std::size_t j = i + span;
        Choice& choice = best_[i * m + j];
        choice = {std::numeric_limits<double>::infinity (), 0};
        if (span < m - 1 && !allowed (polygon[i], polygon[j]))
          continue;
        for (std::size_t apex = i + 1; apex < j; ++apex) {
          const double before = best_[i * m + apex].cost + best_[apex * m + j].cost;
          if (before >= choice.cost)
            continue;
          const double sum = before + cost (polygon[i], polygon[apex], polygon[j]);
          if (sum < choice.cost)
            choice = {sum, apex};
        }
        if (!std::isfinite (choice.cost) || fits (polygon[i], polygon[choice.apex], polygon[j]))
          continue;
        next_.clear (); // the other triangles at this edge
        for (std::size_t apex = i + 1; apex < j; ++apex)
          if (const double before = best_[i * m + apex].cost + best_[apex * m + j].cost;
              apex != choice.apex && std::isfinite (before))
            next_.push_back ({before + cost (polygon[i], polygon[apex], polygon[j]), apex});
        std::sort (next_.begin (), next_.end (), [] (const Choice& one, const Choice& other) {
          return std::tie (one.cost, one.apex) < std::tie (other.cost, other.apex);
        });
        const auto found = std::find_if (next_.begin (), next_.end (), [&] (const Choice& one) {
          return fits (polygon[i], polygon[one.apex], polygon[j]);
        });
        choice =
            found != next_.end () ? *found : Choice{std::numeric_limits<double>::infinity (), 0};
      }
    std::vector<Triangle> triangles;
    if (m >= 3 && std::isfinite (best_[m - 1].cost))
      collect (polygon, 0, m - 1, triangles);
    return triangles;
  }

private:
  // The best triangulation of the sub-polygon from corner i to corner j: its cost, and the third
  // corner of the triangle at the edge from i to j.
  struct Choice
  {
    double cost;
    std::size_t apex;
  };

  void collect (const std::vector<Index>& polygon, std::size_t i, std::size_t j,
                std::vector<Triangle>& triangles) const
  {
    if (j - i < 2)
      return;
    const std::size_t apex = best_[i * polygon.size () + j].apex;
    triangles.push_back ({polygon[i], polygon[apex], polygon[j]});
    collect (polygon, i, apex, triangles);
    collect (polygon, apex, j, triangles);
  }

  RunContext run_;
  std::vector<Choice> best_; // [i * m + j]
  std::vector<Choice> next_;
};

/// The cost of a triangle (p, q, r) of a filling: TriangleCost, plus a cost of its area.
/// \param step mean edge of the loop
inline auto
fillingCost (const TriangleCost& cost, const Positions& positions, double step)
{
  // Per doubled area in squared steps. Large enough that sheets that end face to face are joined across
  // the narrow gap, instead of each being closed on its own. Chosen by hand; no measurement is recorded.
  constexpr double AREA_COST = 200.0;
  return [&cost, &positions, area_cost = AREA_COST / (step * step)] (Index p, Index q, Index r) {
    return cost (p, q, r).cost +
           area_cost * areaVector (positions[p], positions[q], positions[r]).norm ();
  };
}

/// Fills every loop that is not kept open by triangles of least total cost between its points (see
/// PolygonFilling). A loop of more than 128 points is first shortened by repeatedly cutting off the ear
/// of least cost. Edges of the mesh are not used twice. A loop is kept open if this would be needed, if
/// it goes round a single triangle, or if there are no triangles that fit. O(m^3) for a loop of m
/// points up to that limit, O(m log m) beyond; loops on all threads.
/// \param loops BoundaryLoop::keep_open is set for those that could not be filled
/// \param fits  whether a triangle may be in a filling. Each loop has a copy of it
/// \return number of loops filled
/// \throws std::logic_error if the loops do not belong to the mesh
std::size_t
fillHoles (
    TriangleMesh& mesh, std::vector<BoundaryLoop>& loops, const Positions& positions,
    const TriangleCost& cost, const RunContext& run,
    const std::function<bool (const Triangle&)>& fits = [] (const Triangle&) { return true; });

/// Fills loops whose fillings cross the mesh by triangles of least cost that do not: a gap between sheets is no
/// place for another one. A loop without such a filling is left open if it may be, and if some of what it
/// crosses is at no loop. (Where two loops are linked, each has only the other's surroundings in its way.)
/// O(n), plus some microseconds for each of the m^2 edges in a loop of m points that is crossed.
/// \param filled the mesh with its fillings, which are its last triangles
/// \param before number of triangles before they came
/// \param[in,out] loops of the mesh before. keep_open and LoopJudgement::is_too_deep are set for those that are
///     left open
/// \param[in,out] is_chosen of each point: a loop there may change; then: it has changed
/// \return the mesh with these fillings; without triangles if there are none
TriangleMesh
refillCrossed (const std::vector<Triangle>& filled, std::size_t before,
               std::vector<BoundaryLoop>& loops, Flags& is_chosen, bool may_stay_open,
               const Positions& positions, const TriangleCost& cost, const RunContext& run);

} // namespace pcl::floater

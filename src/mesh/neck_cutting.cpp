// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/neck_cutting.h"

#include "core/order_statistics.h"
#include "core/parallel.h"
#include "mesh/hole_filling.h"
#include "mesh/self_intersections.h"
#include "mesh/triangle_cost.h"
#include "mesh/vertex_splits.h"

#include <map>
#include <set>

namespace pcl::floater {
namespace {
// Edges of a loop that is tried. False handles of thinned scans had loops of 3 to 9. Longer loops close
// more of the true holes through plates: of 292 generated bodies in 16 with 12 edges, in 8 with 9.
constexpr std::size_t LONGEST_LOOP = 9;

// Around a loop: two that go or are changed by flips, and one that stays.
constexpr std::size_t RINGS = 3;

// Area of the largest circle without a point, in squared spacings, in an even sample: points at the centres
// of discs that leave no room for one more. Caps of a wider neck have too few points. It is cut only if the
// mesh is bent less by the same factor, or if its triangles become no larger.
constexpr double LARGEST_EMPTY_AREA = 2.0;

// Triangles of a mesh that go, and those that come.
struct Replacement
{
  std::vector<Index> gone;
  std::vector<Triangle> triangles;
  double cost_left = 1.0; // share
};

// The mesh around a loop, with points numbered from 0.
class NeckCut
{
public:
  NeckCut (const TriangleMesh& mesh, const std::vector<Index>& loop, const Positions& positions,
           const LocalGeometry& geometry, const RunContext& run)
      : mesh_ (mesh), run_ (run), points_ (loop), cost_ (positions_, normals_, &spacing_)
  {
    for (std::size_t ring = 0; ring < RINGS; ++ring)
      addRing (mesh, points_);
    is_rim_.assign (points_.size (), 0);
    for (const Index p : loop)
      loop_.push_back (numberOf (p));
    positions_ = valuesAt (positions, points_);
    double spacing = 0.0;
    for (std::size_t i = 0; i < loop.size (); ++i) {
      axis_ += 0.5 * (positions[loop[i]] - positions[loop[0]])
                         .cross (positions[loop[(i + 1) % loop.size ()]] - positions[loop[0]]);
      spacing += geometry.meshSpacing ()[loop[i]] / static_cast<double> (loop.size ());
    }
    most_left_ = std::min (1.0, LARGEST_EMPTY_AREA * spacing * spacing / axis_.norm ());
    axis_.normalize ();
    normals_ = valuesAt (geometry.stars.normals, points_);
    spacing_ = valuesAt (geometry.meshSpacing (), points_);
    neighbors_ = rowsWithin (geometry.neighbors, points_);
    std::vector<Index> fan;
    for (Index i = 0; i < points_.size (); ++i) {
      mesh.fan (points_[i], fan);
      for (const Index t : fan) {
        const Triangle& c = mesh.triangles[t];
        const Triangle corners{numberOf (c[0]), numberOf (c[1]), numberOf (c[2])};
        if (isCorner (corners, NONE))
          is_rim_[i] = 1;
        else if (*std::min_element (corners.begin (), corners.end ()) == i) {
          triangles_.push_back (t);
          before_.triangles.push_back (corners);
        }
      }
    }
  }

  // The cheapest cut; nothing if all cost too much.
  Replacement cut ()
  {
    Replacement best;
    if (!before_.connect (points_.size (), run_, &is_rim_) || !markSides ())
      return best;
    const double crossings_before = crossingCost (before_);
    const std::multiset<Edge> rim = rimEdges (before_);
    for (const std::uint8_t sides : {BOTH, LEFT, RIGHT}) {
      TriangleMesh after;
      if (!takeOut (sides, after.triangles) || !after.connect (points_.size (), run_, &is_rim_))
        continue;
      addMissingPoints (after, positions_, neighbors_, run_);
      if (std::count (after.triangle_of.begin (), after.triangle_of.end (), NONE) > 0 ||
          rimEdges (after) != rim)
        continue;
      double size_before = 0.0, size = 0.0;
      const double cost_before = bending (before_, after, size_before) + crossings_before;
      double cost = bending (after, before_, size);
      const double most =
          std::min (best.cost_left, size > size_before ? most_left_ : 1.0) * cost_before;
      if (cost < most) // else crossings are not looked for
        cost += crossingCost (after);
      if (cost < most)
        best = {triangles_, std::move (after.triangles), cost / cost_before};
    }
    for (Triangle& t : best.triangles)
      t = {points_[t[0]], points_[t[1]], points_[t[2]]};
    return best;
  }

private:
  using Edge = std::pair<Index, Index>;
  static constexpr std::uint8_t LEFT = 1, RIGHT = 2, BOTH = LEFT | RIGHT; // of the loop

  Index numberOf (Index p) const { return placeIn (points_, p); }

  bool isOnLoop (Index p) const
  {
    return std::find (loop_.begin (), loop_.end (), p) != loop_.end ();
  }

  // Marks the triangles at the loop as left or right of it.
  // \return false if some are both
  bool markSides ()
  {
    side_.assign (before_.triangles.size (), 0);
    std::set<Edge> along;
    for (std::size_t i = 0; i < loop_.size (); ++i)
      along.emplace (loop_[i], loop_[i + 1 < loop_.size () ? i + 1 : 0]);
    std::vector<Index> found;
    for (Index t = 0; t < before_.triangles.size (); ++t)
      for (std::uint8_t side = 0; side < 3; ++side) {
        const Index p = before_.from ({t, side}), q = before_.to ({t, side});
        if (along.count ({p, q}) + along.count ({q, p}) > 0) {
          side_[t] = side_[t] | (along.count ({p, q}) > 0 ? LEFT : RIGHT);
          found.push_back (t);
        }
      }
    for (std::size_t i = 0; i < found.size (); ++i)
      for (std::uint8_t side = 0; side < 3; ++side) {
        const MeshEdge e{found[i], side};
        const Index p = before_.from (e), q = before_.to (e),
                    t = before_.neighbors[e.triangle][side];
        if (t != NONE && side_[t] == 0 && (isOnLoop (p) || isOnLoop (q)) &&
            along.count ({p, q}) + along.count ({q, p}) == 0) {
          side_[t] = side_[found[i]];
          found.push_back (t);
        }
      }
    return std::count (side_.begin (), side_.end (), BOTH) == 0;
  }

  // Takes the triangles at the loop on some sides out, and fills the two openings.
  bool takeOut (std::uint8_t sides, std::vector<Triangle>& triangles) const
  {
    std::set<Edge> gone;
    for (Index t = 0; t < before_.triangles.size (); ++t) {
      const Triangle& c = before_.triangles[t];
      if ((side_[t] & sides) == 0)
        triangles.push_back (c);
      else
        for (std::size_t i = 0; i < 3; ++i)
          gone.emplace (c[i], c[(i + 1) % 3]);
    }
    std::map<Index, Index> around;
    for (const auto& [p, q] : gone)
      if (gone.count ({q, p}) == 0 && !around.emplace (p, q).second)
        return false; // openings with a common point
    std::size_t openings = 0;
    for (; !around.empty (); ++openings) {
      std::vector<Index> opening;
      for (auto at = around.begin (); at != around.end (); at = around.find (opening.back ())) {
        opening.push_back (at->second);
        around.erase (at);
      }
      const std::vector<Triangle> filling = fill (opening);
      if (filling.empty ())
        return false;
      triangles.insert (triangles.end (), filling.begin (), filling.end ());
    }
    return openings == 2;
  }

  std::vector<Triangle> fill (const std::vector<Index>& opening) const
  {
    double length = 0.0;
    for (std::size_t i = 0; i < opening.size (); ++i)
      length += (positions_[opening[i]] - positions_[opening[i > 0 ? i - 1 : opening.size () - 1]])
                    .norm ();
    return PolygonFilling (run_).fill (
        opening, fillingCost (cost_, positions_, length / static_cast<double> (opening.size ())),
        [this] (Index p, Index q) { return !mesh_.hasEdge (points_[p], points_[q]); });
  }

  // Edges between points on the rim, which the mesh outside may have as well.
  std::multiset<Edge> rimEdges (const TriangleMesh& mesh) const
  {
    std::multiset<Edge> edges;
    for (const Triangle& t : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i)
        if (const Index p = t[i], q = t[(i + 1) % 3]; is_rim_[p] != 0 && is_rim_[q] != 0)
          edges.emplace (p, q);
    return edges;
  }

  // How much the mesh is bent where another one has other triangles: the angles between triangles, times
  // the lengths of their edges. Edges along the axis count little: they make the neck round, and a
  // long thin limb would have more of them than two caps. Planes of points are not asked: near a false
  // neck, they are those of no sheet.
  // \param size out: the mean area of these triangles, doubled
  double bending (const TriangleMesh& mesh, const TriangleMesh& other, double& size) const
  {
    Flags is_common;
    std::vector<Vector3d> normals;
    normals.reserve (mesh.triangles.size ());
    std::size_t changed = 0;
    for (const Triangle& t : mesh.triangles) {
      is_common.push_back (other.triangleWith (t) != NONE ? 1 : 0);
      const Vector3d area = areaVectorOf (t, positions_);
      normals.push_back (area.normalized ());
      if (is_common.back () == 0)
        size += (area.norm () - size) / static_cast<double> (++changed);
    }
    double sum = 0.0;
    for (Index t = 0; t < mesh.triangles.size (); ++t)
      for (std::uint8_t side = 0; side < 3; ++side)
        if (const Index u = mesh.neighbors[t][side]; // NONE is above
            u < t && (is_common[t] == 0 || is_common[u] == 0)) {
          const Vector3d edge = positions_[mesh.to ({t, side})] - positions_[mesh.from ({t, side})];
          sum += edge.norm () * edge.normalized ().cross (axis_).squaredNorm () *
                 std::acos (std::clamp (normals[t].dot (normals[u]), -1.0, 1.0));
        }
    return sum;
  }

  // A crossing pair counts like a fold along a mean edge.
  double crossingCost (const TriangleMesh& mesh) const
  {
    double length = 0.0;
    std::size_t edges = 0;
    for (Index t = 0; t < mesh.triangles.size (); ++t)
      for (std::uint8_t side = 0; side < 3; ++side)
        if (mesh.neighbors[t][side] < t) {
          length += (positions_[mesh.to ({t, side})] - positions_[mesh.from ({t, side})]).norm ();
          ++edges;
        }
    const auto pairs =
        static_cast<double> (findSelfIntersections (mesh.triangles, positions_, run_).size ());
    return PI * pairs * length / static_cast<double> (edges);
  }

  const TriangleMesh& mesh_;
  const RunContext run_;
  std::vector<Index> points_, triangles_; // of the mesh
  std::vector<Index> loop_;
  Positions positions_;
  Vector3d axis_ = Vector3d::Zero (); // of the neck
  double most_left_;                  // of the cost, as a share
  Normals normals_;
  std::vector<float> spacing_;
  CsrLists neighbors_;
  TriangleCost cost_;
  TriangleMesh before_;
  Flags side_;   // of each triangle before: its sides of the loop
  Flags is_rim_; // of each point: some of its triangles are not here
};

} // namespace

std::size_t
cutNecks (TriangleMesh& mesh, const Positions& positions, const LocalGeometry& geometry,
          Flags is_skipped, const RunContext& run)
{
  std::size_t cuts = 0;
  is_skipped.resize (positions.size (), 0);
  while (true) {
    const std::vector<std::vector<Index>> loops =
        findNeckLoops (mesh, positions, is_skipped, LONGEST_LOOP, run);
    std::vector<Replacement> found (loops.size ());
    parallelTasks (run, loops.size (), [&] (std::size_t i) {
      found[i] = NeckCut (mesh, loops[i], positions, geometry, run.withThreads (1)).cut ();
    });
    std::stable_sort (found.begin (), found.end (),
                      [] (const auto& a, const auto& b) { return a.cost_left < b.cost_left; });
    std::vector<Index> again; // points around the cuts: elsewhere, no loop is cut in the next round
    TriangleMesh changed;
    Flags is_gone (mesh.triangles.size (), 0);
    for (const Replacement& cut : found) {
      if (cut.gone.empty () || std::any_of (cut.gone.begin (), cut.gone.end (),
                                            [&] (Index t) { return is_gone[t] != 0; }))
        continue;
      for (const Index t : cut.gone) {
        is_gone[t] = 1;
        again.insert (again.end (), mesh.triangles[t].begin (), mesh.triangles[t].end ());
      }
      changed.triangles.insert (changed.triangles.end (), cut.triangles.begin (),
                                cut.triangles.end ());
      ++cuts;
    }
    if (again.empty ())
      return cuts;
    for (Index t = 0; t < mesh.triangles.size (); ++t)
      if (is_gone[t] == 0)
        changed.triangles.push_back (mesh.triangles[t]);
    if (!changed.connect (positions.size (), run))
      throw std::logic_error ("a neck was cut so that the mesh does not fit");
    mesh = std::move (changed);
    for (std::size_t ring = 0; ring < RINGS + LONGEST_LOOP / 2; ++ring)
      addRing (mesh, again);
    Flags is_far (positions.size (), 1);
    for (const Index p : again)
      is_far[p] = is_skipped[p];
    is_skipped = std::move (is_far);
  }
}

} // namespace pcl::floater

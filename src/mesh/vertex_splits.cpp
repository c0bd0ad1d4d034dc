// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/vertex_splits.h"

#include "core/geometry.h"
#include "points/kd_tree.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl::floater {
namespace {
// The triangles around a vertex and the places between them, anti-clockwise. Triangle k has the
// places k and k + 1 as its other corners. Around a closed fan, places count on.
struct Fan
{
  std::vector<Index> triangles;
  std::vector<Index> ring;
  bool is_closed = false;

  std::size_t size () const { return triangles.size (); }
  Index triangle (std::size_t k) const { return triangles[k % size ()]; }
  Index at (std::size_t k) const { return ring[k % ring.size ()]; }
};

// A part of the fan around a vertex, from one place to another.
struct Cut
{
  double cost = std::numeric_limits<double>::infinity ();
  Index vertex = NONE;
  std::size_t from = 0, to = 0;
  // Whether a triangle with both points closes the cut there; at the boundary, one is enough.
  bool has_begin = true, has_end = true;
};

class VertexSplitter
{
public:
  VertexSplitter (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
                  const SplitLimits& limits, const RunContext& run)
      : mesh_ (mesh), positions_ (positions), limits_ (limits), tree_ (positions, run)
  {
    mesh_.triangle_of.resize (positions.size (), NONE);
  }

  bool add (Index p)
  {
    const Cut cut = bestNear (p);
    if (cut.vertex != NONE)
      split (cut, p);
    return cut.vertex != NONE;
  }

private:
  Eigen::Vector3d normalOf (Index t) const
  {
    return t == NONE ? Eigen::Vector3d (Eigen::Vector3d::Zero ())
                     : areaVectorOf (mesh_.triangles[t], positions_).normalized ();
  }
  void setFan (Index v) { fan_.is_closed = mesh_.fan (v, fan_.triangles, fan_.ring); }
  Cut bestCut (Index v, Index p);

  Cut bestNear (Index p)
  {
    tree_.nearestIf (
        positions_[p], Eigen::Vector3d::Zero (), KdTree::EVERYWHERE, limits_.near,
        [this] (const Neighbor& neighbor, const Eigen::Vector3d& /*position*/) {
          return mesh_.triangle_of[neighbor.point] != NONE;
        },
        found_);
    Cut best;
    for (const Neighbor& neighbor : found_) {
      Cut cut = bestCut (neighbor.point, p);
      cut.cost += limits_.far * std::sqrt (neighbor.sqr_distance);
      if (cut.cost < best.cost)
        best = cut;
    }
    return best;
  }

  Index newTriangle ()
  {
    mesh_.triangles.emplace_back ();
    mesh_.neighbors.push_back ({NONE, NONE, NONE});
    return static_cast<Index> (mesh_.triangles.size () - 1);
  }

  void split (const Cut& cut, Index p);

  TriangleMesh& mesh_;
  const std::vector<Eigen::Vector3d>& positions_;
  const SplitLimits& limits_;
  KdTree tree_;
  Fan fan_;
  std::vector<Neighbor> found_;
  // Of bestCut: at each place, at v and at the new point.
  struct Place
  {
    double length_v, length_p;          // of the spokes
    double spoke_v, spoke_p;            // their costs
    double rim;                         // change of the edge that follows
    double first, last;                 // of a cut that begins or ends there
    Eigen::Vector3d normal_v, normal_p; // of the triangle that follows
    Eigen::Vector3d needle;             // normal of the triangle (v, place, p)
  };
  std::vector<Place> places_;
  std::vector<double> rims_, spokes_v_, spokes_p_; // sums of those before a place
};

Cut
VertexSplitter::bestCut (Index v, Index p)
{
  setFan (v);
  const std::size_t m = fan_.size (), ring = fan_.ring.size (),
                    count = fan_.is_closed ? 2 * m : ring;
  const bool is_open = !fan_.is_closed;
  const Eigen::Vector3d at_v = positions_[v], at_p = positions_[p], offset = at_p - at_v;
  const double gap = offset.norm ();
  places_.resize (ring);
  double longest = 0.0;
  for (std::size_t k = 0; k < ring; ++k) {
    Place& place = places_[k];
    const Eigen::Vector3d& here = positions_[fan_.ring[k]];
    place.length_v = (here - at_v).norm ();
    place.length_p = (here - at_p).norm ();
    longest = std::max (longest, place.length_v);
  }
  const double penalty = limits_.fold * longest;
  // Cost of an edge between triangles of these normals; 0 if one of them is zero.
  const auto bend = [penalty] (const Eigen::Vector3d& a, const Eigen::Vector3d& b, double length) {
    const double cosine = a.dot (b);
    if (a.isZero (0.0) || b.isZero (0.0))
      return 0.0;
    return length * std::acos (std::clamp (cosine, -1.0, 1.0)) + (cosine < -0.5 ? penalty : 0.0);
  };
  const Eigen::Vector3d none = Eigen::Vector3d::Zero ();
  for (std::size_t k = 0; k < ring; ++k) {
    Place& place = places_[k];
    const Eigen::Vector3d& here = positions_[fan_.ring[k]];
    place.normal_v = place.normal_p = none;
    place.rim = 0.0;
    if (k < m) {
      const Eigen::Vector3d& next = positions_[fan_.at (k + 1)];
      const Eigen::Vector3d area = (here - at_p).cross (next - at_p);
      const Index t = fan_.triangles[k];
      const Eigen::Vector3d outer = normalOf (mesh_.neighbors[t][mesh_.sideOf (t, v)]);
      const double length = (next - here).norm ();
      place.normal_v = (here - at_v).cross (next - at_v).normalized ();
      place.normal_p = area.normalized ();
      const double sides = place.length_p * places_[(k + 1) % ring].length_p;
      place.rim = bend (place.normal_p, outer, length) - bend (place.normal_v, outer, length) +
                  (area.norm () < limits_.flat * sides ? penalty : 0.0);
    }
  }
  for (std::size_t k = 0; k < ring; ++k) {
    Place& place = places_[k];
    const Place& before = places_[(k + ring - 1) % ring];
    const bool is_start = is_open && k == 0, is_end = is_open && k == m;
    const Eigen::Vector3d before_v = is_start ? none : before.normal_v,
                          before_p = is_start ? none : before.normal_p;
    const Eigen::Vector3d area = (positions_[fan_.ring[k]] - at_v).cross (offset);
    place.needle = area.normalized ();
    const Eigen::Vector3d back = -place.needle;
    const double flat = area.norm () < limits_.flat * place.length_v * gap ? penalty : 0.0;
    const double rim_v = limits_.boundary * place.length_v;
    const double rim_p = limits_.boundary * place.length_p;
    place.spoke_v = is_start || is_end ? rim_v : bend (before_v, place.normal_v, place.length_v);
    place.spoke_p = bend (before_p, place.normal_p, place.length_p);
    place.first = flat + (is_start ? rim_v : bend (before_v, place.needle, place.length_v)) +
                  (is_end ? rim_p : bend (place.needle, place.normal_p, place.length_p));
    place.last = flat + (is_start ? rim_p : bend (before_p, back, place.length_p)) +
                 (is_end ? rim_v : bend (back, place.normal_v, place.length_v));
  }
  for (auto* sums : {&rims_, &spokes_v_, &spokes_p_})
    sums->assign (count + 2, 0.0);
  for (std::size_t k = 0; k <= count; ++k) {
    const Place& place = places_[k % ring];
    rims_[k + 1] = rims_[k] + place.rim;
    spokes_v_[k + 1] = spokes_v_[k] + place.spoke_v;
    spokes_p_[k + 1] = spokes_p_[k] + place.spoke_p;
  }
  Cut best;
  const auto consider = [&] (std::size_t from, std::size_t to, bool has_begin, bool has_end) {
    double cost = rims_[to] - rims_[from];
    if (to > from + 1)
      cost += spokes_p_[to] - spokes_p_[from + 1];
    cost -= spokes_v_[has_end ? to + 1 : ring] - spokes_v_[has_begin ? from : 0];
    const Place &first = places_[from % ring], &last = places_[to % ring];
    if (has_begin)
      cost += first.first;
    if (has_end)
      cost += last.last;
    if (has_begin != has_end)
      cost += limits_.boundary * (longest + (has_begin && from < m ? places_[m].length_p
                                             : has_end && to > 0   ? places_[0].length_p
                                                                   : 0.0));
    else if (cost < best.cost)
      cost += bend (first.needle, -last.needle, gap);
    if (cost < best.cost)
      best = {cost, v, from, to, has_begin, has_end};
  };
  // Of a huge fan only narrow parts, which take no quadratic time.
  const std::size_t widest = limits_.most_cuts / m + 1;
  for (std::size_t from = 0; from < (is_open ? ring : m); ++from)
    for (std::size_t to = from + 1; to < (is_open ? ring : from + m) && to <= from + widest; ++to)
      consider (from, to, true, true);
  if (is_open)
    for (std::size_t k = 0; k < ring; ++k) {
      consider (k, m, true, false);
      consider (0, k, false, true);
    }
  return best;
}

// Gives p, which has no triangle, the part of a fan, and closes the cuts by triangles with both
// points.
void
VertexSplitter::split (const Cut& cut, Index p)
{
  const Index v = cut.vertex;
  setFan (v);
  const std::size_t m = fan_.size (), from = cut.from, to = cut.to;
  // Triangles beside the ends of the part, outside and inside; NONE at the boundary.
  const Index before = from > 0 || fan_.is_closed ? fan_.triangle (from + m - 1) : NONE;
  const Index after = to < m || fan_.is_closed ? fan_.triangle (to) : NONE;
  const Index first = to > from ? fan_.triangle (from) : NONE;
  const Index last = to > from ? fan_.triangle (to + m - 1) : NONE;
  const Index from_point = fan_.at (from), to_point = fan_.at (to);
  for (std::size_t k = from; k < to; ++k) {
    Triangle& corners = mesh_.triangles[fan_.triangle (k)];
    corners[mesh_.sideOf (fan_.triangle (k), v)] = p;
  }
  const Index begin = cut.has_begin ? newTriangle () : NONE;
  const Index end = cut.has_end ? newTriangle () : NONE;
  if (begin != NONE) {
    mesh_.triangles[begin] = {v, from_point, p};
    mesh_.neighbors[begin] = {first, end, before};
    // The edge of `before` that follows its first corner on the ring.
    if (before != NONE)
      mesh_.neighbors[before][TriangleMesh::next (mesh_.sideOf (before, v))] = begin;
    if (first != NONE)
      mesh_.neighbors[first][TriangleMesh::previous (mesh_.sideOf (first, p))] = begin;
  }
  if (end != NONE) {
    mesh_.triangles[end] = {v, p, to_point};
    mesh_.neighbors[end] = {last, after, begin};
    if (last != NONE)
      mesh_.neighbors[last][TriangleMesh::next (mesh_.sideOf (last, p))] = end;
    if (after != NONE)
      mesh_.neighbors[after][TriangleMesh::previous (mesh_.sideOf (after, v))] = end;
  }
  mesh_.triangle_of[v] = mesh_.triangle_of[p] = begin != NONE ? begin : end;
}

} // namespace

std::size_t
splitVertices (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               const std::vector<Index>& added, const SplitLimits& limits, const RunContext& run)
{
  std::size_t points = 0;
  VertexSplitter splitter (mesh, positions, limits, run);
  ProgressLoop progress (run, added.size ());
  for (const Index p : added) {
    points += splitter.add (p) ? 1 : 0;
    progress.next ();
  }
  return points;
}

} // namespace pcl::floater

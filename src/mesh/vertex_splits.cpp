// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/vertex_splits.h"

#include "core/geometry.h"
#include "mesh/fan_cutter.h"
#include "points/kd_tree.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl::floater {
namespace {
class VertexSplitter
{
public:
  VertexSplitter (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
                  const SplitLimits& limits, const RunContext& run)
      : mesh_ (mesh), cutter_ (mesh), positions_ (positions), limits_ (limits),
        tree_ (positions, run)
  {
    mesh_.triangle_of.resize (positions.size (), NONE);
  }

  bool add (Index p)
  {
    const Cut cut = bestNear (p, limits_.near);
    if (cut.vertex != NONE)
      cutter_.split (cut, p);
    return cut.vertex != NONE;
  }

  bool isAtFold (Index p);
  bool move (Index p);
  void dropUnused (const RunContext& run) { cutter_.dropUnused (run); }

private:
  Eigen::Vector3d normalOf (Index t) const
  {
    return t == NONE ? Eigen::Vector3d (Eigen::Vector3d::Zero ())
                     : areaVectorOf (mesh_.triangles[t], positions_).normalized ();
  }
  Cut bestCut (Index v, Index p, const Return* given = nullptr);
  Cut bestNear (Index p, std::size_t near);

  TriangleMesh& mesh_;
  FanCutter cutter_;
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
VertexSplitter::bestCut (Index v, Index p, const Return* given)
{
  cutter_.setFan (v, fan_);
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
  best.vertex = NONE;
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
    else if (cost < best.cost || given != nullptr)
      cost += bend (first.needle, -last.needle, gap);
    if (cost < best.cost)
      best = {cost, v, from, to, has_begin, has_end};
  };
  if (given != nullptr) {
    const Cut cut = FanCutter::cutAt (fan_, *given);
    consider (cut.from, cut.to, cut.has_begin, cut.has_end);
    return best;
  }
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

Cut
VertexSplitter::bestNear (Index p, std::size_t near)
{
  tree_.nearestIf (
      positions_[p], Eigen::Vector3d::Zero (), KdTree::EVERYWHERE, near,
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

bool
VertexSplitter::isAtFold (Index p)
{
  if (mesh_.triangle_of[p] == NONE)
    return false;
  cutter_.setFan (p, fan_);
  for (std::size_t k = 0; k < fan_.size (); ++k) {
    const Index t = fan_.triangles[k];
    const Eigen::Vector3d here = normalOf (t);
    const std::uint8_t side = mesh_.sideOf (t, p);
    if (here.dot (normalOf (mesh_.neighbors[t][side])) < -0.5 ||
        here.dot (normalOf (mesh_.neighbors[t][TriangleMesh::next (side)])) < -0.5)
      return true;
  }
  return false;
}

// Takes a point out and puts it back where that costs least.
// \return false if that is where it is
bool
VertexSplitter::move (Index p)
{
  cutter_.setFan (p, fan_);
  const std::vector<Index> around = fan_.ring;
  double best = -1e-9 * (positions_[p] - positions_[around.front ()]).norm ();
  Index into = NONE;
  for (const Index v : around) {
    const Return back = cutter_.takeOut (p, v);
    if (back.vertex == NONE)
      continue;
    const double as_it_was =
        bestCut (v, p, &back).cost + limits_.far * (positions_[p] - positions_[v]).norm ();
    const double gain = bestNear (p, limits_.near_folds).cost - as_it_was;
    if (gain < best) {
      best = gain;
      into = v;
    }
    cutter_.putBack (back, p);
  }
  if (into == NONE)
    return false;
  cutter_.takeOut (p, into);
  cutter_.split (bestNear (p, limits_.near_folds), p);
  return true;
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
  bool has_moved = true;
  for (std::size_t pass = 0; has_moved && pass < limits.passes; ++pass) {
    has_moved = false;
    for (const Index p : added)
      if (splitter.isAtFold (p)) {
        has_moved = splitter.move (p) || has_moved;
        progress.next ();
      }
  }
  splitter.dropUnused (run);
  return points;
}

} // namespace pcl::floater

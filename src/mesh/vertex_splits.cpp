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
  Index centre = NONE;
  std::vector<Index> triangles;
  std::vector<Index> ring;
  bool is_closed = false;

  std::size_t size () const { return triangles.size (); }
  Index triangle (std::size_t k) const { return triangles[k % size ()]; }
  Index at (std::size_t k) const { return ring[k % ring.size ()]; }
  // The last place; around a closed fan, the first one again.
  std::size_t last () const { return size (); }
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

// Where a point was that was taken out: the places of its part, by their points.
struct Return
{
  Index vertex = NONE, from = NONE, to = NONE; // NONE: no cut there
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
    const Cut cut = bestNear (p, limits_.near);
    if (cut.vertex != NONE)
      split (cut, p);
    return cut.vertex != NONE;
  }

  bool isAtFold (Index p);
  bool move (Index p);
  void dropUnused (const RunContext& run);

private:
  void setFan (Index v, Fan& fan) const;
  Eigen::Vector3d normal (Index a, Index b, Index c) const
  {
    return (positions_[b] - positions_[a]).cross (positions_[c] - positions_[a]).normalized ();
  }
  Eigen::Vector3d normalOf (Index t) const
  {
    return t == NONE ? Eigen::Vector3d (Eigen::Vector3d::Zero ())
                     : normal (mesh_.triangles[t][0], mesh_.triangles[t][1], mesh_.triangles[t][2]);
  }
  Cut bestCut (Index v, Index p, const Return* given = nullptr);
  Cut bestNear (Index p, std::size_t near);
  void split (const Cut& cut, Index p);
  void splitAgain (const Return& place, Index p);
  Return takeOut (Index p, Index v);
  Cut cutAt (const Return& place) const;
  Index newTriangle ();
  void relink (Index t, Index before, Index now);

  TriangleMesh& mesh_;
  const std::vector<Eigen::Vector3d>& positions_;
  const SplitLimits& limits_;
  KdTree tree_;
  std::vector<Index> unused_; // triangles
  Fan fan_, other_fan_;
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

void
VertexSplitter::setFan (Index v, Fan& fan) const
{
  fan.centre = v;
  mesh_.fan (v, fan.triangles);
  fan.ring.clear ();
  Index next = NONE;
  for (const Index t : fan.triangles) {
    const std::uint8_t side = mesh_.sideOf (t, v);
    fan.ring.push_back (mesh_.triangles[t][TriangleMesh::next (side)]);
    next = mesh_.triangles[t][TriangleMesh::previous (side)];
  }
  fan.is_closed = next == fan.ring.front ();
  if (!fan.is_closed)
    fan.ring.push_back (next);
}

Cut
VertexSplitter::bestCut (Index v, Index p, const Return* given)
{
  setFan (v, fan_);
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
      cost += limits_.boundary * (gap + (has_begin && from < m ? places_[m].length_p
                                         : has_end && to > 0   ? places_[0].length_p
                                                               : 0.0));
    else if (cost < best.cost || given != nullptr)
      cost += bend (first.needle, -last.needle, gap);
    if (cost < best.cost)
      best = {cost, v, from, to, has_begin, has_end};
  };
  if (given != nullptr) {
    const Cut cut = cutAt (*given);
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

// The cut of fan_ that gives a point its part back.
Cut
VertexSplitter::cutAt (const Return& place) const
{
  const auto placeOf = [this] (Index p) {
    return static_cast<std::size_t> (std::find (fan_.ring.begin (), fan_.ring.end (), p) -
                                     fan_.ring.begin ());
  };
  Cut cut;
  cut.vertex = place.vertex;
  cut.has_begin = place.from != NONE;
  cut.has_end = place.to != NONE;
  cut.from = cut.has_begin ? placeOf (place.from) : 0;
  cut.to = cut.has_end ? placeOf (place.to) : fan_.last ();
  if (fan_.is_closed && cut.to <= cut.from)
    cut.to += fan_.size ();
  return cut;
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

Index
VertexSplitter::newTriangle ()
{
  if (!unused_.empty ()) {
    const Index t = unused_.back ();
    unused_.pop_back ();
    return t;
  }
  mesh_.triangles.emplace_back ();
  mesh_.neighbors.push_back ({NONE, NONE, NONE});
  return static_cast<Index> (mesh_.triangles.size () - 1);
}

// Replaces a neighbour of t.
void
VertexSplitter::relink (Index t, Index before, Index now)
{
  if (t != NONE)
    for (Index& neighbor : mesh_.neighbors[t])
      if (neighbor == before) {
        neighbor = now;
        return;
      }
}

void
VertexSplitter::split (const Cut& cut, Index p)
{
  const Index v = cut.vertex;
  setFan (v, fan_);
  const std::size_t m = fan_.size (), from = cut.from, to = cut.to;
  // Triangles beside the ends of the part, outside and inside; NONE at the boundary.
  const auto outside = [&] (std::size_t k) { return fan_.triangle (k); };
  const Index before = from > 0 || fan_.is_closed ? outside (from + m - 1) : NONE;
  const Index after = to < m || fan_.is_closed ? outside (to) : NONE;
  const Index first = to > from ? outside (from) : NONE;
  const Index last = to > from ? outside (to + m - 1) : NONE;
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

// Collapses p into its neighbour v.
// \return how to undo it; vertex NONE if it would change the topology: nothing is done then
Return
VertexSplitter::takeOut (Index p, Index v)
{
  setFan (p, other_fan_);
  setFan (v, fan_);
  const auto place = std::find (other_fan_.ring.begin (), other_fan_.ring.end (), v);
  const auto k = static_cast<std::size_t> (place - other_fan_.ring.begin ());
  const std::size_t m = other_fan_.size ();
  // The triangles that go: (p, v, from), which follows v around p, and (p, to, v) before it.
  const Index begin = k < m ? other_fan_.triangles[k] : NONE;
  const Index end = k > 0                  ? other_fan_.triangles[k - 1]
                    : other_fan_.is_closed ? other_fan_.triangles[m - 1]
                                           : NONE;
  Return result;
  result.from = begin != NONE ? other_fan_.at (k + 1) : NONE;
  result.to = end != NONE ? other_fan_.at (k + other_fan_.ring.size () - 1) : NONE;
  const bool is_boundary_edge = begin == NONE || end == NONE;
  if (!other_fan_.is_closed && !is_boundary_edge)
    return {};
  if (m == 3 && fan_.size () == 3 && other_fan_.is_closed && fan_.is_closed)
    return {};
  for (const Index q : other_fan_.ring)
    if (q != v && q != result.from && q != result.to &&
        std::find (fan_.ring.begin (), fan_.ring.end (), q) != fan_.ring.end ())
      return {};
  // The two other edges of a triangle that goes must not both be of the boundary.
  const auto across = [this] (Index t, Index corner) {
    return mesh_.neighbors[t][mesh_.sideOf (t, corner)];
  };
  for (const Index t : {begin, end})
    if (t != NONE && across (t, p) == NONE && across (t, v) == NONE)
      return {};
  if (begin != NONE && end != NONE && across (begin, p) == end)
    return {};
  for (const Index t : other_fan_.triangles)
    mesh_.triangles[t][mesh_.sideOf (t, p)] = v;
  Index left = NONE; // a triangle at v
  for (const Index t : {begin, end}) {
    if (t == NONE)
      continue;
    // Both corners are v now: the edges to the third corner are joined.
    const Index third = t == begin ? result.from : result.to;
    const Triangle corners = mesh_.triangles[t];
    Index sides[2] = {NONE, NONE};
    std::size_t found = 0;
    for (std::uint8_t side = 0; side < 3; ++side)
      if (corners[side] == v)
        sides[found++] = mesh_.neighbors[t][side];
    relink (sides[0], t, sides[1]);
    relink (sides[1], t, sides[0]);
    for (const Index other : sides)
      if (other != NONE && other != begin && other != end) {
        left = other;
        mesh_.triangle_of[third] = other;
      }
    unused_.push_back (t);
  }
  mesh_.triangle_of[v] = left;
  mesh_.triangle_of[p] = NONE;
  result.vertex = v;
  return result;
}

void
VertexSplitter::splitAgain (const Return& place, Index p)
{
  setFan (place.vertex, fan_);
  split (cutAt (place), p);
}

bool
VertexSplitter::isAtFold (Index p)
{
  if (mesh_.triangle_of[p] == NONE)
    return false;
  setFan (p, fan_);
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
  setFan (p, fan_);
  const std::vector<Index> around = fan_.ring;
  double best = -1e-9 * (positions_[p] - positions_[around.front ()]).norm ();
  Index into = NONE;
  for (const Index v : around) {
    const Return back = takeOut (p, v);
    if (back.vertex == NONE)
      continue;
    const double as_it_was =
        bestCut (v, p, &back).cost + limits_.far * (positions_[p] - positions_[v]).norm ();
    const double gain = bestNear (p, limits_.near_folds).cost - as_it_was;
    if (gain < best) {
      best = gain;
      into = v;
    }
    splitAgain (back, p);
  }
  if (into == NONE)
    return false;
  takeOut (p, into);
  split (bestNear (p, limits_.near_folds), p);
  return true;
}

// Removes triangles that collapses left.
void
VertexSplitter::dropUnused (const RunContext& run)
{
  if (unused_.empty ())
    return;
  std::sort (unused_.begin (), unused_.end ());
  std::size_t next = 0, kept = 0;
  for (std::size_t t = 0; t < mesh_.triangles.size (); ++t)
    if (next < unused_.size () && unused_[next] == t)
      ++next;
    else
      mesh_.triangles[kept++] = mesh_.triangles[t];
  mesh_.triangles.resize (kept);
  mesh_.connect (positions_.size (), run);
}

} // namespace

VertexSplits
splitVertices (TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& positions,
               const std::vector<Index>& added, const SplitLimits& limits, const RunContext& run)
{
  VertexSplits done;
  VertexSplitter splitter (mesh, positions, limits, run);
  ProgressLoop progress (run, added.size ());
  for (const Index p : added) {
    done.points += splitter.add (p) ? 1 : 0;
    progress.next ();
  }
  for (std::size_t pass = 0, before = 0; pass < limits.passes; ++pass, before = done.moves) {
    for (const Index p : added)
      if (splitter.isAtFold (p)) {
        done.moves += splitter.move (p) ? 1 : 0;
        progress.next ();
      }
    if (done.moves == before)
      break;
  }
  splitter.dropUnused (run);
  return done;
}

} // namespace pcl::floater

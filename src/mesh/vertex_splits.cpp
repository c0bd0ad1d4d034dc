// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/vertex_splits.h"

#include "points/kd_tree.h"

namespace pcl::floater {
namespace {
// Nearest vertices of a point, whose fans may be split. With 3 and 6, folds were a tenth more and fewer,
// crossing pairs the other way round.
constexpr std::size_t NEAREST_SPLIT = 4;
constexpr std::size_t MOST_CUTS = 4096; // tried of a fan, about
constexpr double FOLD_COST = 30.0; // of a fold, or a flat triangle, in longest edges of the fan
constexpr double FLAT_SINE = 0.03; // of an angle; below, a triangle is flat
// Of an edge of the boundary, per length: else fins grow there. One between two points of a stack
// counts as the longest edge of the fan: else the boundary passes through both.
constexpr double BOUNDARY_COST = 6.28;
constexpr double FAR_COST = 10.0; // per length from the point to the vertex that is split
} // namespace

Vector3d
VertexSplitter::normalOf (Index t) const
{
  return t == NONE ? Vector3d (Vector3d::Zero ())
                   : areaVectorOf (mesh_.triangles[t], positions_).normalized ();
}

const std::vector<Cut>&
VertexSplitter::cutsFor (Index p, Row near)
{
  cuts_.clear ();
  std::size_t count = 0;
  for (const Index v : near)
    if (mesh_.triangle_of[v] != NONE && count++ < nearest_)
      if (const Cut cut = bestCut (v, p); cut.vertex != NONE)
        cuts_.push_back (cut);
  std::stable_sort (cuts_.begin (), cuts_.end (),
                    [] (const Cut& a, const Cut& b) { return a.cost < b.cost; });
  return cuts_;
}

Cut
VertexSplitter::bestCut (Index v, Index p)
{
  setFan (v);
  const std::size_t m = fan_.size (), ring = fan_.ring.size (),
                    count = fan_.is_closed ? 2 * m : ring;
  const bool is_open = !fan_.is_closed;
  const Vector3d at_v = positions_[v], at_p = positions_[p], offset = at_p - at_v;
  const double gap = offset.norm ();
  places_.resize (ring);
  double longest = 0.0;
  for (std::size_t k = 0; k < ring; ++k) {
    Place& place = places_[k];
    const Vector3d& here = positions_[fan_.ring[k]];
    place.length_v = (here - at_v).norm ();
    place.length_p = (here - at_p).norm ();
    longest = std::max (longest, place.length_v);
  }
  const double penalty = FOLD_COST * longest;
  // Cost of an edge between triangles of these normals; 0 if one of them is zero.
  const auto bend = [penalty] (const Vector3d& a, const Vector3d& b, double length) {
    const double cosine = a.dot (b);
    if (a.isZero (0.0) || b.isZero (0.0))
      return 0.0;
    return length * std::acos (std::clamp (cosine, -1.0, 1.0)) + (cosine < -0.5 ? penalty : 0.0);
  };
  const Vector3d none = Vector3d::Zero ();
  for (std::size_t k = 0; k < ring; ++k) {
    Place& place = places_[k];
    const Vector3d& here = positions_[fan_.ring[k]];
    place.normal_v = place.normal_p = none;
    place.rim = 0.0;
    if (k < m) {
      const Vector3d& next = positions_[fan_.at (k + 1)];
      const Vector3d area = (here - at_p).cross (next - at_p);
      const Index t = fan_.triangles[k];
      const Vector3d outer = normalOf (mesh_.neighbors[t][mesh_.sideOf (t, v)]);
      const double length = (next - here).norm ();
      place.normal_v = (here - at_v).cross (next - at_v).normalized ();
      place.normal_p = area.normalized ();
      const double sides = place.length_p * places_[(k + 1) % ring].length_p;
      place.rim = bend (place.normal_p, outer, length) - bend (place.normal_v, outer, length) +
                  (area.norm () < FLAT_SINE * sides ? penalty : 0.0);
    }
  }
  for (std::size_t k = 0; k < ring; ++k) {
    Place& place = places_[k];
    const Place& before = places_[(k + ring - 1) % ring];
    const bool is_start = is_open && k == 0, is_end = is_open && k == m;
    const Vector3d before_v = is_start ? none : before.normal_v,
                   before_p = is_start ? none : before.normal_p;
    const Vector3d area = (positions_[fan_.ring[k]] - at_v).cross (offset);
    place.needle = area.normalized ();
    const Vector3d back = -place.needle;
    const double flat = area.norm () < FLAT_SINE * place.length_v * gap ? penalty : 0.0;
    const double rim_v = BOUNDARY_COST * place.length_v;
    const double rim_p = BOUNDARY_COST * place.length_p;
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
      cost += BOUNDARY_COST * (longest + (has_begin && from < m ? places_[m].length_p
                                          : has_end && to > 0   ? places_[0].length_p
                                                                : 0.0));
    else if (cost < best.cost)
      cost += bend (first.needle, -last.needle, gap);
    if (cost < best.cost)
      best = {cost, v, from, to, has_begin, has_end};
  };
  // Of a huge fan only narrow parts, which take no quadratic time.
  const std::size_t widest = MOST_CUTS / m + 1;
  for (std::size_t from = 0; from < (is_open ? ring : m); ++from)
    for (std::size_t to = from + 1; to < (is_open ? ring : from + m) && to <= from + widest; ++to)
      consider (from, to, true, true);
  if (is_open && !keeps_boundary_)
    for (std::size_t k = 0; k < ring; ++k) {
      consider (k, m, true, false);
      consider (0, k, false, true);
    }
  best.cost += FAR_COST * gap;
  return best;
}

void
VertexSplitter::split (const Cut& cut, Index p)
{
  if (cut.has_begin && cut.has_end) {
    const auto u = static_cast<Index> (mesh_.triangles.size ());
    mesh_.triangles.resize (u + 2U);
    mesh_.neighbors.resize (u + 2U, {NONE, NONE, NONE});
    split (cut, p, u, u + 1);
    return;
  }
  setFan (cut.vertex);
  const Index beside = cut.has_begin ? fan_.triangles.back () : fan_.triangles.front ();
  const std::uint8_t corner = mesh_.sideOf (beside, cut.vertex);
  turnSpokes (cut, p,
              mesh_.attach ({beside, cut.has_begin ? TriangleMesh::next (corner)
                                                   : TriangleMesh::previous (corner)},
                            p),
              cut.to - cut.from);
}

void
VertexSplitter::split (const Cut& cut, Index p, Index u, Index v)
{
  setFan (cut.vertex);
  const Index first = fan_.triangle (cut.from), begin = fan_.at (cut.from);
  mesh_.split (first, p, u, v);
  // The part of that triangle that ends the cut.
  Index end = first;
  for (const Index t : {u, v})
    if (isCorner (mesh_.triangles[t], cut.vertex) && !isCorner (mesh_.triangles[t], begin))
      end = t;
  turnSpokes (cut, p, {end, mesh_.sideOf (end, p)}, cut.to - cut.from - 1);
}

// Flips edges between the vertex and places, one after the other, to those between the point and
// places.
void
VertexSplitter::turnSpokes (const Cut& cut, Index p, MeshEdge spoke, std::size_t count)
{
  for (; count > 0; --count) {
    const Index beyond = mesh_.neighbors[spoke.triangle][spoke.side];
    mesh_.flip (spoke);
    const Index next = cut.has_end ? beyond : spoke.triangle; // has both, and the next place
    spoke = {next, mesh_.sideOf (next, p)};
  }
}

void
splitVertices (TriangleMesh& mesh, const Positions& positions, const std::vector<Index>& added,
               const RunContext& run)
{
  mesh.triangle_of.resize (positions.size (), NONE);
  VertexSplitter splitter (mesh, positions, NEAREST_SPLIT, false);
  const KdTree tree (positions, run);
  std::vector<Neighbor> found;
  std::vector<Index> near;
  ProgressLoop progress (run, added.size ());
  for (const Index p : added) {
    progress.next ();
    tree.nearestIf (
        positions[p], Vector3d::Zero (), KdTree::EVERYWHERE, NEAREST_SPLIT,
        [&mesh] (const Neighbor& neighbor, const Vector3d& /*position*/) {
          return mesh.triangle_of[neighbor.point] != NONE;
        },
        found);
    near.clear ();
    for (const Neighbor& neighbor : found)
      near.push_back (neighbor.point);
    const std::vector<Cut>& cuts =
        splitter.cutsFor (p, {near.data (), near.data () + near.size ()});
    if (!cuts.empty ())
      splitter.split (cuts.front (), p);
  }
}

std::size_t
addMissingPoints (TriangleMesh& mesh, const Positions& positions, const CsrLists& neighbors,
                  const RunContext& run)
{
  std::vector<Index> missing = indicesWhere (mesh.triangle_of.size (),
                                             [&] (Index p) { return mesh.triangle_of[p] == NONE; });
  const std::size_t all = missing.size ();
  VertexSplitter splitter (mesh, positions, NEAREST_SPLIT, false);
  ProgressLoop progress (run);
  // Forwards and backwards along the curve: a point may be beside others that are missing.
  for (std::size_t before = all + 1; missing.size () < before;) {
    before = missing.size ();
    const auto add = [&] (Index p) {
      progress.next ();
      const std::vector<Cut>& cuts = splitter.cutsFor (p, neighbors.row (p));
      if (!cuts.empty ())
        splitter.split (cuts.front (), p);
      return !cuts.empty ();
    };
    missing.erase (std::remove_if (missing.begin (), missing.end (), add), missing.end ());
    std::reverse (missing.begin (), missing.end ());
  }
  return all - missing.size ();
}

} // namespace pcl::floater

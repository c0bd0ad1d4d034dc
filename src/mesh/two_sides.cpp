// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/two_sides.h"

#include "core/disjoint_sets.h"
#include "core/parallel.h"
#include "mesh/side_mending.h"
#include "mesh/triangle_mesh.h"

namespace pcl::floater {
namespace {
// Sets of tetrahedra on the same or on opposite sides: disjoint sets with parity, whose last step
// can be undone. O(log n) for a step, plus the free points of the smaller set.
class SidesOfSpace
{
public:
  using Side = SignedSets::Place; // flipped: opposite to the root

  SidesOfSpace (const Tetrahedra& tetrahedra, const Flags& is_free)
      : tetrahedra_ (tetrahedra), parent_ (indicesBelow (tetrahedra.size ())),
        is_other_ (tetrahedra.size (), 0), free_points_ (tetrahedra.size ())
  {
    for (Index t = 0; t < tetrahedra.size (); ++t)
      for (const Index p : tetrahedra.corners[t])
        if (p != NONE && is_free[p] != 0)
          free_points_[t].push_back (p);
  }

  Side of (Index t) const
  {
    bool flipped = false;
    for (; parent_[t] != t; t = parent_[t])
      flipped = flipped != (is_other_[t] != 0);
    return {t, flipped};
  }

  // Puts two tetrahedra on the same side or on opposite ones.
  // \return false if a free point would have one side only, or two tetrahedra contradicting sides;
  //     nothing has changed then
  bool put (Index a, Index b, bool opposite)
  {
    steps_.clear ();
    to_check_.clear ();
    bool is_possible = link (a, b, opposite);
    for (std::size_t i = 0; is_possible && i < to_check_.size (); ++i)
      is_possible = hasTwoSides (to_check_[i]);
    for (; !is_possible && !steps_.empty (); steps_.pop_back ()) {
      const Step& step = steps_.back ();
      parent_[step.small] = step.small;
      is_other_[step.small] = 0;
      free_points_[step.large].resize (step.points_before);
    }
    return is_possible;
  }

private:
  struct Step
  {
    Index small, large; // set that was joined to another one
    std::size_t points_before;
  };

  bool link (Index a, Index b, bool opposite)
  {
    const Side of_a = of (a), of_b = of (b);
    const bool flips = (of_a.flipped != of_b.flipped) != opposite;
    if (of_a.root == of_b.root)
      return !flips;
    Index small = of_a.root, large = of_b.root;
    if (free_points_[small].size () > free_points_[large].size ())
      std::swap (small, large);
    std::vector<Index>& points = free_points_[large];
    steps_.push_back ({small, large, points.size ()});
    parent_[small] = large;
    is_other_[small] = flips ? 1 : 0;
    to_check_.insert (to_check_.end (), free_points_[small].begin (), free_points_[small].end ());
    points.insert (points.end (), free_points_[small].begin (), free_points_[small].end ());
    return true;
  }

  // False if all tetrahedra around a point are on one side. If there are two sets left, they are
  // opposite.
  bool hasTwoSides (Index p)
  {
    const Row around = tetrahedra_.around.row (p);
    const Side first = of (around[0]);
    Side second = first;
    for (const Index t : around) {
      const Side side = of (t);
      if (side == first || side == second)
        continue;
      if (!(second == first))
        return true;
      second = side;
    }
    if (second == first)
      return false;
    return first.root == second.root ||
           link (first.root, second.root, first.flipped == second.flipped);
  }

  const Tetrahedra& tetrahedra_;
  std::vector<Index> parent_;
  Flags is_other_;                              // opposite to the parent
  std::vector<std::vector<Index>> free_points_; // of each set, possibly repeated
  std::vector<Step> steps_;
  std::vector<Index> to_check_;
};

// Cosine and angle of the direction in which the circle of a facet sees the centre of a ball
// through it and another point; above its plane if positive.
struct SeenCentre
{
  double angle, cosine;
};

struct PlaceInSpace
{
  using Side = SidesOfSpace::Side;

  struct Facet
  {
    double overlap;
    Index one, other; // tetrahedra, the smaller number first
  };

  const Place& place;
  const RunContext& run;
  Tetrahedra all = delaunayInSpace (place.positions);
  SidesOfSpace sides{all, place.is_free};
  std::vector<std::array<double, 4>> overlaps = {}; // across each facet
  std::vector<Facet> facets = {};                   // by falling overlap
  std::vector<Index> front_of_patch = {};           // a tetrahedron, NONE if there is none
  Flags is_behind = {};                             // of each tetrahedron

  RemadePlace make (bool only_counts)
  {
    RemadePlace made;
    if (all.size () == 0)
      return made;
    measureFacets ();
    placeFrame ();
    joinOutside ();
    ProgressLoop progress (run);
    for (const Facet& f : facets) {
      progress.next ();
      if (!sides.put (f.one, f.other, false))
        sides.put (f.one, f.other, true);
    }
    decide (made.is_turned);
    SideMending mending{all, place.is_free, overlaps, is_behind};
    made.flawed = mending.flawed ();
    const auto free = std::count (place.is_free.begin (), place.is_free.end (), 1);
    if (only_counts || isNoise (made.flawed, static_cast<std::size_t> (free)))
      return made;
    mending.mend ();
    made.is_right = mending.flawed () == 0;
    take (made.triangles);
    return made;
  }

  SeenCentre seenCentre (Index p, const Vector3d& centre, const Vector3d& normal,
                         double radius) const
  {
    const Vector3d offset = place.positions[p] - centre;
    const double up = normal.dot (offset);
    const double angle =
        std::atan2 (offset.squaredNorm () - radius * radius, 2.0 * radius * std::abs (up));
    return {up < 0.0 ? -angle : angle, std::cos (angle)};
  }

  void measureFacets ()
  {
    overlaps.assign (all.size (), {});
    for (Index t = 0; t < all.size (); ++t)
      for (unsigned k = 0; k < 4; ++k) {
        const Index other = all.neighbors[t][k];
        const Triangle facet = all.facet (t, k);
        if (other < t || isCorner (facet, NONE))
          continue;
        unsigned l = 0; // its facet towards `t`
        while (all.neighbors[other][l] != t)
          ++l;
        const Vector3d& a = place.positions[facet[0]];
        const Vector3d ab = place.positions[facet[1]] - a, ac = place.positions[facet[2]] - a;
        Vector3d normal = ac.cross (ab); // into the tetrahedron
        const Vector3d to_centre = toCircumcentre (ab, ac, -normal);
        normal.normalize ();
        const double radius = to_centre.norm ();
        const Vector3d centre = a + to_centre;
        const Index above = all.corners[t][k], below = all.corners[other][l];
        const SeenCentre x =
            above == NONE ? SeenCentre{PI / 2.0, 0.0} : seenCentre (above, centre, normal, radius);
        const SeenCentre y =
            below == NONE ? SeenCentre{-PI / 2.0, 0.0} : seenCentre (below, centre, normal, radius);
        double overlap = (1.0 + std::cos (std::max (0.0, x.angle - y.angle))) *
                         (1.0 - std::abs (x.cosine - y.cosine));
        if (!std::isfinite (overlap)) // the facet has hardly any area
          overlap = 0.0;
        overlaps[t][k] = overlaps[other][l] = overlap;
        facets.push_back ({overlap, t, other});
      }
    std::sort (facets.begin (), facets.end (), [] (const Facet& f, const Facet& g) {
      return std::tie (g.overlap, f.one, f.other) < std::tie (f.overlap, g.one, g.other);
    });
  }

  // The tetrahedra before and behind a triangle, NONE if it is no facet.
  std::array<Index, 2> besideTriangle (const Triangle& triangle) const
  {
    for (const Index t : all.around.row (triangle[0]))
      for (unsigned k = 0; k < 4; ++k) {
        Triangle facet = all.facet (t, k);
        std::rotate (facet.begin (), std::find (facet.begin (), facet.end (), triangle[0]),
                     facet.end ());
        // A facet is anti-clockwise seen from outside the tetrahedron, which is then behind it.
        if (facet == triangle)
          return {all.neighbors[t][k], t};
      }
    return {NONE, NONE};
  }

  void placeFrame ()
  {
    front_of_patch.assign (place.patches, NONE);
    for (std::size_t i = 0; i < place.frame.size (); ++i) {
      const auto [before, behind] = besideTriangle (place.frame[i]);
      if (before == NONE)
        continue;
      Index& front = front_of_patch[place.patch_of[i]];
      if (front == NONE)
        front = before;
      sides.put (front, before, false);
      sides.put (front, behind, true);
    }
  }

  // There is no surface between two infinite tetrahedra near the place, but at a boundary.
  void joinOutside ()
  {
    for (Index t = 0; t < all.size (); ++t) {
      if (!all.isInfinite (t))
        continue;
      for (unsigned k = 0; k < 4; ++k) {
        const Index other = all.neighbors[t][k];
        if (all.corners[t][k] == NONE || other < t)
          continue;
        const auto isInside = [this] (Index p) {
          return p != NONE && (place.is_free[p] != 0 || place.is_rim[p] != 0);
        };
        const auto isOff = [this] (Index p) { return p != NONE && place.is_boundary[p] == 0; };
        const Triangle facet = all.facet (t, k);
        if (anyCorner (facet, isInside) && anyCorner (facet, isOff))
          sides.put (t, other, false);
      }
    }
  }

  // The front of each set of tetrahedra is where most of the frame has it; without a frame, the
  // outside.
  void decide (Flags& is_turned)
  {
    std::vector<std::array<std::size_t, 2>> votes (all.size ()); // of each set, by its root
    for (std::size_t i = 0; i < place.frame.size (); ++i)
      if (const Index front = front_of_patch[place.patch_of[i]]; front != NONE) {
        const Side side = sides.of (front);
        ++votes[side.root][side.flipped ? 1 : 0];
      }
    for (Index t = 0; t < all.size (); ++t)
      if (all.isInfinite (t)) {
        const Side side = sides.of (t);
        if (auto& vote = votes[side.root]; vote[0] + vote[1] == 0)
          ++vote[side.flipped ? 1 : 0];
      }
    const auto isFront = [&votes] (const Side& side) {
      const auto& vote = votes[side.root];
      return vote[0] + vote[1] > 0 && (vote[1] > vote[0]) == side.flipped;
    };
    is_behind.resize (all.size ());
    for (Index t = 0; t < all.size (); ++t)
      is_behind[t] = isFront (sides.of (t)) ? 0 : 1;
    is_turned.assign (place.patches, 0);
    for (Index patch = 0; patch < place.patches; ++patch)
      if (front_of_patch[patch] != NONE)
        is_turned[patch] = isFront (sides.of (front_of_patch[patch])) ? 0 : 1;
  }

  void take (std::vector<Triangle>& triangles) const
  {
    for (Index t = 0; t < all.size (); ++t)
      for (unsigned k = 0; k < 4; ++k) {
        const Triangle facet = all.facet (t, k);
        if (is_behind[t] != 0 && is_behind[all.neighbors[t][k]] == 0 && !isCorner (facet, NONE) &&
            anyCorner (facet, [&] (Index p) { return place.is_free[p] != 0; }))
          triangles.push_back (facet);
      }
  }
};

} // namespace

RemadePlace
remakePlace (const Place& place, const RunContext& run, bool only_counts)
{
  return PlaceInSpace{place, run}.make (only_counts);
}

bool
areOnTwoSides (const Positions& positions, const std::vector<Index>& points,
               const CsrLists& neighbors, const RunContext& run)
{
  // One in so many points may be flawed. Even bodies with thin walls had one in 20 or fewer; points
  // strewn into volumes, lattices, leaves and trees one in 10 or more.
  constexpr std::size_t PARTS = 4, LARGEST_PART = 2048, SHARE = 15;
  const std::size_t size = std::min (LARGEST_PART, points.size ()),
                    parts = points.size () > size ? PARTS : 1;
  std::vector<std::size_t> flawed (parts);
  parallelTasks (run, parts, [&] (std::size_t part) {
    const Index* const first = points.data () + part * (points.size () - size) / (PARTS - 1);
    std::vector<Index> near (first, first + size); // and what is around
    for (std::size_t i = 0; i < size; ++i)
      near.insert (near.end (), neighbors.row (first[i]).begin (), neighbors.row (first[i]).end ());
    sortUnique (near);
    Place place;
    place.positions = valuesAt (positions, near);
    place.is_rim = place.is_boundary = Flags (near.size (), 0);
    for (const Index p : near)
      place.is_free.push_back (std::binary_search (first, first + size, p) ? 1 : 0);
    flawed[part] = remakePlace (place, run.withThreads (1), true).flawed;
  });
  return std::accumulate (flawed.begin (), flawed.end (), std::size_t{0}) * SHARE <= parts * size;
}

} // namespace pcl::floater

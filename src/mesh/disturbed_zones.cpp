// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/disturbed_zones.h"

#include "core/disjoint_sets.h"
#include "core/parallel.h"

#include <unordered_map>

namespace pcl::floater {
namespace {
// Chosen on generated bodies with sharp edges, thin walls and contacts, and on clouds with true openings.
// In local spacings: the distance up to which two pieces of boundary are side by side; and that of
// pieces which the sampling does not show: there they are a gap, also if the loop is open elsewhere,
// and if they belong to one sheet.
constexpr double BESIDE = 2.5, TOUCHING = 1.0;

// Cosine between the normals of two pieces, 30 degrees; below, they belong to two sheets.
constexpr double SAME_SHEET = 0.87;

// Share of the points of a loop that are beside another sheet, from which on it is a gap. True boundaries
// had up to 0.15, gaps at edges of bodies 0.6 and more.
constexpr double GAP_SHARE = 1.0 / 3.0;

// Points of a loop in a row that are no gap and separate two, for long and short parts. Along folds of
// sheets up to 12 in a row were not touching, on true boundaries of wide sheets 48 and more. A short run is
// longer than the loop of a pinhole: with 4, a closed blade kept two holes of 7 points. On one sheet, pieces
// of a loop are LONG_RUN apart along it, times their distance.
constexpr std::size_t LONG_RUN = 32, SHORT_RUN = SMALL_LOOP + 1;

struct ZoneFinder
{
  struct OnLoop
  {
    std::size_t loop;
    double way; // along the loop
    Vector3d normal;
  };

  const TriangleMesh& mesh;
  const Positions& positions;
  const LocalGeometry& geometry;
  GapParts gaps;
  bool closes_gaps;
  const Flags& is_settled;
  const RunContext& run;
  std::vector<std::vector<Index>> loops = {};
  std::vector<double> lengths = {}; // of the loops
  std::unordered_map<Index, OnLoop> on_loop = {};
  Flags is_wrong = {}, is_disturbed = {}; // of each point
  DisturbedZones zones = {};
  std::vector<Index> free = {};
  std::vector<Index> fan = {}; // scratch

  DisturbedZones find (const std::vector<CrossingPair>& crossing, int rings)
  {
    for (const Index t : mesh.triangle_of)
      is_wrong.push_back (t == NONE ? 1 : 0);
    for (const CrossingPair& pair : crossing)
      for (const Index t : {pair.first, pair.second})
        for (const Index p : mesh.triangles[t])
          is_wrong[p] = 1;
    readLoops ();
    is_disturbed = is_wrong;
    markGaps ();
    if (std::find (is_wrong.begin (), is_wrong.end (), 1) == is_wrong.end ())
      return {};
    markDisturbed ();
    markGaps ();
    for (const std::vector<Index>& loop : loops)
      for (const Index p : loop) {
        zones.was_boundary[p] = 1;
        zones.is_boundary[p] = is_disturbed[p] == 0 ? 1 : 0;
      }
    for (Index p = 0; p < positions.size (); ++p)
      if (is_disturbed[p] != 0 && (is_settled.empty () || is_settled[p] == 0))
        makeFree (p);
    std::size_t first = 0;
    for (int ring = 0; ring < rings; ++ring)
      for (const std::size_t last = free.size (); first < last; ++first)
        forEachAround (free[first], [this] (Index q) { makeFree (q); });
    connect ();
    return std::move (zones);
  }

  Vector3d normalOf (Index t) const { return areaVectorOf (mesh.triangles[t], positions); }

  void readLoops ()
  {
    loops = boundaryLoops (mesh, run);
    for (std::size_t l = 0; l < loops.size (); ++l) {
      double way = 0.0;
      Index last = loops[l].back ();
      for (const Index p : loops[l]) {
        way += (positions[p] - positions[last]).norm ();
        last = p;
        Vector3d normal = Vector3d::Zero ();
        mesh.fan (p, fan);
        for (const Index t : fan)
          normal += normalOf (t);
        on_loop.emplace (p, OnLoop{l, way, normal.normalized ()});
      }
      lengths.push_back (way);
    }
  }

  // Whether the boundary of another sheet, or of another piece of this one, is beside a point of
  // the boundary; on the same sheet only if it is so near that the points show no gap.
  bool isBesideSheet (Index p, double within) const
  {
    const OnLoop& here = on_loop.at (p);
    const Row around = geometry.neighbors.row (p);
    return std::any_of (around.begin (), around.end (), [&] (Index q) {
      const auto at = on_loop.find (q);
      if (at == on_loop.end ())
        return false;
      const OnLoop& there = at->second;
      const bool is_same = here.normal.dot (there.normal) > SAME_SHEET;
      const double distance = (positions[q] - positions[p]).norm ();
      if (distance >
              (is_same ? TOUCHING : within) * static_cast<double> (geometry.meshSpacing ()[p]) ||
          (is_same && mesh.hasEdge (p, q)))
        return false;
      const double way = std::abs (there.way - here.way);
      const double least = is_same ? static_cast<double> (LONG_RUN) : 2.0;
      return there.loop != here.loop || std::min (way, lengths[here.loop] - way) > least * distance;
    });
  }

  // Where two sheets end side by side, the loop between them is a gap at an edge of the body. A
  // window in a sheet has only that sheet around it.
  void markGaps ()
  {
    if (!closes_gaps)
      return;
    for (const std::vector<Index>& loop : loops)
      for (const Index p : pointsOfGap (loop))
        is_wrong[p] = is_disturbed[p] = 1;
  }

  // The whole of a loop that is a gap. Of one that is a true boundary elsewhere: where it runs along
  // a fold, so near to the other sheet that the points would not show a gap.
  std::vector<Index> pointsOfGap (const std::vector<Index>& loop)
  {
    if (loop.size () <= SMALL_LOOP || isBeforeSheet (loop))
      return loop;
    const std::vector<Index> beside = besideSheet (loop, BESIDE);
    if (static_cast<double> (beside.size ()) >= GAP_SHARE * static_cast<double> (loop.size ())) {
      const bool all_along = stretches (loop, beside).size () == loop.size ();
      zones.may_be_parts = zones.may_be_parts || !all_along;
      if (all_along || gaps == GapParts::WHOLE_LOOP)
        return loop;
    }
    return stretches (loop, besideSheet (loop, TOUCHING));
  }

  // Whether points of another sheet are in the hole that a loop leaves, so near that the points would
  // show no opening: some of them may belong into it. The surface is on the left of the loop.
  bool isBeforeSheet (const std::vector<Index>& loop) const
  {
    Vector3d centre = Vector3d::Zero (), axis = centre, normal = centre;
    for (std::size_t i = 0; i < loop.size (); ++i) {
      const Vector3d at = positions[loop[i]] - positions[loop[0]];
      centre += at / static_cast<double> (loop.size ());
      axis -= at.cross (positions[loop[(i + 1) % loop.size ()]] - positions[loop[0]]);
      normal += on_loop.at (loop[i]).normal;
    }
    if (axis.dot (normal) <= 0.0)
      return false;
    centre += positions[loop[0]];
    axis.normalize ();
    const auto fromCentre = [&] (Index p) { return (positions[p] - centre).norm (); };
    double radius = std::numeric_limits<double>::infinity ();
    for (const Index p : loop)
      radius = std::min (radius, fromCentre (p));
    return std::any_of (loop.begin (), loop.end (), [&] (Index p) {
      const Row around = geometry.neighbors.row (p);
      return std::any_of (around.begin (), around.end (), [&] (Index q) {
        return fromCentre (q) < radius &&
               std::abs (axis.dot (positions[q] - centre)) < TOUCHING * geometry.meshSpacing ()[p];
      });
    });
  }

  // Places in the loop, ascending.
  std::vector<Index> besideSheet (const std::vector<Index>& loop, double within) const
  {
    return indicesWhere (loop.size (), [&] (Index i) {
      return is_disturbed[loop[i]] != 0 || isBesideSheet (loop[i], within);
    });
  }

  // Stretches of a loop with more than SMALL_LOOP of these places, and no more than a run between them.
  std::vector<Index> stretches (const std::vector<Index>& loop,
                                const std::vector<Index>& places) const
  {
    const std::size_t n = places.size (),
                      longest = gaps == GapParts::SHORT_PARTS ? SHORT_RUN : LONG_RUN;
    const auto way = [&] (std::size_t from, std::size_t to) {
      return (places[to % n] + loop.size () - places[from % n]) % loop.size ();
    };
    const auto isLast = [&] (std::size_t i) { return way (i, i + 1) > longest; };
    if (n <= SMALL_LOOP)
      return {};
    std::size_t start = 0;
    while (start < n && !isLast (start))
      ++start;
    if (start == n)
      return loop;
    std::vector<Index> points;
    for (std::size_t first = start + 1, last = first; last <= start + n; ++last) {
      if (!isLast (last))
        continue;
      if (last - first >= SMALL_LOOP)
        for (std::size_t k = 0; k <= way (first, last); ++k)
          points.push_back (loop[(places[first % n] + k) % loop.size ()]);
      first = last + 1;
    }
    return points;
  }

  // Whether some ball through the corners of a triangle has none of the points around inside. The
  // centre of a ball is that of the circle plus a multiple of the normal.
  bool isDelaunay (Index t) const
  {
    const Triangle& corners = mesh.triangles[t];
    const Vector3d& a = positions[corners[0]];
    const Vector3d ab = positions[corners[1]] - a, ac = positions[corners[2]] - a,
                   normal = ab.cross (ac), to_centre = toCircumcentre (ab, ac, normal);
    double least = -std::numeric_limits<double>::infinity (), most = -least;
    for (const Index corner : corners)
      for (const Index p : geometry.neighbors.row (corner)) {
        if (isCorner (corners, p))
          continue;
        const Vector3d offset = positions[p] - a;
        const double up = 2.0 * normal.dot (offset),
                     outside = offset.squaredNorm () - 2.0 * offset.dot (to_centre);
        if (up > 0.0)
          most = std::min (most, outside / up);
        else if (up < 0.0)
          least = std::max (least, outside / up);
      }
    constexpr double ROUNDING = 1e-9; // points on one sphere count as outside
    return least <= most + ROUNDING * (std::abs (least) + std::abs (most));
  }

  void markDisturbed ()
  {
    const std::size_t count = mesh.triangles.size ();
    Flags is_marked (count, 0);
    parallelPoints (run, count, [&] (Index t) {
      const Vector3d normal = normalOf (t);
      bool bends = false, folds = false;
      for (const Index u : mesh.neighbors[t])
        if (u != NONE) {
          bends = bends || isBent (normal, normalOf (u));
          folds = folds || isFold (normal, normalOf (u));
        }
      is_marked[t] = folds || (bends && !isDelaunay (t)) ? 1 : 0;
    });
    for (Index t = 0; t < count; ++t)
      if (is_marked[t] != 0)
        for (const Index p : mesh.triangles[t])
          is_disturbed[p] = 1;
    zones.is_free.assign (positions.size (), 0);
    zones.is_boundary = zones.was_boundary = zones.is_free;
  }

  bool isFree (Index p) const { return zones.is_free[p] != 0; }

  void makeFree (Index p)
  {
    if (isFree (p) || zones.is_boundary[p] != 0)
      return;
    zones.is_free[p] = 1;
    free.push_back (p);
  }

  // Calls visit (q) for the corners of the triangles around a point.
  template <typename Visit>
  void forEachAround (Index p, Visit&& visit)
  {
    mesh.fan (p, fan);
    for (const Index t : fan)
      for (const Index q : mesh.triangles[t])
        visit (q);
  }

  // Zones with something wrong in them; the others are not free any more.
  void connect ()
  {
    std::sort (free.begin (), free.end ());
    DisjointSets sets (positions.size ());
    for (const Index p : free) {
      forEachAround (p, [&] (Index q) { sets.join (p, q); });
      for (const Index q : geometry.neighbors.row (p))
        if (isFree (q))
          sets.join (p, q);
    }
    Flags is_zone (positions.size (), 0); // of the first points of sets
    for (const Index p : free)
      if (is_wrong[p] != 0)
        is_zone[sets.find (p)] = 1;
    const std::vector<Index> zone_of =
        std::move (sets).number ([&] (Index p) { return is_zone[p] != 0; });
    for (const Index p : free)
      zones.is_free[p] = zone_of[p] != NONE ? 1 : 0;
    const auto count = std::count (is_zone.begin (), is_zone.end (), 1);
    zones.points = makeCsrLists (static_cast<std::size_t> (count), [&] (const auto& emit) {
      for (const Index p : free)
        if (isFree (p))
          emit (zone_of[p], p);
    });
  }
};

} // namespace

DisturbedZones
findDisturbedZones (const TriangleMesh& mesh, const Positions& positions,
                    const LocalGeometry& geometry, const std::vector<CrossingPair>& crossing,
                    int rings, GapParts gaps, bool closes_gaps, const Flags& is_settled,
                    const RunContext& run)
{
  return ZoneFinder{mesh, positions, geometry, gaps, closes_gaps, is_settled, run}.find (crossing,
                                                                                         rings);
}

} // namespace pcl::floater

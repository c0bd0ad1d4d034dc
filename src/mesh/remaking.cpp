// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/remaking.h"

#include "core/disjoint_sets.h"
#include "mesh/crossing_table.h"
#include "mesh/piece_in_place.h"
#include "mesh/zone_splicing.h"

#include <map>

namespace pcl::floater {
namespace {
// A large zone is tried in some places first: it is noise if one in TRIED_SHARE of their points is
// flawed. Large zones in generated bodies, with noise of 0.15 spacings or less, had at most one in 37, in
// noisy scans one in 24 or more: with so many known points around, fewer are found than by isNoise. Four
// places tell if they have more than one in 24 or fewer than one in 48; else four more, up to sixteen. In
// such noise no necks are looked for: to look for them took 40 % of the time of a cloud from the air, most
// of it in trees.
constexpr std::size_t TRIED_PLACES = 16, TRIED_AT_ONCE = 4, TRIED_POINTS = 256, TRIED_SHARE = 30,
                      SURELY_NOISE = 24, SURELY_NONE = 48;

// Points that are missing where the surface would be, from which on it is a lid on an opening: in the
// circle on an edge, or in triangles that hang together, each with a circle of more than the radius
// LARGE. Lengths are in mean edges around before, or spacings if these are larger. Closed bodies had up
// to 24, lids on folded sheets 45 or more, and edges longer than 6.5.
constexpr double MISSING_POINTS = 33.0, LARGE = 2.0;

// Share of the faults of a zone that may be left. A slit along a true fold has two open edges for each
// folded one that closes it.
constexpr double FAULTS_LEFT = 0.6;

// Times that a zone grows where it does not fit. 8, 16 and 40 made none of 9 bodies right that 4
// left wrong.
constexpr int MOST_GROWTHS = 4;

struct ZoneRemaker
{
  const TriangleMesh& mesh;
  const Positions& positions;
  const LocalGeometry& geometry;
  const DisturbedZones& zones;
  RunContext run;
  MeshComponents components = findComponents (mesh, run);
  std::vector<std::size_t> sizes = countPoints (mesh, components);

  struct Remade
  {
    NewZone zone;
    std::size_t faults;
  };

  // A zone that is left with faults and is most of its components is tried once more with all of them:
  // what is around may be wrong.
  // \param is_noise out: whether the zone is noise
  // \return nothing if the zone is to stay as it was
  std::optional<NewZone> remake (Row zone, std::uint8_t& is_noise) const
  {
    is_noise = 1;
    if (looksNoisy (zone))
      return std::nullopt;
    std::optional<Remade> made = remakeFree ({zone.begin (), zone.end ()}, &is_noise);
    if (made && made->faults > 0)
      if (std::vector<Index> all = withComponents (zone); !all.empty ())
        if (std::optional<Remade> whole = remakeFree (std::move (all));
            whole && whole->faults < made->faults)
          made = std::move (whole);
    return made ? std::optional (std::move (made->zone)) : std::nullopt;
  }

  // A zone with all of the components that are near it, if these have at most twice as many points; else
  // none.
  std::vector<Index> withComponents (Row zone) const
  {
    std::vector<Index> points;
    Flags is_near (components.count, 0);
    std::size_t size = 0;
    for (const Index p : zone)
      for (const Index q : geometry.neighbors.row (p))
        if (const Index t = mesh.triangle_of[q]; t != NONE)
          if (const Index its = components.of_triangle[t]; std::exchange (is_near[its], 1) == 0)
            size += sizes[its];
    for (Index p = 0; p < positions.size () && size <= 2 * zone.size (); ++p)
      if (const Index t = mesh.triangle_of[p];
          zones.is_boundary[p] == 0 && (t == NONE || is_near[components.of_triangle[t]] != 0))
        points.push_back (p);
    return points;
  }

  // Points grow by those at which their new triangles do not fit to the others.
  std::optional<Remade> remakeFree (std::vector<Index> free, std::uint8_t* is_noise = nullptr) const
  {
    for (int growths = 0; growths <= MOST_GROWTHS; ++growths) {
      const PlaceOfMesh at = placeOf ({free.data (), free.data () + free.size ()}, mesh, positions,
                                      geometry.neighbors, zones);
      RemadePlace made = remakePlace (at.place, run);
      if (growths == 0 && is_noise != nullptr)
        *is_noise = isNoise (made.flawed, free.size ()) ? 1 : 0;
      if (!made.is_right || hasLid (made, at))
        return std::nullopt;
      dropIslands (at.place, made);
      const PieceInPlace after (at.place, made.triangles, made.is_turned, run);
      const std::vector<Index> misfits = after.misfits (run);
      if (misfits.empty ()) {
        const PieceInPlace before (at.place, at.old, {}, run);
        const std::size_t faults = after.faults (run);
        if (!after.isManifold () ||
            static_cast<double> (faults) > FAULTS_LEFT * static_cast<double> (before.faults (run)))
          return std::nullopt;
        return Remade{newZone (std::move (free), at, made), faults};
      }
      const std::size_t size = free.size ();
      for (const Index p : misfits)
        free.push_back (at.points[p]);
      sortUnique (free);
      if (free.size () == size)
        return std::nullopt;
    }
    return std::nullopt;
  }

  // Points of a zone that are near in number are near in space. The surface may end around them.
  bool looksNoisy (Row zone) const
  {
    std::size_t flawed = 0, tried = 0;
    for (std::size_t i = 0; i < TRIED_PLACES && zone.size () >= LARGE_PLACE; ++i) {
      const std::size_t number = i % TRIED_AT_ONCE * TRIED_AT_ONCE + i / TRIED_AT_ONCE; // far apart
      const Index* const first =
          zone.first + number * (zone.size () - TRIED_POINTS) / (TRIED_PLACES - 1);
      Place place =
          placeOf ({first, first + TRIED_POINTS}, mesh, positions, geometry.neighbors, zones).place;
      for (std::size_t p = 0; p < place.is_free.size (); ++p)
        place.is_boundary[p] = place.is_free[p] == 0 ? 1 : 0;
      flawed += remakePlace (place, run, true).flawed;
      tried += TRIED_POINTS;
      if ((i + 1) % TRIED_AT_ONCE == 0 &&
          (SURELY_NOISE * flawed > tried || SURELY_NONE * flawed < tried))
        break;
    }
    return TRIED_SHARE * flawed > tried;
  }

  static NewZone newZone (std::vector<Index> free, const PlaceOfMesh& at, const RemadePlace& made)
  {
    NewZone zone;
    zone.points = std::move (free);
    for (const Triangle& t : made.triangles)
      zone.triangles.push_back ({at.points[t[0]], at.points[t[1]], at.points[t[2]]});
    Flags is_known (at.place.patches, 0);
    for (std::size_t i = 0; i < at.frame.size (); ++i)
      if (const Index patch = at.place.patch_of[i]; is_known[patch]++ == 0)
        zone.patches.emplace_back (at.frame[i], made.is_turned[patch] != 0);
    return zone;
  }

  // Components without a triangle of the frame are no part of the surface; if there is no frame, small
  // ones beside a larger one.
  static void dropIslands (const Place& place, RemadePlace& made)
  {
    DisjointSets pieces (place.positions.size ());
    const auto join = [&pieces] (const Triangle& t) {
      pieces.join (t[0], t[1]);
      pieces.join (t[1], t[2]);
    };
    std::for_each (made.triangles.begin (), made.triangles.end (), join);
    std::for_each (place.frame.begin (), place.frame.end (), join);
    constexpr std::size_t HELD = std::numeric_limits<std::size_t>::max (); // by the frame
    std::vector<std::size_t> size (place.positions.size (), 0);            // triangles of a piece
    for (const Triangle& t : made.triangles)
      ++size[pieces.find (t[0])];
    for (const Triangle& t : place.frame)
      size[pieces.find (t[0])] = HELD;
    const std::size_t least =
        place.frame.empty ()
            ? std::min (SMALLEST_ISLAND, *std::max_element (size.begin (), size.end ()))
            : HELD;
    made.triangles.erase (
        std::remove_if (made.triangles.begin (), made.triangles.end (),
                        [&] (const Triangle& t) { return size[pieces.find (t[0])] < least; }),
        made.triangles.end ());
  }

  // The mean edge around a point, or its spacing if that is larger.
  double usualEdge (Index p) const
  {
    std::vector<Index> fan;
    mesh.fan (p, fan);
    double sum = 0.0;
    for (const Index t : fan)
      for (std::uint8_t side = 0; side < 3; ++side)
        sum += (positions[mesh.from ({t, side})] - positions[mesh.to ({t, side})]).norm ();
    const double count = static_cast<double> (3 * std::max<std::size_t> (fan.size (), 1));
    return std::max (static_cast<double> (geometry.meshSpacing ()[p]), sum / count);
  }

  bool hasLid (const RemadePlace& made, const PlaceOfMesh& at) const
  {
    const Positions& place = at.place.positions;
    std::map<std::pair<Index, Index>, Index> triangle_at; // each edge of large triangles
    DisjointSets lids (made.triangles.size ());
    std::vector<double> missing (made.triangles.size (), 0.0);
    for (Index t = 0; t < missing.size (); ++t) {
      const Triangle& c = made.triangles[t];
      const std::array usual{usualEdge (at.points[c[0]]), usualEdge (at.points[c[1]]),
                             usualEdge (at.points[c[2]])};
      for (std::size_t k = 0; k < 3; ++k) {
        const double radius = (place[c[k]] - place[c[(k + 1) % 3]]).norm () /
                              (2.0 * std::max (usual[k], usual[(k + 1) % 3]));
        if (PI * radius * radius > MISSING_POINTS)
          return true;
      }
      const double most = *std::max_element (usual.begin (), usual.end ());
      if (circumradius (place[c[0]], place[c[1]], place[c[2]]) < LARGE * most)
        continue;
      missing[t] = areaVectorOf (c, place).norm () / (2.0 * most * most);
      for (std::size_t k = 0; k < 3; ++k)
        lids.join (t,
                   triangle_at.try_emplace (std::minmax (c[k], c[(k + 1) % 3]), t).first->second);
    }
    for (Index t = 0; t < missing.size (); ++t)
      if (const Index lid = lids.find (t); lid != t)
        missing[lid] += missing[t];
    return std::any_of (missing.begin (), missing.end (),
                        [] (double points) { return points > MISSING_POINTS; });
  }
};

} // namespace

bool
remakeZones (TriangleMesh& mesh, const Positions& positions, const LocalGeometry& geometry,
             CrossingPairs& crossing, int widest, RemadeZones& remade, bool closes_gaps,
             const RunContext& run)
{
  // At first with whole loops; and again as wide if long parts of them would do. At last with short ones, if
  // a zone with a boundary is left: in a narrow sheet with open ends, long parts leave none of it open. Sides
  // contradict each other there, which looks like noise.
  int rings = widest;
  bool has_changed = false;
  for (GapParts gaps = GapParts::WHOLE_LOOP; rings > 0;) {
    const bool is_short = gaps == GapParts::SHORT_PARTS;
    const DisturbedZones zones = findDisturbedZones (mesh, positions, geometry, crossing, rings,
                                                     gaps, closes_gaps, remade.is_settled, run);
    std::vector<std::optional<NewZone>> made (zones.points.rows ());
    Flags is_noise (made.size (), 0);
    if (made.empty ())
      break;
    remade.is_noisy.resize (positions.size (), 0);
    const ZoneRemaker remaker{mesh, positions, geometry, zones, run.withThreads (1)};
    // Whether a zone with a boundary stays as it was; and one that is most of its components.
    std::atomic<bool> is_left{false}, is_most_left{false};
    parallelTasks (run, made.size (), [&] (std::size_t zone) {
      const Row points = zones.points.row (zone);
      const bool has_boundary = std::any_of (points.begin (), points.end (), [&zones] (Index p) {
        return zones.was_boundary[p] != 0;
      });
      if (has_boundary || !is_short)
        made[zone] = remaker.remake (points, is_noise[zone]);
      if (has_boundary && !made[zone] && (is_noise[zone] == 0 || points.size () < LARGE_PLACE)) {
        is_left = true;
        if (is_short && !remaker.withComponents (points).empty ())
          is_most_left = true;
      }
    });
    if (gaps != GapParts::WHOLE_LOOP || !zones.may_be_parts)
      --rings;
    if (gaps == GapParts::WHOLE_LOOP)
      gaps = GapParts::LONG_PARTS;
    if (rings == 0 && is_left && !is_short) {
      gaps = GapParts::SHORT_PARTS;
      rings = widest;
    }
    else if (is_short && !is_most_left)
      rings = 0;
    TriangleMesh spliced;
    spliced.triangles = spliceZones (mesh, made);
    std::array<std::size_t, 2> noisy_points{}; // of small zones, and of large ones
    for (std::size_t zone = 0; zone < made.size () && !is_short; ++zone) {
      const Row points = zones.points.row (zone);
      const bool is_large = points.size () >= LARGE_PLACE;
      for (const Index p : points)
        remade.is_noisy[p] = is_large ? is_noise[zone] : 0;
      noisy_points[is_large ? 1 : 0] += is_noise[zone] * points.size ();
    }
    const auto areMany = [&] (std::size_t points) { return 4 * points > positions.size (); };
    remade.is_noise = is_short ? remade.is_noise : areMany (noisy_points[0] + noisy_points[1]);
    if (areMany (noisy_points[1]) || (remade.is_noise && !is_left))
      break; // narrower zones would be noise as well
    if (std::count (made.begin (), made.end (), std::nullopt) ==
            static_cast<std::ptrdiff_t> (made.size ()) ||
        !spliced.connect (positions.size (), run))
      continue;
    remade.is_remade.resize (positions.size (), 0);
    for (const std::optional<NewZone>& zone : made)
      if (zone)
        for (const Index p : zone->points)
          remade.is_remade[p] = 1;
    crossing = pairsAfterChange (spliced, positions, mesh.triangles, crossing, run);
    mesh = std::move (spliced);
    has_changed = true;
  }
  return has_changed;
}

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/viewpoint_search.h"

#include "core/geometry.h"
#include "core/parallel.h"

namespace pcl::floater {
namespace {
// `DensityEvidence::left` of a searched place: right ones have up to 0.31, wrong ones 0.38 and more.
constexpr double SEARCHED_DENSITY_REGULARITY = 1.0 / 3.0;

// Factors by which the evidence may miss REGULARITY and NEAR_SHARE for the search to go on.
struct Excess
{
  double regularity, near_share;
};

// After each of the first three rounds, and after later ones, which hardly change the evidence.
// Near the right viewpoint, outlines may hide each other, so that all rays are near others; not for
// parallel rays. In simulated scans, right viewpoints had up to 1.5 and 2.3 in the middle, and
// below 1 at the end; wrong ones up to 1.5 and 12. EARLY_FROM_FAR also holds for all viewpoints
// just before the later rounds: there, right ones of 60 simulated scans had up to 0.3 and 0.2, that
// of a real one 0.9 and 3.2, and wrong ones 0.9 and 3.5 or more.
constexpr Excess EARLY{2.0, 100.0}, EARLY_FROM_FAR{2.0, 5.0}, LATE{1.4, 2.0};

struct ViewpointSearch
{
  const Positions& positions;
  const RowOf& row_of;
  const std::vector<AreaSample>& samples;
  std::size_t patch_count;
  bool may_be_far;
  const RunContext& run;
  std::size_t few_patches = std::min<std::size_t> (patch_count, 32); // in first rounds
  double usual_excess = may_be_far ? 1.0 : LATE.regularity; // by which REGULARITY may be missed
  Eigen::AlignedBox3d box = {};

  // For parallel rays: a row lies in the plane of its rays, and all these planes are parallel.
  std::optional<Viewpoint> findAlongRows (const Vector3d& across) const
  {
    const Vector3d x = across.unitOrthogonal (), y = across.cross (x);
    constexpr std::size_t DIRECTIONS = 180; // one degree apart
    constexpr std::size_t REFINED = 4;      // best directions
    const double step = PI / static_cast<double> (DIRECTIONS);
    // Patches in space, for any direction of the rays.
    constexpr std::size_t FEW = 16; // with 480 rays that are judged
    const std::vector<RayPatch> patches = findPointPatches (positions, row_of, FEW);
    // Lines on a plane are even from all directions, and show none. In 80 generated line scans, the
    // least cost was up to .053 of the median; along noisy lines that are no scan, .15 and more.
    constexpr double LEAST = 0.1;
    std::vector<RatedViewpoint> candidates (DIRECTIONS);
    parallelTasks (run, DIRECTIONS, [&] (std::size_t k) {
      const double angle = step * static_cast<double> (k);
      const Viewpoint along{std::cos (angle) * x + std::sin (angle) * y, true};
      candidates[k] = {findRaySpread (positions, patches, along, false, run.withThreads (1)),
                       along};
    });
    std::stable_sort (candidates.begin (), candidates.end ());
    if (candidates.front ().cost > LEAST * candidates[DIRECTIONS / 2].cost)
      return {};
    // Rays are evenly spaced from the right direction only.
    std::optional<Found> best;
    for (const RatedViewpoint& start : keepApart (candidates, APART, REFINED))
      if (takeBetter (refine (start.viewpoint, step), best))
        break;
    return best && best->is_certain ? std::optional<Viewpoint> (best->viewpoint) : std::nullopt;
  }

  // \param in_rows points lie in rows, as those of a spinning lidar
  std::optional<Viewpoint> find (bool in_rows) const
  {
    constexpr std::size_t REFINED = 3; // best places by rays, until one is right
    std::vector<RatedViewpoint> candidates = searchByAreas (samples, box, may_be_far, run);
    // Areas can mislead: in a plane, they are the same from many places. Rays tell which is right.
    parallelTasks (run, candidates.size (), [&] (std::size_t k) {
      const RunContext one = run.withThreads (1);
      const Viewpoint& place = candidates[k].viewpoint;
      candidates[k].cost = findRaySpread (
          positions, findRayPatches (positions, place, one, few_patches), place, true, one);
    });
    std::stable_sort (candidates.begin (), candidates.end ());
    candidates.resize (std::min (candidates.size (), REFINED));
    for (const RatedViewpoint& candidate : candidates) {
      std::optional<Found> found;
      const bool ends = takeBetter (refine (candidate.viewpoint), found);
      if (may_be_far && !candidate.viewpoint.is_far) {
        if (!ends && (!found || found->is_certain))
          takeBetter (refine (mirrored (candidate.viewpoint)), found);
        if (!found && in_rows)
          takeBetter (refineBy (candidate.viewpoint, AREA_ERROR, Measure::DENSITY), found);
      }
      if (found && isDetermined (*found)) {
        // Rays are as even as parallel ones if within the cloud, whose diagonal is 1, their spacing
        // changes by less than the spread that counts as even. The place may be on the wrong side.
        const Viewpoint& seen_from = found->viewpoint;
        const bool is_as_far =
            !seen_from.is_far && (seen_from.place - box.center ()).norm () * EVEN > 1.0;
        return is_as_far ? farFrom (seen_from, box.center ()) : seen_from;
      }
    }
    return {};
  }

  static constexpr double APART = 0.1; // of two directions whose descents may differ
  static constexpr double EVEN = 0.02; // spread of rays that ends the search
  // Of the spread of rays from far away. Rasters of heights have 1; scans of one side had up to 0.52,
  // and one of an upright body 0.70 to 0.76.
  static constexpr double FARTHER = 0.75;
  static constexpr double CLOSER = 0.16;     // the step after two rounds
  static constexpr double AREA_ERROR = 0.05; // of a viewpoint, in bounding boxes

  // What a descent makes even. In a scan from a moving car, outlines hide each other: the density of the
  // rays leads near the place, and then rays and rows give it.
  enum class Measure
  {
    ROWS, // of rays and their rows
    RAYS,
    DENSITY // of the rays
  };

  // A viewpoint with enough evidence.
  struct Found
  {
    double cost; // spread of the rays and rows
    Viewpoint viewpoint;
    bool is_even;    // the rays are evenly spaced
    bool explains;   // the density of the points; tried if the rays are not clearly even
    bool is_certain; // either is clear, and the cloud is not evenly sampled
  };

  // Accepts a viewpoint with more even rays. Returns whether these end the search.
  static bool takeBetter (const std::optional<Found>& found, std::optional<Found>& best)
  {
    if (found && (!best || found->cost < best->cost))
      best = found;
    return found && found->cost < EVEN;
  }

  // Whether the cloud is seen from this place. Points that are even to all sides may be a closed body.
  // An evenly sampled cloud must be less even from far on this side, unlike a raster of heights.
  bool isDetermined (const Found& found) const
  {
    const Viewpoint& place = found.viewpoint;
    if (!found.explains && !place.is_far && looksToAllSides (positions, place))
      return false;
    return found.is_certain ||
           (!place.is_far && evidenceAt (place).ray_spread <
                                 FARTHER * evidenceAt (farFrom (place, box.center ())).ray_spread);
  }

  // Mirror image of a viewpoint at the plane of the samples around it. A scanner low above the
  // ground is closer to its image than the precision of a descent by areas.
  Viewpoint mirrored (const Viewpoint& viewpoint) const
  {
    constexpr std::size_t AROUND = 50; // samples: a tenth, as few as a plane needs
    std::vector<Vector3d> offsets;
    for (const AreaSample& sample : samples)
      offsets.emplace_back (sample.position - viewpoint.place);
    const auto around = offsets.begin () + std::min (offsets.size (), AROUND);
    std::partial_sort (
        offsets.begin (), around, offsets.end (),
        [] (const Vector3d& a, const Vector3d& b) { return a.squaredNorm () < b.squaredNorm (); });
    PlaneFit fit;
    for (auto offset = offsets.begin (); offset != around; ++offset)
      fit.add (*offset);
    const Plane plane = fit.plane ();
    const double height = plane.height (Vector3d::Zero ());
    return {viewpoint.place - 2.0 * height * plane.normal, false};
  }

  bool isHopeless (const std::vector<RayPatch>& patches, const Viewpoint& viewpoint,
                   const Excess& excess) const
  {
    const RayEvidence evidence = findRayEvidence (positions, patches, viewpoint, run);
    return findRaySpread (positions, patches, viewpoint, false, run) >
               excess.regularity * usual_excess * REGULARITY * evidence.point_spread ||
           evidence.nearShare () > excess.near_share * NEAR_SHARE;
  }

  // Rows determine the viewpoint of a spinning lidar along its axis, but may mislead from far off,
  // where single rays do not. In a narrow valley, the search ends early: it begins again from there.
  std::optional<Found> refine (const Viewpoint& start, double step = AREA_ERROR) const
  {
    constexpr double CLEARLY = 0.9; // by hand
    std::optional<Found> best;
    takeBetter (refineBy (start, step, Measure::ROWS), best);
    if (!best || !best->is_even)
      takeBetter (refineBy (start, step, Measure::RAYS), best);
    for (double cost = std::numeric_limits<double>::infinity (); best && best->cost < cost;) {
      cost = CLEARLY * best->cost;
      takeBetter (refineBy (best->viewpoint, CLOSER * step, Measure::ROWS), best);
    }
    return best;
  }

  RayEvidence evidenceAt (const Viewpoint& viewpoint) const
  {
    return findRayEvidence (positions, findRayPatches (positions, viewpoint, run, patch_count),
                            viewpoint, run);
  }

  // Patches from a better viewpoint give a still better one; far from it, a few suffice.
  std::optional<Found> refineBy (Viewpoint viewpoint, double step, Measure measure) const
  {
    constexpr std::size_t FIRST = 3;  // rounds
    constexpr std::size_t ROUNDS = 7; // with new patches; 9 were no better for 278 generated scans
    constexpr std::size_t EVALUATIONS = 400; // in each round
    constexpr double LENIENT = 1.5; // in the first ones; real scans have up to 1.1 at the start
    const bool by_density = measure == Measure::DENSITY;
    for (std::size_t round = 0; round < ROUNDS; ++round) {
      const bool is_first = round < FIRST;
      const std::vector<RayPatch> patches =
          findRayPatches (positions, viewpoint, run, is_first ? few_patches : patch_count);
      const auto densities = [&] (const Viewpoint& v) {
        return findDensityEvidence (positions, patches, v, run);
      };
      const double most = (is_first ? LENIENT : 1.0) * SEARCHED_DENSITY_REGULARITY;
      if (by_density ? round <= FIRST && densities (viewpoint).left () > most
                     : round == FIRST && isHopeless (patches, viewpoint, EARLY_FROM_FAR))
        return {};
      const auto cost = [&] (const Viewpoint& v) {
        return by_density && is_first
                   ? densities (v).ray_spread
                   : findRaySpread (positions, patches, v, measure != Measure::RAYS, run);
      };
      viewpoint =
          patternSearch (viewpoint, step, 0.2 * step, box.center (), EVALUATIONS, cost).viewpoint;
      step *= 0.4;
      if (!by_density && isHopeless (patches, viewpoint,
                                     !is_first          ? LATE
                                     : viewpoint.is_far ? EARLY_FROM_FAR
                                                        : EARLY))
        return {};
    }
    const std::vector<RayPatch> patches = findRayPatches (positions, viewpoint, run, patch_count);
    const RayEvidence rays = findRayEvidence (positions, patches, viewpoint, run);
    const bool is_sure = isSeenFromThere (rays, usual_excess);
    // Along a far direction, nothing is beside.
    const bool explains =
        !is_sure && !viewpoint.is_far &&
        explainsDensity (positions, findDensityEvidence (positions, patches, viewpoint, run),
                         viewpoint, SEARCHED_DENSITY_REGULARITY, run);
    const bool is_even = // with evidence of its own, see isDetermined ()
        is_sure || (!viewpoint.is_far && isSeenFromThere (rays, LATE.regularity));
    if (!is_even && !explains)
      return {};
    return Found{findRaySpread (positions, patches, viewpoint, true, run), viewpoint, is_even,
                 explains, may_be_far && (is_sure || explains)};
  }
};

} // namespace

RowEvidence
findRows (const Points& points, const RowOf& row_of)
{
  constexpr std::size_t TESTED = 500;
  constexpr double OPPOSITE = -0.7; // cosine of 135 degrees
  constexpr double BENT = 0.87;     // cosine of 30 degrees; noise of 0.3 spacings turns rows by 12
  constexpr double FEWEST_BENT = 0.02; // of the rows: such noise has 0.012, a body on a table more
  const Positions& positions = points.positions;
  const std::size_t step = std::max<std::size_t> (1, positions.size () / TESTED);
  std::size_t looked_at = 0;
  std::vector<Vector3d> directions;                 // of the rows
  Eigen::Matrix3d along = Eigen::Matrix3d::Zero (); // sum of their squares
  for (std::size_t p = step / 2; p < positions.size (); p += step) {
    const Row row = row_of (static_cast<Index> (p));
    if (row.size () < 2)
      continue;
    const Vector3d u = (positions[row[0]] - positions[p]).normalized ();
    const Vector3d v = (positions[row[1]] - positions[p]).normalized ();
    ++looked_at;
    if (u.dot (v) >= OPPOSITE)
      continue;
    directions.push_back ((u - v).normalized ());
    along += directions.back () * directions.back ().transpose ();
  }
  RowEvidence rows;
  if (directions.empty ())
    return rows;
  const auto axesOf = [] (const Eigen::Matrix3d& squares) -> Eigen::Matrix3d {
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> (squares).eigenvectors ();
  };
  // Most rows may have one direction, which with any other one gives the plane.
  const Vector3d usual = axesOf (along).col (2);
  along.setZero ();
  double bent = 0.0;
  for (const Vector3d& direction : directions)
    if (std::abs (direction.dot (usual)) < BENT) {
      ++bent;
      along += direction * direction.transpose () + usual * usual.transpose ();
    }
  const auto in_rows = static_cast<double> (directions.size ());
  rows.share = in_rows / static_cast<double> (looked_at);
  rows.across = axesOf (along).col (0);
  rows.are_straight = bent < FEWEST_BENT * in_rows;
  return rows;
}

std::optional<Viewpoint>
findViewpoint (const Points& points, const RowOf& row_of, const std::vector<AreaSample>& samples,
               SearchReason reason, const RunContext& run)
{
  // Spread of the areas of patches; below, a cloud is sampled evenly. Random points have 0.2.
  constexpr double EVEN = 0.35;
  // Share of points between their two nearest neighbours; above, the cloud was scanned along lines.
  // Random points have 0.25, a square raster 0.33.
  constexpr double LINES = 0.6;
  // The same of a spinning lidar, for a search by the density of its rays: graded sheets are as even
  // from some place. 15 scans of cars have 0.47 and more, such sheets of random points up to 0.25.
  constexpr double RINGS = 0.4;
  constexpr std::size_t FEWEST_PATCHES = 16, FEWEST_FOR_PLACES = 32;
  const std::size_t patches = std::min (PATCHES, points.size () / PATCH_POINTS);
  if (patches < FEWEST_PATCHES)
    return {};
  const bool for_uneven = reason == SearchReason::UNEVEN;
  ViewpointSearch search{points.positions, row_of, samples, patches, for_uneven, run};
  for (const Vector3d& position : points.positions)
    search.box.extend (position);
  const RowEvidence rows = for_uneven ? findRows (points, row_of) : RowEvidence ();
  if (rows.share > LINES && !rows.are_straight)
    if (const std::optional<Viewpoint> found = search.findAlongRows (rows.across))
      return found;
  if (patches < FEWEST_FOR_PLACES || samples.size () < AREA_SAMPLES / 2 ||
      (spreadOfAreas (samples) > EVEN) != for_uneven)
    return {};
  return search.find (rows.share > RINGS);
}

} // namespace pcl::floater

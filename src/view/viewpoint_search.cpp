// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/viewpoint_search.h"

#include "core/geometry.h"
#include "core/parallel.h"
#include "view/ray_evidence.h"

#include <Eigen/Eigenvalues>

namespace pcl::floater {
namespace {
class ViewpointSearch
{
public:
  ViewpointSearch (const Points& points, const RowOf& row_of,
                   const std::vector<AreaSample>& samples, const SearchLimits& limits,
                   const EvidenceLimits& evidence, bool may_be_far, const RunContext& run)
      : positions_ (points.positions), row_of_ (row_of), limits_ (limits), evidence_ (evidence),
        run_ (run), samples_ (samples), may_be_far_ (may_be_far)
  {
    for (const Vector3d& position : positions_)
      box_.extend (position);
    evidence_.hidden_share *= evidence_.density_regularity / limits.density_regularity;
    evidence_.density_regularity = limits.density_regularity;
    lenient_ = evidence_;
    lenient_.regularity *= limits.late.regularity;
    if (!may_be_far)
      evidence_ = lenient_;
    coarse_ = evidence_;
    coarse_.patches = std::min (coarse_.patches, limits.coarse_patches);
  }

  // For parallel rays: a row lies in the plane of its rays, and all these planes are parallel.
  std::optional<Viewpoint> findAlongRows (const Vector3d& across) const
  {
    const Vector3d x = across.unitOrthogonal (), y = across.cross (x);
    const std::size_t count = limits_.row_directions;
    const double step = PI / static_cast<double> (count);
    std::vector<RatedViewpoint> candidates;
    for (std::size_t k = 0; k < count; ++k) {
      const double angle = step * static_cast<double> (k);
      candidates.push_back ({0.0, {std::cos (angle) * x + std::sin (angle) * y, true}});
    }
    // Patches in space, for any direction of the rays.
    constexpr std::size_t FEW = 16; // with 480 rays that are judged
    const std::vector<RayPatch> patches = findPointPatches (
        positions_, row_of_, std::min (coarse_.patches, FEW), coarse_.patch_points);
    // Lines on a plane are even from all directions, and show none. In 80 generated line scans, the
    // least cost was up to .053 of the median; along noisy lines that are no scan, .15 and more.
    constexpr double LEAST = 0.1;
    parallelTasks (run_, count, [&] (std::size_t k) {
      candidates[k].cost =
          findRaySpread (positions_, patches, candidates[k].viewpoint, false, run_.withThreads (1));
    });
    std::stable_sort (candidates.begin (), candidates.end (), isCheaper);
    if (candidates.front ().cost > LEAST * candidates[count / 2].cost)
      return {};
    // Rays are evenly spaced from the right direction only; from others, less than from those
    // around.
    std::optional<Found> best;
    for (const RatedViewpoint& start : keepApart (candidates, APART, limits_.by_rows))
      if (takeBetter (refine (start.viewpoint, step), best))
        break;
    return best && best->is_certain ? std::optional<Viewpoint> (best->viewpoint) : std::nullopt;
  }

  // \param in_rows points lie in rows, as those of a spinning lidar
  std::optional<Viewpoint> find (bool in_rows) const
  {
    std::vector<RatedViewpoint> candidates =
        searchByAreas (samples_, box_, may_be_far_, limits_.areas, run_);
    // Areas can mislead: in a plane, they are the same from many places. Rays tell which is right.
    parallelTasks (run_, candidates.size (), [&] (std::size_t k) {
      const RunContext one = run_.withThreads (1);
      const Viewpoint& place = candidates[k].viewpoint;
      candidates[k].cost = findRaySpread (
          positions_, findRayPatches (positions_, place, coarse_, one), place, true, one);
    });
    std::stable_sort (candidates.begin (), candidates.end (), isCheaper);
    candidates.resize (std::min (candidates.size (), limits_.by_rays));
    for (const RatedViewpoint& candidate : candidates) {
      std::optional<Found> found;
      const bool ends = takeBetter (refine (candidate.viewpoint), found);
      if (may_be_far_ && !candidate.viewpoint.is_far) {
        if (!ends && (!found || found->is_certain))
          takeBetter (refine (mirrored (candidate.viewpoint)), found);
        if (!found)
          takeBetter (refine (candidate.viewpoint, CLOSER * AREA_ERROR), found);
        if (!found && in_rows)
          takeBetter (refineBy (candidate.viewpoint, AREA_ERROR, Measure::DENSITY), found);
      }
      if (found && isDetermined (*found))
        return isAsFar (found->viewpoint) ? farFrom (found->viewpoint, box_.center ())
                                          : found->viewpoint;
    }
    return {};
  }

private:
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

  // Accepts a viewpoint with more even rays. Returns whether they are even enough to end the
  // search.
  static bool takeBetter (const std::optional<Found>& found, std::optional<Found>& best)
  {
    if (found && (!best || found->cost < best->cost))
      best = found;
    return found && found->cost < EVEN;
  }

  // Whether the cloud is seen from this place. Points that are even to all sides may be a closed body.
  // A cloud that is sampled evenly must be less even from far away on this side, unlike a raster of
  // heights.
  bool isDetermined (const Found& found) const
  {
    const Viewpoint& place = found.viewpoint;
    if (!found.explains && !place.is_far && looksToAllSides (positions_, place, evidence_))
      return false;
    return found.is_certain ||
           (!place.is_far && evidenceAt (place).ray_spread <
                                 FARTHER * evidenceAt (farFrom (place, box_.center ())).ray_spread);
  }

  // Whether rays from there are as even as parallel ones: within the cloud, whose diagonal is 1, their
  // spacing changes by less than the spread that counts as even. Such a place may be on the wrong side.
  bool isAsFar (const Viewpoint& found) const
  {
    return !found.is_far && (found.place - box_.center ()).norm () * EVEN > 1.0;
  }

  // Samples for the plane around a viewpoint: a tenth, as few as a plane needs.
  static constexpr std::size_t AROUND = 50;

  // Mirror image of a viewpoint at the plane of the samples around it. A scanner low above the
  // ground is closer to its image than the precision of a descent by areas.
  Viewpoint mirrored (const Viewpoint& viewpoint) const
  {
    std::vector<Vector3d> offsets;
    for (const AreaSample& sample : samples_)
      offsets.emplace_back (sample.position - viewpoint.place);
    const auto around =
        offsets.begin () + static_cast<std::ptrdiff_t> (std::min (offsets.size (), AROUND));
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
                   const EvidenceLimits& limits, const EvidenceExcess& excess) const
  {
    const RayEvidence evidence = findRayEvidence (positions_, patches, viewpoint, limits, run_);
    return findRaySpread (positions_, patches, viewpoint, false, run_) >
               excess.regularity * evidence_.regularity * evidence.point_spread ||
           evidence.nearShare () > excess.near_share * evidence_.near_share;
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
    return findRayEvidence (positions_, findRayPatches (positions_, viewpoint, evidence_, run_),
                            viewpoint, evidence_, run_);
  }

  // Patches from a better viewpoint give a still better one; far from it, a few suffice.
  std::optional<Found> refineBy (Viewpoint viewpoint, double step, Measure measure) const
  {
    constexpr std::size_t EARLY = 3; // rounds
    constexpr double LENIENT = 1.5;  // before; real scans have up to 1.1 at the start
    const bool by_density = measure == Measure::DENSITY;
    for (std::size_t round = 0; round < limits_.rounds; ++round) {
      const EvidenceLimits& limits = round < EARLY ? coarse_ : evidence_;
      const std::vector<RayPatch> patches = findRayPatches (positions_, viewpoint, limits, run_);
      const auto densities = [&] (const Viewpoint& v) {
        return findDensityEvidence (positions_, patches, v, evidence_, run_);
      };
      const double most = (round < EARLY ? LENIENT : 1.0) * evidence_.density_regularity;
      if (by_density
              ? round <= EARLY && densities (viewpoint).left (evidence_) > most
              : round == EARLY && isHopeless (patches, viewpoint, limits, limits_.early_from_far))
        return {};
      const auto cost = [&] (const Viewpoint& v) {
        return by_density && round < EARLY
                   ? densities (v).ray_spread
                   : findRaySpread (positions_, patches, v, measure != Measure::RAYS, run_);
      };
      viewpoint =
          patternSearch (viewpoint, step, 0.2 * step, box_.center (), limits_.ray_evaluations, cost)
              .viewpoint;
      step *= 0.4;
      if (!by_density && isHopeless (patches, viewpoint, limits,
                                     round >= EARLY     ? limits_.late
                                     : viewpoint.is_far ? limits_.early_from_far
                                                        : limits_.early))
        return {};
    }
    const std::vector<RayPatch> patches = findRayPatches (positions_, viewpoint, evidence_, run_);
    const RayEvidence rays = findRayEvidence (positions_, patches, viewpoint, evidence_, run_);
    const bool is_sure = isSeenFromThere (rays, evidence_);
    // Along a far direction, nothing is beside.
    const bool explains =
        !is_sure && !viewpoint.is_far &&
        explainsDensity (positions_,
                         findDensityEvidence (positions_, patches, viewpoint, evidence_, run_),
                         viewpoint, evidence_, run_);
    const bool is_even = is_sure || (!viewpoint.is_far && isSeenFromThere (rays, lenient_));
    if (!is_even && !explains)
      return {};
    return Found{findRaySpread (positions_, patches, viewpoint, true, run_), viewpoint, is_even,
                 explains, may_be_far_ && (is_sure || explains)};
  }

  const Positions& positions_;
  const RowOf& row_of_;
  const SearchLimits& limits_;
  EvidenceLimits evidence_;
  EvidenceLimits coarse_;  // fewer patches, during the search
  EvidenceLimits lenient_; // with evidence of its own, see isDetermined ()
  RunContext run_;
  const std::vector<AreaSample>& samples_;
  Eigen::AlignedBox3d box_;
  bool may_be_far_;
};

} // namespace

RowEvidence
findRows (const Points& points, const RowOf& row_of, std::size_t count)
{
  constexpr double OPPOSITE = -0.7; // cosine of 135 degrees
  constexpr double BENT = 0.87;     // cosine of 30 degrees. Noise of 0.3 spacings along the surface
                                    // turns rows by 12 degrees
  constexpr double FEWEST_BENT = 0.02; // of the rows: such noise has 0.012, a body on a table more
  const Positions& positions = points.positions;
  const std::size_t step = std::max<std::size_t> (1, positions.size () / count);
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
               SearchReason reason, const SearchLimits& limits, const EvidenceLimits& evidence,
               const RunContext& run)
{
  constexpr std::size_t FEWEST_PATCHES = 16;
  EvidenceLimits filled = evidence;
  filled.patches = std::min (evidence.patches, points.size () / evidence.patch_points);
  if (filled.patches < FEWEST_PATCHES)
    return {};
  const bool for_uneven = reason == SearchReason::UNEVEN;
  const ViewpointSearch search (points, row_of, samples, limits, filled, for_uneven, run);
  RowEvidence rows;
  if (for_uneven)
    rows = findRows (points, row_of, limits.samples);
  if (rows.share > limits.rows && !rows.are_straight)
    if (const std::optional<Viewpoint> found = search.findAlongRows (rows.across))
      return found;
  constexpr std::size_t LEAST_SHARE = 4; // a quarter of the patches
  if (LEAST_SHARE * filled.patches < evidence.patches || samples.size () < limits.samples / 2 ||
      (spreadOfAreas (samples) > limits.even) != for_uneven)
    return {};
  return search.find (rows.share > limits.rings);
}

} // namespace pcl::floater

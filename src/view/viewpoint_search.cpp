// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/viewpoint_search.h"

#include "core/geometry.h"
#include "core/parallel.h"
#include "view/ray_evidence.h"
#include "view/viewpoint_fit.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl::floater {
namespace {
class ViewpointSearch
{
public:
  ViewpointSearch (const Points& points, const CsrLists& neighbors,
                   const std::vector<AreaSample>& samples, const SearchLimits& limits,
                   const EvidenceLimits& evidence, const RunContext& run)
      : positions_ (points.positions), neighbors_ (neighbors), limits_ (limits),
        evidence_ (evidence), run_ (run), samples_ (samples)
  {
    for (const Eigen::Vector3d& position : positions_)
      box_.extend (position);
    coarse_ = evidence_;
    coarse_.patches = std::min (coarse_.patches, limits.coarse_patches);
    constexpr std::size_t EVERY = 4;
    for (std::size_t i = 0; i < samples_.size (); i += EVERY)
      few_samples_.push_back (samples_[i]);
  }

  bool hasSamples () const { return samples_.size () >= limits_.samples / 2; }

  // Spread of the areas without any viewpoint.
  double spreadOfAreas () const
  {
    std::vector<double> areas;
    for (const AreaSample& sample : samples_)
      areas.push_back (sample.area);
    return quartileSpread (areas);
  }

  // For parallel rays: a row lies in the plane of its rays, and all these planes are parallel.
  std::optional<Viewpoint> findAlongRows (const Eigen::Vector3d& across) const
  {
    const Eigen::Vector3d x = across.unitOrthogonal (), y = across.cross (x);
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
        positions_, neighbors_, std::min (coarse_.patches, FEW), coarse_.patch_points);
    // Lines on a plane are even from all directions, and show none. Around the right direction,
    // costs rise slowly, so every third direction shows whether there may be one: in 80 generated
    // line scans, the least of these costs was .009 to .053 of their median.
    constexpr std::size_t THIRD = 3;
    constexpr double BESIDE = 2.0; // factor of the least cost up to 1.5 degrees away
    std::vector<RatedViewpoint> thirds;
    for (std::size_t k = 0; k < count; k += THIRD)
      thirds.push_back (candidates[k]);
    rateByRays (thirds, patches);
    if (!standsOut (thirds, BESIDE * evidence_.regularity))
      return {};
    rateByRays (candidates, patches);
    if (!standsOut (candidates, evidence_.regularity))
      return {};
    std::vector<RatedViewpoint> starts;
    for (const RatedViewpoint& candidate : candidates)
      if (starts.size () < limits_.by_rows && !isNear (candidate, starts, APART))
        starts.push_back (candidate);
    // Rays are evenly spaced from the right direction only; from others, less than from those
    // around.
    RatedViewpoint best = NOT_FOUND;
    for (const RatedViewpoint& start : starts)
      if (takeBetter (refine (start.viewpoint, step), best))
        break;
    return placeOf (best);
  }

  std::optional<Viewpoint> find () const
  {
    std::vector<RatedViewpoint> descents = bestStarts ();
    parallelTasks (run_, descents.size (), [&] (std::size_t k) {
      std::vector<double> angles;
      const auto cost = [&] (const Viewpoint& v) { return areaSpread (samples_, v, angles); };
      descents[k] = patternSearch (descents[k].viewpoint, cell (), SMALLEST_AREA_STEP,
                                   box_.center (), limits_.area_evaluations, cost);
    });
    std::vector<RatedViewpoint> candidates;
    for (const RatedViewpoint& found : descents)
      if (!isNear (found, candidates, 4.0 * SMALLEST_AREA_STEP))
        candidates.push_back (found);
    std::stable_sort (candidates.begin (), candidates.end (), isCheaper);
    if (candidates.empty () || candidates.front ().cost > limits_.explained * spreadOfAreas ())
      return {};
    // First the best by areas, then the best by rays of the next ones. Areas can mislead: in a
    // plane, they are the same from the mirror image of a viewpoint.
    candidates.resize (std::min (candidates.size (), limits_.by_areas + limits_.compared));
    const auto others = candidates.begin () + static_cast<std::ptrdiff_t> (
                                                  std::min (candidates.size (), limits_.by_areas));
    for (auto candidate = candidates.begin (); candidate != others; ++candidate) {
      RatedViewpoint found = NOT_FOUND;
      if (!takeBetter (refineWithFar (candidate->viewpoint), found) && !candidate->viewpoint.is_far)
        takeBetter (refine (mirrored (candidate->viewpoint)), found);
      if (const std::optional<Viewpoint> place = placeOf (found))
        return place;
    }
    for (auto candidate = others; candidate != candidates.end (); ++candidate)
      candidate->cost = costByRays (
          candidate->viewpoint, findRayPatches (positions_, candidate->viewpoint, coarse_, run_));
    const auto best = std::min_element (others, candidates.end (), isCheaper);
    return best == candidates.end () ? std::nullopt : refineWithFar (best->viewpoint);
  }

private:
  static constexpr double APART = 0.1;       // of two directions whose descents may differ
  static constexpr double EVEN = 0.02;       // spread of rays that ends the search
  static constexpr double PLAIN = 0.1;       // ratio of the spreads that leaves no doubt
  static constexpr double SIDESTEP = 0.03;   // from a fit that outlines do not agree with, as above
  static constexpr double AREA_ERROR = 0.05; // of a viewpoint, in bounding boxes

  inline static const RatedViewpoint NOT_FOUND{std::numeric_limits<double>::infinity (), {}};

  static std::optional<Viewpoint> placeOf (const RatedViewpoint& found)
  {
    return found.cost < NOT_FOUND.cost ? std::optional<Viewpoint> (found.viewpoint) : std::nullopt;
  }

  // Accepts a viewpoint with more even rays. Returns whether they are even enough to end the
  // search.
  bool takeBetter (const std::optional<Viewpoint>& found, RatedViewpoint& best) const
  {
    if (!found)
      return false;
    const double cost = costByRays (*found, findRayPatches (positions_, *found, evidence_, run_));
    if (cost < best.cost)
      best = {cost, *found};
    return cost < EVEN;
  }

  // Areas give a viewpoint to about a hundredth of the bounding box; rays refine it.
  static constexpr double SMALLEST_AREA_STEP = 4e-3;

  // Samples for the plane around a viewpoint: a tenth, as few as a plane needs.
  static constexpr std::size_t AROUND = 50;

  static bool isCheaper (const RatedViewpoint& a, const RatedViewpoint& b)
  {
    return a.cost < b.cost;
  }

  static bool isNear (const RatedViewpoint& candidate, const std::vector<RatedViewpoint>& others,
                      double distance)
  {
    return std::any_of (others.begin (), others.end (), [&] (const RatedViewpoint& other) {
      return other.viewpoint.is_far == candidate.viewpoint.is_far &&
             (other.viewpoint.place - candidate.viewpoint.place).norm () < distance;
    });
  }

  // Cell size of the grid of viewpoints.
  double cell () const
  {
    return 2.0 * box_.sizes ().maxCoeff () / static_cast<double> (limits_.cells);
  }

  // The best viewpoints by areas, without those beside a better one.
  std::vector<RatedViewpoint> bestStarts () const
  {
    std::vector<RatedViewpoint> candidates = startingPlaces ();
    std::stable_sort (candidates.begin (), candidates.end (), isCheaper);
    std::vector<RatedViewpoint> starts;
    for (const RatedViewpoint& candidate : candidates) {
      if (starts.size () == limits_.starts)
        break;
      if (!isNear (candidate, starts, 2.0 * cell ()))
        starts.push_back (candidate);
    }
    return starts;
  }

  // Mirror image of a viewpoint at the plane of the samples around it. A scanner low above the
  // ground is closer to its image than the precision of a descent by areas.
  Viewpoint mirrored (const Viewpoint& viewpoint) const
  {
    std::vector<Eigen::Vector3d> offsets;
    for (const AreaSample& sample : samples_)
      offsets.emplace_back (sample.position - viewpoint.place);
    const auto around =
        offsets.begin () + static_cast<std::ptrdiff_t> (std::min (offsets.size (), AROUND));
    std::partial_sort (offsets.begin (), around, offsets.end (),
                       [] (const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
                         return a.squaredNorm () < b.squaredNorm ();
                       });
    PlaneFit fit;
    for (auto offset = offsets.begin (); offset != around; ++offset)
      fit.add (*offset);
    const Plane plane = fit.plane ();
    const double height = plane.height (Eigen::Vector3d::Zero ());
    return {viewpoint.place - 2.0 * height * plane.normal, false};
  }

  // A grid of viewpoints, and far ones, rated by a few areas.
  std::vector<RatedViewpoint> startingPlaces () const
  {
    std::vector<RatedViewpoint> candidates;
    const auto add = [&candidates] (const Viewpoint& viewpoint) {
      candidates.push_back ({0.0, viewpoint});
    };
    const Eigen::Vector3d size = box_.sizes (), centre = box_.center ();
    const auto cells = static_cast<double> (limits_.cells);
    const std::size_t n = limits_.cells;
    for (std::size_t i = 0; i < n * n * n; ++i) {
      const std::size_t column = i / n % n, layer = i / (n * n);
      const Eigen::Array3d cell (static_cast<double> (i % n), static_cast<double> (column),
                                 static_cast<double> (layer));
      const Eigen::Vector3d offset = (2.0 * (cell + 0.5) / cells - 1.0).matrix ();
      add ({centre + offset.cwiseProduct (size), false});
    }
    // On spheres around the box, the last of infinite radius.
    for (std::size_t i = 0; i < limits_.directions; ++i) {
      const Eigen::Vector3d direction = spiralDirection (i, limits_.directions);
      for (const double distance : {1.5, 3.0, 6.0})
        add ({centre + distance * size.norm () * direction, false});
      add ({direction, true});
    }
    parallelRanges (run_, candidates.size (), [&] (std::size_t first, std::size_t last) {
      std::vector<double> angles;
      for (std::size_t i = first; i < last; ++i)
        candidates[i].cost = areaSpread (few_samples_, candidates[i].viewpoint, angles);
    });
    return candidates;
  }

  // Only the spreads: towards the viewpoint they fall all the way, while the share of near rays
  // first rises where outlines begin to overlap.
  double costByRays (const Viewpoint& viewpoint, const std::vector<RayPatch>& patches) const
  {
    return costByRays (viewpoint, patches, true, run_.threads ());
  }

  double costByRays (const Viewpoint& viewpoint, const std::vector<RayPatch>& patches,
                     bool with_rows, int threads) const
  {
    const RayEvidence found = findRayEvidence (positions_, patches, viewpoint, evidence_,
                                               run_.withThreads (threads), with_rows);
    return found.ray_spread + (with_rows ? found.row_spread : 0.0);
  }

  void rateByRays (std::vector<RatedViewpoint>& candidates,
                   const std::vector<RayPatch>& patches) const
  {
    parallelTasks (run_, candidates.size (), [&] (std::size_t k) {
      candidates[k].cost = costByRays (candidates[k].viewpoint, patches, true, 1);
    });
  }

  // Sorts candidates by cost. Returns whether the least one is a small share of the median.
  static bool standsOut (std::vector<RatedViewpoint>& candidates, double share)
  {
    std::stable_sort (candidates.begin (), candidates.end (), isCheaper);
    return candidates.front ().cost <= share * candidates[candidates.size () / 2].cost;
  }

  // Areas hardly separate far viewpoints: parallel rays are tried first.
  std::optional<Viewpoint> refineWithFar (const Viewpoint& viewpoint) const
  {
    constexpr double FAR = 1.5; // bounding boxes
    const Eigen::Vector3d offset = box_.center () - viewpoint.place;
    if (!viewpoint.is_far && offset.norm () > FAR)
      if (const std::optional<Viewpoint> found = refine ({offset.normalized (), true}))
        return found;
    return refine (viewpoint);
  }

  bool isHopeless (const RayEvidence& evidence, const EvidenceExcess& excess) const
  {
    return evidence.ray_spread > excess.regularity * evidence_.regularity * evidence.point_spread ||
           evidence.near_share > excess.near_share * evidence_.near_share;
  }

  // Rows determine the viewpoint of a spinning lidar along its axis, but may mislead for other
  // rasters.
  std::optional<Viewpoint> refine (const Viewpoint& start, double step = AREA_ERROR) const
  {
    const std::optional<Viewpoint> found = refineBy (start, step, true);
    if (found && isSeenFromThere (evidenceAt (*found), evidence_))
      return found;
    const std::optional<Viewpoint> other = refineBy (start, step, false);
    if (!found || !other)
      return found ? found : other;
    return evidenceAt (*found).ray_spread <= evidenceAt (*other).ray_spread ? found : other;
  }

  RayEvidence evidenceAt (const Viewpoint& viewpoint) const
  {
    return findRayEvidence (positions_, findRayPatches (positions_, viewpoint, evidence_, run_),
                            viewpoint, evidence_, run_);
  }

  Viewpoint searchByRays (const Viewpoint& start, double step, double smallest_step,
                          const std::vector<RayPatch>& patches, bool with_rows) const
  {
    const auto cost = [&] (const Viewpoint& v) {
      return costByRays (v, patches, with_rows, run_.threads ());
    };
    return patternSearch (start, step, smallest_step, box_.center (), limits_.ray_evaluations, cost)
        .viewpoint;
  }

  std::optional<Viewpoint> refineBy (Viewpoint viewpoint, double step, bool with_rows) const
  {
    constexpr double PRECISION = 1e-6; // a tenth of the spacing of a scan of 1e10 points
    for (std::size_t round = 0; round < limits_.rounds; ++round) {
      const std::vector<RayPatch> patches = findRayPatches (positions_, viewpoint, coarse_, run_);
      viewpoint = searchByRays (viewpoint, step, 0.2 * step, patches, with_rows);
      step *= 0.3;
      // If the first, coarse steps give no better evidence than this, finer ones rarely do.
      if (isHopeless (findRayEvidence (positions_, patches, viewpoint, coarse_, run_),
                      viewpoint.is_far ? limits_.after_round_from_far : limits_.after_round))
        return {};
    }
    // Patches from a better viewpoint give a still better one.
    const Viewpoint unfitted = viewpoint;
    RayEvidence evidence;
    for (std::size_t round = 0; round < limits_.fits; ++round) {
      const EvidenceLimits& limits = round == 0 ? coarse_ : evidence_;
      const std::vector<RayPatch> patches = findRayPatches (positions_, viewpoint, limits, run_);
      const Eigen::Vector3d before = viewpoint.place;
      viewpoint = fitViewpoint (positions_, patches, viewpoint, round == 0, run_);
      evidence = findRayEvidence (positions_, patches, viewpoint, limits, run_);
      if (round == 0 && isHopeless (evidence, limits_.after_first_fit))
        return {};
      if (round > 0 && ((viewpoint.place - before).norm () < PRECISION ||
                        isHopeless (evidence, limits_.after_fit)))
        break;
    }
    // A fit takes outlines for outliers, and on smooth surfaces nothing else tells where the sensor
    // was.
    if (evidence.ray_spread > std::max (EVEN, PLAIN * evidence.point_spread) && !viewpoint.is_far &&
        !isHopeless (evidence, limits_.after_first_fit)) {
      if (evidenceAt (unfitted).ray_spread < evidence.ray_spread)
        viewpoint = unfitted;
      for (step = SIDESTEP; step > SIDESTEP / 100.0; step *= 0.1) {
        const std::vector<RayPatch> patches =
            findRayPatches (positions_, viewpoint, evidence_, run_);
        viewpoint = searchByRays (viewpoint, step, 0.05 * step, patches, with_rows);
      }
      evidence = evidenceAt (viewpoint);
    }
    // Along a far direction, nothing is beside.
    if (isSeenFromThere (evidence, evidence_) ||
        (!viewpoint.is_far &&
         explainsDensity (positions_, findRayPatches (positions_, viewpoint, evidence_, run_),
                          viewpoint, evidence_, run_)))
      return viewpoint;
    return {};
  }

  const std::vector<Eigen::Vector3d>& positions_;
  const CsrLists& neighbors_;
  const SearchLimits& limits_;
  EvidenceLimits evidence_;
  EvidenceLimits coarse_; // fewer patches, during the search
  RunContext run_;
  const std::vector<AreaSample>& samples_;
  std::vector<AreaSample> few_samples_; // to compare many viewpoints
  Eigen::AlignedBox3d box_;
};

} // namespace

std::optional<Viewpoint>
findViewpoint (const Points& points, const CsrLists& neighbors,
               const std::vector<AreaSample>& samples, bool is_noisy, const SearchLimits& limits,
               const EvidenceLimits& evidence, const RunContext& run)
{
  constexpr std::size_t FEWEST_PATCHES = 16;
  EvidenceLimits filled = evidence;
  filled.patches = std::min (evidence.patches, points.size () / evidence.patch_points);
  if (filled.patches < FEWEST_PATCHES)
    return {};
  const ViewpointSearch search (points, neighbors, samples, limits, filled, run);
  if (!is_noisy) {
    const RowEvidence rows = findRows (points, neighbors, limits.samples);
    if (rows.share > limits.rows && !rows.are_straight)
      if (const std::optional<Viewpoint> found = search.findAlongRows (rows.across))
        return found;
  }
  const std::size_t least_share = is_noisy ? 1 : 4; // a quarter of the patches
  if (least_share * filled.patches < evidence.patches || !search.hasSamples () ||
      (search.spreadOfAreas () <= limits.even) != is_noisy)
    return {};
  return search.find ();
}

} // namespace pcl::floater

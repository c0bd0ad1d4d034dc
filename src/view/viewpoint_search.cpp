// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/viewpoint_search.h"

#include "core/geometry.h"
#include "core/order_statistics.h"
#include "core/parallel.h"
#include "view/pattern_search.h"
#include "view/row_evidence.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl::floater {
namespace {
// Spread of the areas without any viewpoint.
double
spreadOfAreas (const std::vector<AreaSample>& samples)
{
  std::vector<double> areas;
  areas.reserve (samples.size ());
  for (const AreaSample& sample : samples)
    areas.push_back (sample.area);
  return quartileSpread (areas);
}

class ViewpointSearch
{
public:
  ViewpointSearch (const Points& points, const RowOf& row_of,
                   const std::vector<AreaSample>& samples, const SearchLimits& limits,
                   const EvidenceLimits& evidence, bool may_be_far, const RunContext& run)
      : positions_ (points.positions), row_of_ (row_of), limits_ (limits), evidence_ (evidence),
        run_ (run), samples_ (samples), may_be_far_ (may_be_far)
  {
    for (const Eigen::Vector3d& position : positions_)
      box_.extend (position);
    evidence_.hidden_share *= evidence_.density_regularity / limits.density_regularity;
    evidence_.density_regularity = limits.density_regularity;
    lenient_ = evidence_;
    lenient_.regularity *= limits.late.regularity;
    if (!may_be_far)
      evidence_ = lenient_;
    coarse_ = evidence_;
    coarse_.patches = std::min (coarse_.patches, limits.coarse_patches);
    constexpr std::size_t EVERY = 4;
    for (std::size_t i = 0; i < samples_.size (); i += EVERY)
      few_samples_.push_back (samples_[i]);
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

  std::optional<Viewpoint> find () const
  {
    std::vector<RatedViewpoint> descents = startingPlaces ();
    std::stable_sort (descents.begin (), descents.end (), isCheaper);
    // A quarter of the samples gives the spread to twice the error.
    constexpr double ERROR = 0.12;
    if (descents.front ().cost > (1.0 + ERROR) * limits_.explained * spreadOfAreas (few_samples_))
      return {};
    descents = keepApart (descents, 2.0 * cell (), limits_.starts);
    parallelTasks (run_, descents.size (), [&] (std::size_t k) {
      std::vector<double> angles;
      const auto cost = [&] (const Viewpoint& v) { return areaSpread (samples_, v, angles); };
      descents[k] = patternSearch (descents[k].viewpoint, cell (), SMALLEST_AREA_STEP,
                                   box_.center (), limits_.area_evaluations, cost);
    });
    std::vector<RatedViewpoint> candidates =
        keepApart (descents, 4.0 * SMALLEST_AREA_STEP, descents.size ());
    std::stable_sort (candidates.begin (), candidates.end (), isCheaper);
    const double spread = spreadOfAreas (samples_);
    if (candidates.empty () || candidates.front ().cost > limits_.explained * spread)
      return {};
    const double most = spread - limits_.as_good * (spread - candidates.front ().cost);
    const auto isWorse = [&] (const RatedViewpoint& one) {
      std::vector<double> angles;
      return one.cost > most ||
             // A raster of heights is as even from far away.
             (!may_be_far_ &&
              one.cost > NEARER * areaSpread (samples_, farFrom (one.viewpoint), angles));
    };
    candidates.erase (std::remove_if (candidates.begin (), candidates.end (), isWorse),
                      candidates.end ());
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
      }
      if (found && isDetermined (*found))
        return isAsFar (found->viewpoint) ? farFrom (found->viewpoint) : found->viewpoint;
    }
    return {};
  }

private:
  static constexpr double APART = 0.1;  // of two directions whose descents may differ
  static constexpr double EVEN = 0.02;  // spread of rays that ends the search
  static constexpr double NEARER = 0.9; // of the spread of areas from far away
  // Of the spread of rays from far away. Rasters of heights have 1; scans of one side had up to 0.52,
  // and one of an upright body 0.70 to 0.76.
  static constexpr double FARTHER = 0.75;
  static constexpr double CLOSER = 0.16;     // the step after two rounds
  static constexpr double AREA_ERROR = 0.05; // of a viewpoint, in bounding boxes

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
           (!place.is_far &&
            evidenceAt (place).ray_spread < FARTHER * evidenceAt (farFrom (place)).ray_spread);
  }

  // Whether rays from there are as even as parallel ones: within the cloud, whose diagonal is 1, their
  // spacing changes by less than the spread that counts as even. Such a place may be on the wrong side.
  bool isAsFar (const Viewpoint& found) const
  {
    return !found.is_far && (found.place - box_.center ()).norm () * EVEN > 1.0;
  }

  // The direction of rays from far beyond a place.
  Viewpoint farFrom (const Viewpoint& near) const
  {
    return {(box_.center () - near.place).normalized (), true};
  }

  // Areas give a viewpoint to about a hundredth of the bounding box; rays refine it.
  static constexpr double SMALLEST_AREA_STEP = 4e-3;

  // Samples for the plane around a viewpoint: a tenth, as few as a plane needs.
  static constexpr std::size_t AROUND = 50;

  static bool isCheaper (const RatedViewpoint& a, const RatedViewpoint& b)
  {
    return a.cost < b.cost;
  }

  // The first candidates without those near an earlier one.
  static std::vector<RatedViewpoint> keepApart (const std::vector<RatedViewpoint>& candidates,
                                                double distance, std::size_t most)
  {
    std::vector<RatedViewpoint> kept;
    for (const RatedViewpoint& one : candidates)
      if (kept.size () < most &&
          std::none_of (kept.begin (), kept.end (), [&] (const RatedViewpoint& other) {
            return other.viewpoint.is_far == one.viewpoint.is_far &&
                   (other.viewpoint.place - one.viewpoint.place).norm () < distance;
          }))
        kept.push_back (one);
    return kept;
  }

  // Cell size of the grid of viewpoints.
  double cell () const
  {
    return 2.0 * box_.sizes ().maxCoeff () / static_cast<double> (limits_.cells);
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

  // Half of the samples, along each axis.
  Eigen::AlignedBox3d middleBox () const
  {
    Eigen::AlignedBox3d box;
    box.setEmpty ();
    std::vector<double> values (samples_.size ());
    for (const double share : {0.25, 0.75}) {
      Eigen::Vector3d corner;
      for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < samples_.size (); ++i)
          values[i] = samples_[i].position[axis];
        corner[axis] = quantile (values, share);
      }
      box.extend (corner);
    }
    return box;
  }

  // The middles of the cells of a grid over twice a box.
  static void addGrid (const Eigen::AlignedBox3d& box, std::size_t n,
                       std::vector<RatedViewpoint>& places)
  {
    const auto cells = static_cast<double> (n);
    for (std::size_t i = 0; i < n * n * n; ++i) {
      const std::size_t column = i / n % n, layer = i / (n * n);
      const Eigen::Array3d cell (static_cast<double> (i % n), static_cast<double> (column),
                                 static_cast<double> (layer));
      const Eigen::Vector3d offset = (2.0 * (cell + 0.5) / cells - 1.0).matrix ();
      places.push_back ({0.0, {box.center () + offset.cwiseProduct (box.sizes ()), false}});
    }
  }

  // Viewpoints on grids, and far ones, rated by a few areas.
  std::vector<RatedViewpoint> startingPlaces () const
  {
    std::vector<RatedViewpoint> candidates;
    const auto add = [&candidates] (const Viewpoint& viewpoint) {
      candidates.push_back ({0.0, viewpoint});
    };
    const Eigen::Vector3d size = box_.sizes (), centre = box_.center ();
    addGrid (box_, limits_.cells, candidates);
    addGrid (middleBox (), limits_.cells, candidates);
    // On spheres around the box, the last of infinite radius.
    for (std::size_t i = 0; i < limits_.directions; ++i) {
      const Eigen::Vector3d direction = spiralDirection (i, limits_.directions);
      for (const double distance : {1.5, 3.0, 6.0})
        add ({centre + distance * size.norm () * direction, false});
      if (may_be_far_)
        add ({direction, true});
    }
    parallelRanges (run_, candidates.size (), [&] (std::size_t first, std::size_t last) {
      std::vector<double> angles;
      for (std::size_t i = first; i < last; ++i)
        candidates[i].cost = areaSpread (few_samples_, candidates[i].viewpoint, angles);
    });
    return candidates;
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
    takeBetter (refineBy (start, step, true), best);
    if (!best || !best->is_even)
      takeBetter (refineBy (start, step, false), best);
    for (double cost = std::numeric_limits<double>::infinity (); best && best->cost < cost;) {
      cost = CLEARLY * best->cost;
      takeBetter (refineBy (best->viewpoint, CLOSER * step, true), best);
    }
    return best;
  }

  RayEvidence evidenceAt (const Viewpoint& viewpoint) const
  {
    return findRayEvidence (positions_, findRayPatches (positions_, viewpoint, evidence_, run_),
                            viewpoint, evidence_, run_);
  }

  // Patches from a better viewpoint give a still better one; far from it, a few suffice.
  std::optional<Found> refineBy (Viewpoint viewpoint, double step, bool with_rows) const
  {
    constexpr std::size_t EARLY = 3; // rounds
    std::vector<RayPatch> patches;
    const auto findPatches = [&] (const EvidenceLimits& limits) {
      return findRayPatches (positions_, viewpoint, limits, run_);
    };
    for (std::size_t round = 0; round < limits_.rounds; ++round) {
      const EvidenceLimits& limits = round < EARLY ? coarse_ : evidence_;
      patches = findPatches (limits);
      if (round == EARLY && isHopeless (patches, viewpoint, limits, limits_.early_from_far))
        return {};
      const auto cost = [&] (const Viewpoint& v) {
        return findRaySpread (positions_, patches, v, with_rows, run_);
      };
      viewpoint =
          patternSearch (viewpoint, step, 0.2 * step, box_.center (), limits_.ray_evaluations, cost)
              .viewpoint;
      step *= 0.4;
      if (isHopeless (patches, viewpoint, limits,
                      round >= EARLY     ? limits_.late
                      : viewpoint.is_far ? limits_.early_from_far
                                         : limits_.early))
        return {};
    }
    patches = findPatches (evidence_);
    const RayEvidence rays = findRayEvidence (positions_, patches, viewpoint, evidence_, run_);
    const bool is_sure = isSeenFromThere (rays, evidence_);
    // Along a far direction, nothing is beside.
    const bool explains = !is_sure && !viewpoint.is_far &&
                          explainsDensity (positions_, patches, viewpoint, evidence_, run_);
    const bool is_even = is_sure || (!viewpoint.is_far && isSeenFromThere (rays, lenient_));
    if (!is_even && !explains)
      return {};
    return Found{findRaySpread (positions_, patches, viewpoint, true, run_), viewpoint, is_even,
                 explains, may_be_far_ && (is_sure || explains)};
  }

  const std::vector<Eigen::Vector3d>& positions_;
  const RowOf& row_of_;
  const SearchLimits& limits_;
  EvidenceLimits evidence_;
  EvidenceLimits coarse_;  // fewer patches, during the search
  EvidenceLimits lenient_; // with evidence of its own, see isDetermined ()
  RunContext run_;
  const std::vector<AreaSample>& samples_;
  std::vector<AreaSample> few_samples_; // to compare many viewpoints
  Eigen::AlignedBox3d box_;
  bool may_be_far_;
};

} // namespace

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
  if (for_uneven) {
    const RowEvidence rows = findRows (points, row_of, limits.samples);
    if (rows.share > limits.rows && !rows.are_straight)
      if (const std::optional<Viewpoint> found = search.findAlongRows (rows.across))
        return found;
  }
  constexpr std::size_t LEAST_SHARE = 4; // a quarter of the patches
  if (LEAST_SHARE * filled.patches < evidence.patches || samples.size () < limits.samples / 2 ||
      (spreadOfAreas (samples) > limits.even) != for_uneven)
    return {};
  return search.find ();
}

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Patches around some points, and the places from which their solid angles are most alike: roughly
// those that a cloud may be seen from.
#pragma once

#include "core/csr_lists.h"
#include "core/run_context.h"
#include "view/ray_evidence.h"

namespace pcl::floater {
/// Patches around points that are spread evenly over their order, over their neighbours: also across
/// rows that are far apart. Parallel rays to a patch are near each other for any direction.
/// \param row_of neighbours of a point, nearest first
/// \return PATCH_POINTS of each, fewer if there are no more around, sorted by distance to the first one
std::vector<RayPatch>
findPointPatches (const Positions& positions, const RowOf& row_of, std::size_t count);

/// A point and the area around it.
struct AreaSample
{
  Vector3d position, normal;
  double area; ///< of the patch around it, in any unit
};

/// Sampled areas; the error of the spread of so many is 6 %.
constexpr std::size_t AREA_SAMPLES = 500;

/// Area samples of patches of points: noise and rows spoil the stars of single points. O(1).
/// \param row_of see findPointPatches
std::vector<AreaSample>
takePatchSamples (const Positions& positions, const RowOf& row_of);

/// A viewpoint and its cost.
struct RatedViewpoint
{
  double cost;
  Viewpoint viewpoint;

  bool operator<(const RatedViewpoint& other) const { return cost < other.cost; }
};

/// The first candidates without those near an earlier one.
inline std::vector<RatedViewpoint>
keepApart (const std::vector<RatedViewpoint>& candidates, double distance, std::size_t most)
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

/// Pattern search (Hooke and Jeeves 1961): moves a viewpoint along the axes, or rotates the direction
/// of a far one; repeats moves that lowered the cost, and otherwise halves the step, until it is below
/// the smallest one, or all evaluations of the cost are used. Steps are relative to the distance from
/// the middle of the cloud, if that is above 1.
template <typename Cost>
RatedViewpoint
patternSearch (const Viewpoint& start, double step, double smallest_step, const Vector3d& middle,
               std::size_t evaluations, const Cost& cost)
{
  const auto moved = [&] (const RatedViewpoint& from, const Vector3d& by) -> RatedViewpoint {
    Viewpoint viewpoint = from.viewpoint;
    viewpoint.place += by;
    if (viewpoint.is_far)
      viewpoint.place.normalize ();
    --evaluations;
    return {cost (viewpoint), viewpoint};
  };
  // Changing axes: in a narrow valley of the cost, no fixed axis may lead down.
  Eigen::Quaterniond axes = Eigen::Quaterniond::Identity ();
  const Eigen::Quaterniond turn (0.8, 0.2, 0.33, 0.46); // an arbitrary rotation, by 74 degrees
  const auto explore = [&] (RatedViewpoint& at) {
    const double unit =
        at.viewpoint.is_far ? 1.0 : std::max (1.0, (at.viewpoint.place - middle).norm ());
    axes = (axes * turn).normalized ();
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {-1.0, 1.0}) {
        if (evaluations == 0)
          return;
        const RatedViewpoint tried =
            moved (at, sign * step * unit * (axes * Vector3d::Unit (axis)));
        if (tried.cost < at.cost) {
          at = tried;
          break;
        }
      }
  };
  RatedViewpoint best{cost (start), start};
  for (; step >= smallest_step && evaluations > 0; step *= 0.5)
    for (bool has_moved = true; has_moved && evaluations > 0;) {
      const RatedViewpoint before = best;
      explore (best);
      has_moved = best.cost < before.cost;
      for (bool goes_on = has_moved; goes_on && evaluations > 0;) {
        RatedViewpoint further = moved (best, best.viewpoint.place - before.viewpoint.place);
        explore (further);
        goes_on = further.cost < best.cost;
        if (goes_on)
          best = further;
      }
    }
  return best;
}

/// Spread of the areas without any viewpoint.
double
spreadOfAreas (const std::vector<AreaSample>& samples);

/// \return places to a hundredth of the box, best ones first; none if areas come from no view
/// \param may_be_far directions of parallel rays are tried, too
std::vector<RatedViewpoint>
searchByAreas (const std::vector<AreaSample>& samples, const Eigen::AlignedBox3d& box,
               bool may_be_far, const RunContext& run);

} // namespace pcl::floater

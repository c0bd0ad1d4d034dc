// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/viewpoint_fit.h"

#include "core/order_statistics.h"
#include "core/parallel.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl
{
namespace floater
{
namespace
{
// Two rays, by the points they lead to.
struct RayPair
{
  Index first, second;
};

// Pairs whose distances shall be alike.
using PairGroup = std::vector<RayPair>;

double
logDistance (const std::vector<Eigen::Vector3d>& positions, RayPair pair,
             const Viewpoint& viewpoint)
{
  const Eigen::Vector3d offset = rayTo (positions[pair.first], viewpoint).direction -
                                 rayTo (positions[pair.second], viewpoint).direction;
  constexpr double SMALLEST = 1e-24; // rays that hide each other have no logarithm
  return 0.5 * std::log (std::max (offset.squaredNorm (), SMALLEST));
}

// Two groups for each patch: the nearest rays, and the nearest across.
std::vector<PairGroup>
findPairs (const std::vector<Eigen::Vector3d>& positions, const std::vector<RayPatch>& patches,
           const Viewpoint& viewpoint, const RunContext& run)
{
  std::vector<PairGroup> groups (2 * patches.size ());
  parallelTasks (run, patches.size (), [&] (std::size_t k) {
    const RayPatch& patch = patches[k];
    PatchRays rays (positions, patch, viewpoint);
    for (std::size_t i = 0; i < patch.size () / 2; ++i) {
      const PatchRays::Neighbors found = rays.neighborsOf (i);
      if (found.nearest != i)
        groups[2 * k].push_back ({patch[i], patch[found.nearest]});
      if (found.across != i)
        groups[2 * k + 1].push_back ({patch[i], patch[found.across]});
    }
  });
  return groups;
}

class ViewpointFit
{
public:
  ViewpointFit (const std::vector<Eigen::Vector3d>& positions, const std::vector<PairGroup>& groups)
      : positions_ (positions), groups_ (groups)
  {
  }

  // The residuals of all pairs: logarithms of distances about the median of their group.
  std::vector<double> residuals (const Viewpoint& viewpoint) const
  {
    std::vector<double> all, sorted;
    for (const PairGroup& group : groups_) {
      if (group.empty ())
        continue;
      const std::size_t begin = all.size ();
      for (const RayPair pair : group)
        all.push_back (logDistance (positions_, pair, viewpoint));
      sorted.assign (all.begin () + static_cast<std::ptrdiff_t> (begin), all.end ());
      const double middle = median (sorted);
      for (std::size_t i = begin; i < all.size (); ++i)
        all[i] -= middle;
    }
    return all;
  }

  // Cauchy's, for the scale at which half of the residuals are larger.
  static double scaleOf (const std::vector<double>& residuals)
  {
    constexpr double SMALLEST = 1e-9; // rounding of positions
    std::vector<double> sizes;
    sizes.reserve (residuals.size ());
    for (const double r : residuals)
      sizes.push_back (std::abs (r));
    return sizes.empty () ? SMALLEST : std::max (SMALLEST, median (sizes));
  }

  static double lossOf (const std::vector<double>& residuals, double scale)
  {
    double sum = 0.0;
    for (const double r : residuals)
      sum += std::log1p (r * r / (scale * scale));
    return sum;
  }

private:
  const std::vector<Eigen::Vector3d>& positions_;
  const std::vector<PairGroup>& groups_;
};

// A far viewpoint turns about two axes; any other moves along three.
Viewpoint
moved (const Viewpoint& from, const Eigen::Vector3d& by)
{
  Viewpoint to = from;
  if (from.is_far) {
    const Eigen::Vector3d x = from.place.unitOrthogonal (), y = from.place.cross (x);
    to.place = (from.place + by.x () * x + by.y () * y).normalized ();
  }
  else
    to.place += by;
  return to;
}

} // namespace

Viewpoint
fitViewpoint (const std::vector<Eigen::Vector3d>& positions, const std::vector<RayPatch>& patches,
              const Viewpoint& start, bool is_coarse, const RunContext& run)
{
  constexpr std::size_t MOST_STEPS = 20;
  constexpr double DIFFERENCE = 1e-7;    // for derivatives; positions are in a box of diagonal 1
  constexpr double SMALLEST_STEP = 1e-7; // a tenth of what the search asks for
  constexpr double MOST_DAMPING = 1e6;
  const Eigen::Index unknowns = start.is_far ? 2 : 3;
  Viewpoint viewpoint = start;
  double damping = 1e-3;
  double least_scale = is_coarse ? 0.5 : 0.1; // all pairs take part at first, then those alike
  for (std::size_t step = 0; step < MOST_STEPS && damping < MOST_DAMPING; ++step) {
    const std::vector<PairGroup> groups = findPairs (positions, patches, viewpoint, run);
    const ViewpointFit fit (positions, groups);
    const std::vector<double> residuals = fit.residuals (viewpoint);
    const double scale = std::max (ViewpointFit::scaleOf (residuals), least_scale);
    least_scale *= 0.5;
    std::vector<std::vector<double>> shifted;
    for (Eigen::Index i = 0; i < unknowns; ++i)
      shifted.push_back (fit.residuals (moved (viewpoint, DIFFERENCE * Eigen::Vector3d::Unit (i))));
    Eigen::Matrix3d normal = Eigen::Matrix3d::Identity ();
    normal.topLeftCorner (unknowns, unknowns).setZero ();
    Eigen::Vector3d right = Eigen::Vector3d::Zero ();
    for (std::size_t r = 0; r < residuals.size (); ++r) {
      Eigen::Vector3d gradient = Eigen::Vector3d::Zero ();
      for (Eigen::Index i = 0; i < unknowns; ++i)
        gradient[i] = (shifted[static_cast<std::size_t> (i)][r] - residuals[r]) / DIFFERENCE;
      const double ratio = residuals[r] / scale, weight = 1.0 / (1.0 + ratio * ratio);
      normal += weight * gradient * gradient.transpose ();
      right -= weight * residuals[r] * gradient;
    }
    const double loss = ViewpointFit::lossOf (residuals, scale);
    bool is_better = false;
    while (!is_better && damping < MOST_DAMPING) {
      Eigen::Matrix3d damped = normal;
      damped.diagonal () *= 1.0 + damping;
      const Eigen::Vector3d by = damped.ldlt ().solve (right);
      const Viewpoint tried = moved (viewpoint, by);
      is_better = by.allFinite () && ViewpointFit::lossOf (fit.residuals (tried), scale) < loss;
      damping *= is_better ? 0.1 : 10.0;
      if (!is_better)
        continue;
      viewpoint = tried;
      if (by.norm () < SMALLEST_STEP)
        return viewpoint;
    }
  }
  return viewpoint;
}

} // namespace floater
} // namespace pcl

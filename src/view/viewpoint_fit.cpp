// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/viewpoint_fit.h"

#include "core/order_statistics.h"
#include "core/parallel.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl::floater {
namespace {
// Two rays, as indices of points.
struct RayPair
{
  Index first, second;
};

// Pairs whose distances should be equal.
using PairGroup = std::vector<RayPair>;

double
logDistance (const std::vector<Eigen::Vector3d>& positions, RayPair pair,
             const Viewpoint& viewpoint)
{
  const Eigen::Vector3d offset = rayTo (positions[pair.first], viewpoint).direction -
                                 rayTo (positions[pair.second], viewpoint).direction;
  constexpr double SMALLEST = 1e-24; // the logarithm of coinciding rays is undefined
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
  ViewpointFit (const std::vector<Eigen::Vector3d>& positions, const std::vector<PairGroup>& groups,
                const RunContext& run)
      : positions_ (positions), groups_ (groups), run_ (run), begin_ (groups.size () + 1, 0)
  {
    for (std::size_t g = 0; g < groups.size (); ++g)
      begin_[g + 1] = begin_[g] + groups[g].size ();
  }

  // Residuals of all pairs from each viewpoint: logarithms of distances minus the median of their
  // group.
  std::vector<std::vector<double>> residuals (const std::vector<Viewpoint>& viewpoints) const
  {
    constexpr std::size_t GROUPS = 32; // of a task: a tenth of a millisecond
    const std::size_t tasks = (groups_.size () + GROUPS - 1) / GROUPS;
    std::vector<std::vector<double>> all (viewpoints.size (), std::vector<double> (begin_.back ()));
    parallelTasks (run_, viewpoints.size () * tasks, [&] (std::size_t k) {
      const std::size_t first = k % tasks * GROUPS;
      const std::size_t last = std::min (groups_.size (), first + GROUPS);
      std::vector<double> sorted;
      for (std::size_t g = first; g < last; ++g)
        setResiduals (g, viewpoints[k / tasks], all[k / tasks].data () + begin_[g], sorted);
    });
    return all;
  }

  std::vector<double> residuals (const Viewpoint& viewpoint) const
  {
    return std::move (residuals (std::vector<Viewpoint>{viewpoint}).front ());
  }

  // Scale of the Cauchy distribution: median of the residuals.
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
  void setResiduals (std::size_t group, const Viewpoint& viewpoint, double* residuals,
                     std::vector<double>& sorted) const
  {
    const std::size_t count = groups_[group].size ();
    if (count == 0)
      return;
    for (std::size_t i = 0; i < count; ++i)
      residuals[i] = logDistance (positions_, groups_[group][i], viewpoint);
    sorted.assign (residuals, residuals + count);
    const double middle = median (sorted);
    for (std::size_t i = 0; i < count; ++i)
      residuals[i] -= middle;
  }

  const std::vector<Eigen::Vector3d>& positions_;
  const std::vector<PairGroup>& groups_;
  RunContext run_;
  std::vector<std::size_t> begin_; // of each group: index of its first residual
};

// A far viewpoint rotates about two axes; any other moves along three.
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
  constexpr double SMALLEST_STEP = 1e-7; // a tenth of the precision of the search
  constexpr double MOST_DAMPING = 1e6;
  const Eigen::Index unknowns = start.is_far ? 2 : 3;
  Viewpoint viewpoint = start;
  double damping = 1e-3;
  double least_scale = is_coarse ? 0.5 : 0.1; // first all pairs take part, later those alike
  for (std::size_t step = 0; step < MOST_STEPS && damping < MOST_DAMPING; ++step) {
    const std::vector<PairGroup> groups = findPairs (positions, patches, viewpoint, run);
    const ViewpointFit fit (positions, groups, run);
    // The viewpoint, and its offsets along each unknown.
    std::vector<Viewpoint> places{viewpoint};
    for (Eigen::Index i = 0; i < unknowns; ++i)
      places.push_back (moved (viewpoint, DIFFERENCE * Eigen::Vector3d::Unit (i)));
    const std::vector<std::vector<double>> shifted = fit.residuals (places);
    const std::vector<double>& residuals = shifted.front ();
    const double scale = std::max (ViewpointFit::scaleOf (residuals), least_scale);
    least_scale *= 0.5;
    Eigen::Matrix3d normal = Eigen::Matrix3d::Identity ();
    normal.topLeftCorner (unknowns, unknowns).setZero ();
    Eigen::Vector3d right = Eigen::Vector3d::Zero ();
    for (std::size_t r = 0; r < residuals.size (); ++r) {
      Eigen::Vector3d gradient = Eigen::Vector3d::Zero ();
      for (Eigen::Index i = 0; i < unknowns; ++i)
        gradient[i] = (shifted[static_cast<std::size_t> (i) + 1][r] - residuals[r]) / DIFFERENCE;
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

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/outliers.h"

#include "core/disjoint_sets.h"
#include "core/order_statistics.h"
#include "core/parallel.h"
#include "core/plane_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl::floater {
namespace {
constexpr std::size_t NEAREST_POINTS = 20; // nearest neighbours, also for balls
constexpr std::size_t REACH_OF = 6;        // neighbour whose distance is a point's reach

using Arc = std::pair<Index, Index>; // a point and one that it counts as close

double
distance (const std::vector<Eigen::Vector3d>& positions, Index p, Index q)
{
  return (positions[p] - positions[q]).norm ();
}

// Tests whether a point lies apart; scratch is reused from point to point.
class ApartTest
{
public:
  ApartTest (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
             const std::vector<float>& reach, const OutlierLimits& limits)
      : positions_ (positions), neighbors_ (neighbors), reach_ (reach), limits_ (limits)
  {
  }

  bool isApart (Index p)
  {
    const Row row = neighbors_.first (p, NEAREST_POINTS);
    if (row.size () < 4)
      return false;
    // The nearest ones may be of the same small cluster: the threshold uses the reach of the
    // others.
    const std::size_t beyond = std::min (limits_.cluster, row.size () / 2);
    const double to_others = distance (positions_, p, row[beyond]);
    scratch_.clear ();
    for (std::size_t i = beyond; i < row.size (); ++i)
      scratch_.push_back (reach_[row[i]]);
    if (to_others <= limits_.off_plane * *std::min_element (scratch_.begin (), scratch_.end ()))
      return false; // true for nearly all points, without a median
    const double usual = median (scratch_);
    if (to_others > limits_.far * usual)
      return true;
    return to_others > limits_.off_plane * usual && isOffPlane (p, row, limits_.off_plane * usual);
  }

private:
  // Fits the plane of the neighbours without the point, then again without strays.
  bool isOffPlane (Index p, Row row, double least_height)
  {
    double spread = std::numeric_limits<double>::infinity ();
    Plane plane;
    for (int pass = 0; pass < 2; ++pass) {
      PlaneFit fit;
      for (Index q : row) {
        const Eigen::Vector3d offset = positions_[q] - positions_[p];
        if (pass == 0 || std::abs (plane.height (offset)) <= limits_.stray * spread)
          fit.add (offset);
      }
      plane = fit.plane ();
      scratch_.clear ();
      for (Index q : row)
        scratch_.push_back (std::abs (plane.height (positions_[q] - positions_[p])));
      spread = median (scratch_);
    }
    const double height = std::abs (plane.height (Eigen::Vector3d::Zero ()));
    return height > least_height && spread < limits_.flat * height;
  }

  const std::vector<Eigen::Vector3d>& positions_;
  const CsrLists& neighbors_;
  const std::vector<float>& reach_;
  const OutlierLimits& limits_;
  std::vector<double> scratch_;
};

// Arcs to points that lie apart, from points that enough others count as close. An outlier may well
// be nearest to another outlier, but few points are nearest to the latter.
std::vector<Arc>
arcsToApart (const CsrLists& neighbors, const std::vector<std::uint8_t>& apart,
             const OutlierLimits& limits)
{
  std::vector<std::uint32_t> owners (apart.size (), 0);
  for (std::size_t q = 0; q < apart.size (); ++q)
    for (Index p : neighbors.first (q, limits.own))
      ++owners[p];
  std::vector<Arc> arcs;
  for (std::size_t q = 0; q < apart.size (); ++q)
    if (owners[q] >= limits.owners)
      for (Index p : neighbors.first (q, limits.own))
        if (apart[p] != 0)
          arcs.emplace_back (static_cast<Index> (q), p);
  return arcs; // ascending by q
}

// Clears the flag of points that can be reached from the surface along arcs.
void
keepReached (const std::vector<Arc>& arcs, std::vector<std::uint8_t>& apart)
{
  std::vector<Index> reached;
  const auto reach = [&] (Index p) {
    if (apart[p] != 0)
      reached.push_back (p);
    apart[p] = 0;
  };
  const std::vector<std::uint8_t> before = apart;
  for (const Arc& arc : arcs)
    if (before[arc.first] == 0)
      reach (arc.second);
  while (!reached.empty ()) {
    const Index q = reached.back ();
    reached.pop_back ();
    for (auto arc = std::lower_bound (arcs.begin (), arcs.end (), Arc (q, 0));
         arc != arcs.end () && arc->first == q; ++arc)
      reach (arc->second);
  }
}

// Clears the flag of points in clusters larger than `largest_cluster`.
void
keepLargeClusters (const std::vector<Arc>& arcs, std::size_t largest_cluster,
                   std::vector<std::uint8_t>& apart)
{
  std::vector<Index> points;
  for (std::size_t p = 0; p < apart.size (); ++p)
    if (apart[p] != 0)
      points.push_back (static_cast<Index> (p));
  const auto slot = [&points] (Index p) {
    return static_cast<Index> (std::lower_bound (points.begin (), points.end (), p) -
                               points.begin ());
  };
  DisjointSets clusters (points.size ());
  for (const Arc& arc : arcs)
    if (apart[arc.first] != 0 && apart[arc.second] != 0)
      clusters.join (slot (arc.first), slot (arc.second));
  std::vector<std::size_t> size (points.size (), 0);
  for (Index i = 0; i < points.size (); ++i)
    ++size[clusters.find (i)];
  for (Index i = 0; i < points.size (); ++i)
    if (size[clusters.find (i)] > largest_cluster)
      apart[points[i]] = 0;
}

} // namespace

void
findReaches (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
             const Rows& rows, std::vector<float>& reach, const RunContext& run)
{
  parallelRanges (run, rows.size (), [&] (std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Row row = neighbors.row (rows[i]);
      if (row.size () > 0)
        reach[rows[i]] = static_cast<float> (
            distance (positions, rows[i], row[std::min (REACH_OF, row.size ()) - 1]));
    }
  });
}

std::vector<std::uint8_t>
findApart (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
           const std::vector<float>& reach, const Rows& rows, const OutlierLimits& limits,
           const RunContext& run)
{
  std::vector<std::uint8_t> apart (rows.size (), 0);
  parallelRanges (run, rows.size (), [&] (std::size_t first, std::size_t last) {
    ApartTest test (positions, neighbors, reach, limits);
    for (std::size_t i = first; i < last; ++i)
      apart[i] = test.isApart (rows[i]) ? 1 : 0;
  });
  return apart;
}

std::vector<Index>
chooseOutliers (const CsrLists& neighbors, std::vector<std::uint8_t> apart,
                const OutlierLimits& limits)
{
  std::vector<Index> outliers;
  if (std::find (apart.begin (), apart.end (), 1) == apart.end ())
    return outliers;
  const std::vector<Arc> arcs = arcsToApart (neighbors, apart, limits);
  keepReached (arcs, apart);
  keepLargeClusters (arcs, limits.cluster, apart);
  for (std::size_t p = 0; p < apart.size (); ++p)
    if (apart[p] != 0)
      outliers.push_back (static_cast<Index> (p));
  return outliers;
}

std::vector<Index>
findOutliers (const std::vector<Eigen::Vector3d>& positions, const CsrLists& neighbors,
              const RunContext& run, const OutlierLimits& limits)
{
  const std::size_t n = positions.size ();
  if (!mayHaveOutliers (n, limits))
    return {};
  const Rows all = Rows::all (n);
  std::vector<float> reach (n, 0.0F);
  findReaches (positions, neighbors, all, reach, run);
  return chooseOutliers (neighbors, findApart (positions, neighbors, reach, all, limits, run),
                         limits);
}

} // namespace pcl::floater

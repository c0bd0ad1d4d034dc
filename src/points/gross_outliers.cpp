// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/gross_outliers.h"

#include "core/order_statistics.h"
#include "core/parallel.h"
#include "points/kd_tree.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl::floater {
namespace {
using Positions = std::vector<Eigen::Vector3d>;

constexpr double MOST_BINS = 1e5;

// The median in each coordinate, of the finite points.
Eigen::Vector3d
medianPoint (const Positions& positions)
{
  Eigen::Vector3d middle = Eigen::Vector3d::Zero ();
  std::vector<double> values;
  values.reserve (positions.size ());
  for (int axis = 0; axis < 3; ++axis) {
    values.clear ();
    for (const Eigen::Vector3d& p : positions)
      if (p.allFinite ())
        values.push_back (p[axis]);
    if (!values.empty ())
      middle[axis] = median (values);
  }
  return middle;
}

// Not squared: squares would overflow. An infinite difference is larger than all others.
double
distanceFrom (const Eigen::Vector3d& centre, const Eigen::Vector3d& p)
{
  return (p - centre).cwiseAbs ().maxCoeff ();
}

// Distances around a median point.
struct Bulk
{
  Eigen::Vector3d centre = Eigen::Vector3d::Zero ();
  double radius = std::numeric_limits<double>::infinity (); // infinite: there is no wide gap
  std::size_t points = 0;                                   // of the cloud, finite ones
};

// Grows the radius over the points beyond it until there is a wide gap to the next. Starts with the
// median of all points that are not at the centre itself: more than half may be copies of one, such
// as (0, 0, 0) for pixels without depth.
Bulk
findBulk (const Positions& positions, double gap)
{
  Bulk bulk;
  bulk.centre = medianPoint (positions);
  std::vector<double> distances;
  distances.reserve (positions.size ());
  for (const Eigen::Vector3d& p : positions) {
    if (!p.allFinite ())
      continue;
    ++bulk.points;
    if (const double distance = distanceFrom (bulk.centre, p); distance > 0.0)
      distances.push_back (distance);
  }
  if (distances.empty ())
    return bulk;
  const double usual = median (distances);
  const auto beyond = std::partition (distances.begin (), distances.end (),
                                      [&] (double distance) { return distance <= gap * usual; });
  if (beyond == distances.end ())
    return bulk;
  double radius = *std::max_element (distances.begin (), beyond);
  std::sort (beyond, distances.end ());
  for (auto next = beyond; next != distances.end (); radius = *next++)
    if (*next > gap * radius) {
      bulk.radius = radius;
      break;
    }
  return bulk;
}

bool
isLess (const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return std::lexicographical_compare (a.data (), a.data () + 3, b.data (), b.data () + 3);
}

// Keeps rows beyond the gap with too few distinct points near them for an object.
std::vector<Index>
keepIsolated (const Positions& positions, const Bulk& bulk, std::vector<Index> rows,
              const RunContext& run, const GrossOutlierLimits& limits)
{
  const auto isBefore = [&] (Index a, Index b) { return isLess (positions[a], positions[b]); };
  std::sort (rows.begin (), rows.end (), isBefore);
  Positions distinct;
  std::vector<std::size_t> last; // one past the last row of each distinct position
  for (std::size_t i = 0; i < rows.size (); ++i) {
    if (i == 0 || isBefore (rows[i - 1], rows[i])) {
      distinct.emplace_back ((positions[rows[i]] - bulk.centre) / bulk.radius);
      last.push_back (i);
    }
    last.back () = i + 1;
  }
  std::vector<std::uint8_t> is_isolated (distinct.size (), 0);
  const KdTree tree (distinct, run);
  parallelRanges (run, distinct.size (), [&] (std::size_t begin, std::size_t end) {
    std::vector<Neighbor> found;
    for (std::size_t i = begin; i < end; ++i) {
      tree.nearest (distinct[i], limits.object, found); // includes the point itself
      is_isolated[i] = found.size () < limits.object || std::sqrt (found.back ().sqr_distance) >
                                                            limits.near * distinct[i].norm ()
                           ? 1
                           : 0;
    }
  });
  std::vector<Index> isolated;
  for (std::size_t i = 0, row = 0; i < distinct.size (); ++i)
    for (; row < last[i]; ++row)
      if (is_isolated[i] != 0)
        isolated.push_back (rows[row]);
  std::sort (isolated.begin (), isolated.end ());
  return isolated;
}

// Fast test that no point is beyond the bulk: along the longest axis, less than half of the points
// lie in any interval as wide as the distances of a half could be otherwise.
bool
isAllBulk (const Positions& positions, double gap)
{
  Eigen::AlignedBox3d box;
  std::size_t finite = 0;
  for (const Eigen::Vector3d& p : positions)
    if (p.allFinite ()) {
      box.extend (p);
      ++finite;
    }
  int axis = 0;
  const double width = finite > 0 ? box.sizes ().maxCoeff (&axis) : 0.0;
  const double bins = 0.4 * gap; // any such interval is in two of them, even if rounded
  if (!(width > 0.0) || !std::isfinite (width) || !(bins >= 2.0) || bins > MOST_BINS)
    return false;
  std::vector<std::size_t> count (static_cast<std::size_t> (bins) + 2, 0);
  const double low = box.min ()[axis], scale = std::floor (bins) / width;
  if (!std::isfinite (scale))
    return false;
  for (const Eigen::Vector3d& p : positions)
    if (p.allFinite ())
      ++count[static_cast<std::size_t> ((p[axis] - low) * scale)];
  for (std::size_t bin = 1; bin < count.size (); ++bin)
    if (2 * (count[bin - 1] + count[bin]) >= finite)
      return false;
  return true;
}

} // namespace

GrossOutliers
findGrossOutliers (const Positions& positions, const RunContext& run,
                   const GrossOutlierLimits& limits)
{
  GrossOutliers found;
  if (positions.size () < limits.fewest)
    return found;
  if (isAllBulk (positions, limits.gap))
    return found;
  const Bulk bulk = findBulk (positions, limits.gap);
  if (!std::isfinite (bulk.radius) || bulk.points < limits.fewest)
    return found;
  // The bulk is a surface of at most this many points: their spacing is about the radius over their
  // root. A frame has 1 / epsilon steps across it.
  const double spacing = bulk.radius / std::sqrt (static_cast<double> (bulk.points));
  const double largest_frame = spacing / (limits.steps * std::numeric_limits<double>::epsilon ());
  std::vector<Index> beyond;
  for (std::size_t row = 0; row < positions.size (); ++row) {
    if (!positions[row].allFinite ())
      continue;
    const double distance = distanceFrom (bulk.centre, positions[row]);
    if (distance > largest_frame)
      found.unbearable.push_back (static_cast<Index> (row));
    else if (distance > bulk.radius)
      beyond.push_back (static_cast<Index> (row));
  }
  found.isolated = keepIsolated (positions, bulk, std::move (beyond), run, limits);
  return found;
}

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "points/outliers.h"

#include "core/disjoint_sets.h"
#include "core/geometry.h"
#include "core/order_statistics.h"
#include "core/parallel.h"
#include "points/kd_tree.h"

namespace pcl::floater {
namespace {

// The median in each coordinate, of the finite points.
Vector3d
medianPoint (const Positions& positions)
{
  Vector3d middle = Vector3d::Zero ();
  std::vector<double> values;
  values.reserve (positions.size ());
  for (int axis = 0; axis < 3; ++axis) {
    values.clear ();
    for (const Vector3d& p : positions)
      if (p.allFinite ())
        values.push_back (p[axis]);
    if (!values.empty ())
      middle[axis] = median (values);
  }
  return middle;
}

// At least half of the points, up to the first wide gap. Distances around a median point: the
// largest coordinate difference, as squares would overflow. An infinite one is larger than all
// others.
struct Bulk
{
  Vector3d centre = Vector3d::Zero ();
  double radius = std::numeric_limits<double>::infinity (); // infinite: there is no wide gap
  std::size_t points = 0;                                   // of the cloud, finite ones

  double distanceTo (const Vector3d& p) const { return (p - centre).lpNorm<Eigen::Infinity> (); }
};

// Grows the radius over the points beyond it until there is a wide gap to the next. Starts with the
// median of all points that are not at the centre itself: more than half may be copies of one, such
// as (0, 0, 0) for pixels without depth.
Bulk
findBulk (const Positions& positions)
{
  constexpr double GAP = 1000.0; // ratio of consecutive distances; real surfaces stay far below
  Bulk bulk;
  bulk.centre = medianPoint (positions);
  std::vector<double> distances;
  distances.reserve (positions.size ());
  for (const Vector3d& p : positions) {
    if (!p.allFinite ())
      continue;
    ++bulk.points;
    if (const double distance = bulk.distanceTo (p); distance > 0.0)
      distances.push_back (distance);
  }
  if (distances.empty ())
    return bulk;
  const double usual = median (distances);
  const auto beyond = std::partition (distances.begin (), distances.end (),
                                      [&] (double distance) { return distance <= GAP * usual; });
  if (beyond == distances.end ())
    return bulk;
  double radius = *std::max_element (distances.begin (), beyond);
  std::sort (beyond, distances.end ());
  for (auto next = beyond; next != distances.end (); radius = *next++)
    if (*next > GAP * radius) {
      bulk.radius = radius;
      break;
    }
  return bulk;
}

// Keeps rows beyond the gap with too few distinct points near them for an object.
std::vector<Index>
keepIsolated (const Positions& positions, const Bulk& bulk, std::vector<Index> rows,
              const RunContext& run)
{
  constexpr std::size_t OBJECT = 8; // smallest number of distinct points of an object
  constexpr double NEAR = 1.0 / 32; // of the distance: such points may be one object
  const auto isBefore = [&] (Index a, Index b) {
    const Vector3d &p = positions[a], &q = positions[b];
    return std::lexicographical_compare (p.begin (), p.end (), q.begin (), q.end ());
  };
  std::sort (rows.begin (), rows.end (), isBefore);
  Positions distinct;
  std::vector<std::size_t> number (rows.size ()); // of the position of each row
  for (std::size_t i = 0; i < rows.size (); ++i) {
    if (i == 0 || isBefore (rows[i - 1], rows[i]))
      distinct.emplace_back ((positions[rows[i]] - bulk.centre) / bulk.radius);
    number[i] = distinct.size () - 1;
  }
  Flags is_isolated (distinct.size (), 0);
  const KdTree tree (distinct, run);
  parallelPoints<std::vector<Neighbor>> (run, distinct.size (), [&] (Index i, auto& found) {
    tree.nearest (distinct[i], OBJECT, found); // includes the point itself
    const double near = NEAR * distinct[i].norm ();
    const bool is_alone = found.size () < OBJECT || std::sqrt (found.back ().sqr_distance) > near;
    is_isolated[i] = is_alone ? 1 : 0;
  });
  std::vector<Index> isolated;
  for (std::size_t i = 0; i < rows.size (); ++i)
    if (is_isolated[number[i]] != 0)
      isolated.push_back (rows[i]);
  std::sort (isolated.begin (), isolated.end ());
  return isolated;
}

constexpr std::size_t NEAREST_POINTS = 20; // nearest neighbours, also for balls
constexpr std::size_t REACH_OF = 6;        // neighbour whose distance is a point's reach
// Chosen, like the others below, on seeded clouds with outliers strewn into their boxes, and on the
// clouds of the first benchmark, which lose no point; a thin spike of the surface may.
constexpr std::size_t LARGEST_CLUSTER = 7; // that may be left out, in points

// Fits the plane of the neighbours of a point without it, then again without strays.
// \param scratch reused from point to point
bool
isOffPlane (const Positions& positions, Index p, const Row& row, double least_height,
            std::vector<double>& scratch)
{
  constexpr double STRAY = 3.0; // median distances to the plane, beyond which points are not of it
  constexpr double FLAT = 0.25; // largest such median, in distances of the point to the plane
  double spread = std::numeric_limits<double>::infinity ();
  Plane plane;
  for (int pass = 0; pass < 2; ++pass) {
    PlaneFit fit;
    for (const Index q : row) {
      const Vector3d offset = positions[q] - positions[p];
      if (pass == 0 || std::abs (plane.height (offset)) <= STRAY * spread)
        fit.add (offset);
    }
    plane = fit.plane ();
    scratch.clear ();
    for (const Index q : row)
      scratch.push_back (std::abs (plane.height (positions[q] - positions[p])));
    spread = median (scratch);
  }
  const double height = std::abs (plane.height (Vector3d::Zero ()));
  return height > least_height && spread < FLAT * height;
}

bool
isApart (const Positions& positions, Index p, const Row& row, const std::vector<float>& reach,
         std::vector<double>& scratch)
{
  // Distances, in reaches, from which on a small cluster or a point is apart: to the rest, and to the
  // plane of its neighbours.
  constexpr double FAR = 5.0, OFF_PLANE = 1.75;
  if (row.size () < 4)
    return false;
  // The nearest ones may be of the same small cluster: the threshold uses the reach of the others.
  const std::size_t beyond = std::min (LARGEST_CLUSTER, row.size () / 2);
  const double to_others = distanceBetween (positions, p, row[beyond]);
  scratch.clear ();
  for (std::size_t i = beyond; i < row.size (); ++i)
    scratch.push_back (reach[row[i]]);
  if (to_others <= OFF_PLANE * *std::min_element (scratch.begin (), scratch.end ()))
    return false; // true for nearly all points, without a median
  const double usual = median (scratch), least_height = OFF_PLANE * usual;
  return to_others > FAR * usual ||
         (to_others > least_height && isOffPlane (positions, p, row, least_height, scratch));
}

// Of each point that enough others count as close: the points apart that it counts as close. An
// outlier may well be nearest to another outlier, but few points are nearest to the latter.
CsrLists
arcsToApart (const CsrLists& neighbors, const Flags& apart)
{
  constexpr std::size_t OWN = 12;     // nearest neighbours that count as close
  constexpr std::uint32_t OWNERS = 4; // so many points count one as close that is kept
  std::vector<std::uint32_t> owners (apart.size (), 0);
  for (std::size_t q = 0; q < apart.size (); ++q)
    for (Index p : neighbors.first (q, OWN))
      ++owners[p];
  return makeCsrLists (apart.size (), [&] (const auto& emit) {
    for (std::size_t q = 0; q < apart.size (); ++q)
      if (owners[q] >= OWNERS)
        for (Index p : neighbors.first (q, OWN))
          if (apart[p] != 0)
            emit (q, p);
  });
}

// Clears the flag of points that can be reached from the surface along arcs.
void
keepReached (const CsrLists& arcs, Flags& apart)
{
  std::vector<Index> reached = indicesWhere (
      apart.size (), [&] (Index q) { return apart[q] == 0 && arcs.row (q).size () > 0; });
  while (!reached.empty ()) {
    const Index q = reached.back ();
    reached.pop_back ();
    for (const Index p : arcs.row (q))
      if (std::exchange (apart[p], std::uint8_t{0}) != 0)
        reached.push_back (p);
  }
}

// The points that lie apart in small clusters, ascending.
std::vector<Index>
smallClusters (const CsrLists& arcs, const Flags& apart)
{
  DisjointSets clusters (apart.size ());
  for (Index q = 0; q < apart.size (); ++q)
    for (const Index p : arcs.row (q))
      if (apart[q] != 0 && apart[p] != 0)
        clusters.join (q, p);
  std::vector<Index> size (apart.size (), 0);
  for (Index p = 0; p < apart.size (); ++p)
    ++size[clusters.find (p)];
  return indicesWhere (apart.size (), [&] (Index p) {
    return apart[p] != 0 && size[clusters.find (p)] <= LARGEST_CLUSTER;
  });
}

} // namespace

GrossOutliers
findGrossOutliers (const Positions& positions, const RunContext& run)
{
  constexpr std::size_t FEWEST_POINTS = 21; // of a cloud
  constexpr double STEPS = 8192.0; // of double precision in a spacing of the bulk, at least
  GrossOutliers found;
  if (positions.size () < FEWEST_POINTS)
    return found;
  const Bulk bulk = findBulk (positions);
  if (!std::isfinite (bulk.radius) || bulk.points < FEWEST_POINTS)
    return found;
  // The bulk is a surface of at most this many points: their spacing is about the radius over their
  // root. A frame has 1 / epsilon steps across it.
  const double spacing = bulk.radius / std::sqrt (static_cast<double> (bulk.points));
  const double largest_frame = spacing / (STEPS * std::numeric_limits<double>::epsilon ());
  std::vector<Index> beyond;
  for (std::size_t row = 0; row < positions.size (); ++row) {
    if (!positions[row].allFinite ())
      continue;
    const double distance = bulk.distanceTo (positions[row]);
    if (distance > largest_frame)
      found.unbearable.push_back (static_cast<Index> (row));
    else if (distance > bulk.radius)
      beyond.push_back (static_cast<Index> (row));
  }
  found.isolated = keepIsolated (positions, bulk, std::move (beyond), run);
  return found;
}

std::vector<Index>
findOutliers (const Positions& positions, const CsrLists& neighbors, const RunContext& run)
{
  const std::size_t n = positions.size ();
  if (n < 3 * LARGEST_CLUSTER)
    return {};
  std::vector<float> reach (n, 0.0F); // distance to the 6th nearest neighbour; 0 if there are none
  parallelPoints (run, n, [&] (Index p) {
    if (const Row row = neighbors.row (p); row.size () > 0)
      reach[p] = static_cast<float> (
          distanceBetween (positions, p, row[std::min (REACH_OF, row.size ()) - 1]));
  });
  Flags apart (n, 0);
  parallelPoints<std::vector<double>> (run, n, [&] (Index p, std::vector<double>& scratch) {
    const Row row = neighbors.first (p, NEAREST_POINTS);
    apart[p] = isApart (positions, p, row, reach, scratch) ? 1 : 0;
  });
  if (std::find (apart.begin (), apart.end (), 1) == apart.end ())
    return {};
  const CsrLists arcs = arcsToApart (neighbors, apart);
  keepReached (arcs, apart);
  return smallClusters (arcs, apart);
}

} // namespace pcl::floater

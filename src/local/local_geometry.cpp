// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "local/local_geometry.h"

#include "core/parallel.h"

namespace pcl::floater {
namespace {
Vector3d
fitNormal (const Positions& positions, Index p, Row neighbors, bool is_of_all)
{
  // Both were chosen on the clouds of the first benchmark, and are fragile: a fifth more or less of
  // either costs 2 to 4 of 18 clean clouds there (test/benchmark/flaws.py shows the effect of changes).
  // Nearest neighbours of the first plane: about the first ring of an even sampling, and a little more.
  constexpr std::size_t CORE_POINTS = 8;
  // Of the angle, 30 degrees, between the first plane and a neighbour of the second fit.
  constexpr double SHEET_SINE = 0.5;
  constexpr std::size_t ADDED = 2; // neighbours added at a time, while all are collinear
  PlaneFit core;
  core.add (Vector3d::Zero ()); // the point itself
  std::size_t used = 0;
  const auto addUpTo = [&] (std::size_t count) {
    for (; used < std::min (count, neighbors.size ()); ++used)
      core.add (positions[neighbors[used]] - positions[p]);
    return core.plane ();
  };
  Plane plane = addUpTo (is_of_all ? neighbors.size () : CORE_POINTS);
  while (plane.aspect < LINE_ASPECT && used < neighbors.size ())
    plane = addUpTo (used + ADDED);
  const Vector3d first = plane.normal;
  if (is_of_all)
    return first;
  PlaneFit sheet;
  sheet.add (Vector3d::Zero ());
  for (Index q : neighbors) {
    const Vector3d offset = positions[q] - positions[p];
    if (std::abs (first.dot (offset)) <= SHEET_SINE * offset.norm ())
      sheet.add (offset);
  }
  return 2.0 * sheet.weight () > static_cast<double> (CORE_POINTS) ? sheet.plane ().normal : first;
}

// Each row of one of two tables: of the first where `is_first` is not 0.
CsrLists
mergeRows (const CsrLists& first, const CsrLists& second, const Flags& is_first)
{
  return makeCsrLists (second.rows (), [&] (auto&& emit) {
    for (std::size_t p = 0; p < second.rows (); ++p)
      for (const Index q : (is_first[p] != 0 ? first : second).row (p))
        emit (p, q);
  });
}
} // namespace

LocalPlanes
beginPlanes (const Points& points, CsrLists neighbors, std::optional<KdTree> known,
             const StarSettings& settings, const RunContext& run)
{
  const Positions& positions = points.workingPositions ();
  LocalPlanes planes;
  planes.neighbors = std::move (neighbors);
  planes.spacing = localSpacing (positions, planes.neighbors, run);
  if (settings.reach_beyond)
    planes.tree.emplace (known ? std::move (*known)
                               : KdTree (positions, run, PointOrder::ALONG_CURVE));
  return planes;
}

RowOf
rowsBeside (const Points& points, const LocalPlanes& planes)
{
  if (!planes.tree || !planes.normals.empty ())
    return [&planes] (Index p) { return planes.neighbors.row (p); };
  return [search = BesideSearch{points.workingPositions (), planes}] (Index p) mutable {
    search.extend (p);
    return Row{search.row.data (), search.row.data () + search.row.size ()};
  };
}

LocalPlanes
fitLocalPlanes (const Points& points, LocalPlanes planes, const StarSettings& settings,
                const RunContext& run)
{
  const Positions& positions = points.workingPositions ();
  if (settings.reach_beyond) {
    const std::size_t n = positions.size ();
    planes.beside_reach.resize (n);
    RangeRows beside (n, n);
    parallelRanges (run, n, [&] (std::size_t first, std::size_t last) {
      BesideSearch search{positions, planes};
      for (auto p = static_cast<Index> (first); p < last; ++p) {
        planes.beside_reach[p] = search.extend (p);
        for (std::size_t i = planes.neighbors.row (p).size (); i < search.row.size (); ++i)
          beside.add (first, p, search.row[i]);
      }
    });
    planes.beside = beside.join ();
    appendRows (planes.beside, planes.neighbors);
  }
  planes.normals.resize (positions.size ());
  parallelPoints (run, positions.size (), [&] (Index p) {
    planes.normals[p] =
        fitNormal (positions, p, planes.neighbors.row (p), settings.planes_of_all).cast<float> ();
  });
  for (std::size_t p = 0; p < points.normals.size (); ++p)
    if (!points.normals[p].isZero (0.0F))
      planes.normals[p] = points.normals[p];
  return planes;
}

LocalGeometry
makeLocalGeometry (const Points& points, LocalPlanes planes, const StarSettings& settings,
                   const RunContext& run, std::optional<Stars> begun)
{
  const Positions& positions = points.workingPositions ();
  LocalGeometry geometry;
  if (!points.projected.empty ())
    geometry.own_spacing = localSpacing (points.positions, planes.neighbors, run);
  geometry.stars =
      begun ? std::move (*begun)
            : makeStars (positions, planes.neighbors, planes.normals, Rows::all (positions.size ()),
                         settings, run, settings.reach_beyond ? &planes : nullptr);
  if (settings.reach_beyond)
    finishStars (positions, planes, settings, run, geometry.stars);
  geometry.neighbors = std::move (planes.neighbors);
  geometry.spacing = std::move (planes.spacing);
  appendRows (geometry.stars.far_neighbors, geometry.neighbors);
  geometry.stars.far_neighbors = {};
  for (std::size_t p = 0; p < geometry.stars.reach.size (); ++p)
    geometry.spacing[p] =
        std::max (geometry.spacing[p], REACH_AS_SPACING * geometry.stars.reach[p]);
  return geometry;
}

void
copyRows (const LocalGeometry& from, const std::vector<Index>& rows, LocalGeometry& to)
{
  Flags is_copied (to.spacing.size ());
  for (const Index p : rows) {
    is_copied[p] = 1;
    to.spacing[p] = from.spacing[p];
    to.stars.open[p] = from.stars.open[p];
    to.stars.normals[p] = from.stars.normals[p];
    if (!to.stars.reach.empty ())
      to.stars.reach[p] = from.stars.reach[p];
  }
  std::vector<Vector2d> offsets;
  if (!to.stars.offsets_in_plane.empty ())
    for (std::size_t p = 0; p < is_copied.size (); ++p) {
      const Stars& stars = is_copied[p] != 0 ? from.stars : to.stars;
      const auto begin = stars.offsets_in_plane.begin ();
      offsets.insert (offsets.end (), begin + stars.neighbors.offsets[p],
                      begin + stars.neighbors.offsets[p + 1]);
    }
  to.stars.offsets_in_plane = std::move (offsets);
  to.neighbors = mergeRows (from.neighbors, to.neighbors, is_copied);
  to.stars.neighbors = mergeRows (from.stars.neighbors, to.stars.neighbors, is_copied);
}

} // namespace pcl::floater

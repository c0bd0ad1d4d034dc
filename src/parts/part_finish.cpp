// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/part_finish.h"

#include "mesh/insertion.h"
#include "mesh/self_intersection_removal.h"
#include "mesh/vertex_stars.h"
#include "parts/near_triangles.h"
#include "points/neighbors.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <stdexcept>
#include <utility>

namespace pcl::floater {
namespace {
using Edge = std::array<Index, 2>; // from, to

Triangle
shifted (Triangle corners, Index by)
{
  for (Index& p : corners)
    p += by;
  return corners;
}

// Removes triangles, flips components and adds triangles.
void
apply (const PartChange& change, Index first, std::size_t points, const RunContext& run,
       std::vector<Triangle>& triangles)
{
  if (!change.turned.empty ()) {
    TriangleMesh mesh;
    mesh.triangles = std::move (triangles);
    if (!mesh.connect (points, run))
      throw std::logic_error ("the mesh of a part is no manifold");
    const MeshComponents components = findComponents (mesh, run);
    triangles = std::move (mesh.triangles);
    std::vector<std::uint8_t> is_turned (components.count, 0);
    for (const Index c : change.turned)
      is_turned.at (c) = 1;
    for (std::size_t t = 0; t < triangles.size (); ++t)
      if (is_turned[components.of_triangle[t]] != 0)
        std::swap (triangles[t][1], triangles[t][2]);
  }
  for (const Index t : change.dropped)
    triangles.at (t)[0] = NONE;
  triangles.erase (std::remove_if (triangles.begin (), triangles.end (),
                                   [] (const Triangle& corners) { return corners[0] == NONE; }),
                   triangles.end ());
  for (const Triangle& corners : change.added)
    triangles.push_back (shifted (corners, Index{0} - first));
}

// Marks points at triangles of several parts as partial, and triangles beside these as fixed.
void
fixBesideSeam (const std::vector<Triangle>& seam, const PartPoints& points, TriangleMesh& mesh)
{
  mesh.is_partial.assign (points.size (), 0);
  std::set<Edge> edges;
  for (const Triangle& corners : seam)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index p = corners[i], q = corners[(i + 1) % 3];
      if (points.has (p))
        mesh.is_partial[p - points.first] = 1;
      edges.insert ({p, q});
    }
  mesh.is_fixed.assign (mesh.triangles.size (), 0);
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    for (std::uint8_t side = 0; side < 3; ++side) {
      const Index p = mesh.from ({t, side}), q = mesh.to ({t, side});
      if (mesh.is_partial[p] != 0 && mesh.is_partial[q] != 0 &&
          edges.count ({points.first + q, points.first + p}) > 0)
        mesh.is_fixed[t] = 1;
    }
}

// The neighbours of some points within the part, numbered from its first point.
CsrLists
neighborsWithin (const PartPoints& points, const NeighborRows& neighbors, std::vector<Index> some)
{
  for (Index& p : some)
    p += points.first;
  const CsrLists rows = neighbors (some);
  CsrLists within;
  within.ids.reserve (rows.ids.size ());
  within.offsets.reserve (rows.offsets.size ());
  within.offsets.push_back (0);
  for (std::size_t i = 0; i < some.size (); ++i) {
    for (const Index q : rows.row (i))
      if (points.has (q))
        within.ids.push_back (q - points.first);
    within.offsets.push_back (static_cast<Index> (within.ids.size ()));
  }
  return within;
}

// Fetches all neighbours on demand.
class NeighborsWithin
{
public:
  NeighborsWithin (const PartPoints& points, const NeighborRows& neighbors)
      : points_ (points), neighbors_ (neighbors)
  {
  }

  NeighborTable table ()
  {
    return {[this] (const std::vector<Index>& some) {
              return neighborsWithin (points_, neighbors_, some);
            },
            [this] () -> const CsrLists& {
              if (all_.rows () == 0) {
                std::vector<Index> own (points_.size ());
                std::iota (own.begin (), own.end (), Index{0});
                all_ = neighborsWithin (points_, neighbors_, std::move (own));
              }
              return all_;
            }};
  }

private:
  const PartPoints& points_;
  const NeighborRows& neighbors_;
  CsrLists all_;
};

std::vector<Index>
withoutTriangle (const TriangleMesh& mesh)
{
  std::vector<Index> points;
  for (Index p = 0; p < mesh.triangle_of.size (); ++p)
    if (mesh.triangle_of[p] == NONE)
      points.push_back (p);
  return points;
}

// Seeds of the zone: points at triangles of several parts, at the boundary, without a triangle, or
// neighbours of such a point, which may be in another part.
std::vector<Index>
seedsOfZone (const TriangleMesh& mesh, const PartPoints& points, const NeighborRows& neighbors,
             const std::vector<Index>& beside)
{
  std::vector<std::uint8_t> is_seed = mesh.is_partial;
  const std::vector<Index> missing = withoutTriangle (mesh);
  for (const Index p : missing)
    is_seed[p] = 1;
  for (const Index q : neighborsWithin (points, neighbors, missing).ids)
    is_seed[q] = 1;
  for (const Index p : beside)
    is_seed[p - points.first] = 1;
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    for (std::uint8_t side = 0; side < 3; ++side)
      if (mesh.neighbors[t][side] == NONE)
        is_seed[mesh.from ({t, side})] = is_seed[mesh.to ({t, side})] = 1;
  std::vector<Index> seeds;
  for (Index p = 0; p < is_seed.size (); ++p)
    if (is_seed[p] != 0)
      seeds.push_back (p);
  return seeds;
}

// Folded edges of triangles outside the zone.
// \param is_in_zone of each triangle
std::size_t
countFoldsOutside (const std::vector<std::uint8_t>& is_in_zone, const TriangleMesh& mesh,
                   const std::vector<Eigen::Vector3d>& positions, const RunContext& run)
{
  const auto isInZone = [&is_in_zone] (Index t) { return is_in_zone[t] != 0; };
  std::size_t count = 0;
  for (const MeshEdge& e : findFolds (mesh, positions, run))
    count += isInZone (e.triangle) && isInZone (mesh.mate (e).triangle) ? 0 : 1;
  return count;
}

// Orients the normals of points without a triangle (see orientMissingNormals).
void
orientMissing (const TriangleMesh& mesh, PartPoints& points, const NeighborRows& neighbors)
{
  const std::vector<Index> missing = withoutTriangle (mesh);
  const CsrLists rows = neighborsWithin (points, neighbors, missing);
  for (std::size_t i = 0; i < missing.size (); ++i)
    orientMissingNormal (mesh, missing[i], rows.row (i), points.normals);
}

SeamZone
takeZone (const MeshRegion& region, const PartPoints& points, const TriangleMesh& mesh,
          const NeighborRows& neighbors)
{
  SeamZone zone;
  std::vector<Index> place (points.size (), NONE);
  for (std::size_t i = 0; i < region.points.size (); ++i) {
    const Index p = region.points[i];
    place[p] = static_cast<Index> (i);
    zone.points.push_back (points.first + p);
    zone.positions.push_back (points.positions[p]);
    zone.normals.push_back (points.normals[p]);
    zone.spacing.push_back (points.spacing[p]);
  }
  zone.neighbors = neighbors (zone.points);
  zone.is_partial = region.is_partial;
  for (const Index t : region.triangles) {
    const Triangle& corners = mesh.triangles[t];
    zone.triangles.push_back ({place[corners[0]], place[corners[1]], place[corners[2]]});
  }
  return zone;
}

// Flags of the entries of a list.
std::vector<std::uint8_t>
markAll (const std::vector<Index>& list, std::size_t size)
{
  std::vector<std::uint8_t> marks (size, 0);
  for (const Index i : list)
    marks[i] = 1;
  return marks;
}

// The triangles outside the zone, in the order of their smallest points.
struct InnerTriangles
{
  InnerTriangles (const TriangleMesh& mesh, const std::vector<std::uint8_t>& is_in_zone)
  {
    const auto count = static_cast<std::size_t> (
        std::count (is_in_zone.begin (), is_in_zone.end (), std::uint8_t{0}));
    numbers.reserve (count);
    triangles.reserve (count);
    for (const Index t : orderByPoints (mesh.triangles, mesh.triangle_of.size ()))
      if (is_in_zone[t] == 0) {
        numbers.push_back (t);
        triangles.push_back (mesh.triangles[t]);
      }
  }

  CrossingPairs findCrossing (const std::vector<Eigen::Vector3d>& positions,
                              const RunContext& run) const
  {
    return findSelfIntersectionsOf (triangles, 0, triangles.size (), positions, run);
  }

  std::vector<Index> numbers; // in the mesh
  std::vector<Triangle> triangles;
};

// Removes self-intersections of inner triangles. Those in the zone stay. Clears the neighbours of
// an unchanged mesh: the search needs as much memory.
InnerTriangles
uncrossInner (TriangleMesh& mesh, const std::vector<std::uint8_t>& is_in_zone, PartPoints& points,
              const NeighborTable& neighbors, const PartFinishSettings& settings,
              const RunContext& run, CrossingSum& sum)
{
  std::vector<std::array<Index, 3>> ().swap (mesh.neighbors);
  InnerTriangles inner (mesh, is_in_zone);
  const auto point_of = [&points] (Index p) { return points.first + p; };
  CrossingPairs pairs = inner.findCrossing (points.positions, run);
  sum.found = pairs.size ();
  if (!pairs.empty () && pairs.untested.empty () && settings.remove_self_intersections) {
    const std::vector<Index> triangle_of = mesh.triangle_of;
    if (!mesh.connect (points.size (), run))
      throw std::logic_error ("the finished mesh of a part is no manifold");
    mesh.triangle_of = triangle_of; // as before these changes
    orientNormals (mesh, points.positions, points.normals, run);
    const TriangleCost cost (points.positions, points.normals, &points.spacing,
                             settings.finish.cost);
    mesh.is_fixed = is_in_zone;
    sum.done = removeSelfIntersections (mesh, pairsInOrder (pairs, inner.numbers), neighbors.all (),
                                        cost, points.positions, settings.uncrossing, run);
    if (sum.done.hasChanged ()) {
      inner = InnerTriangles (mesh, is_in_zone);
      pairs = inner.findCrossing (points.positions, run);
    }
  }
  sum.take (pairs, inner.triangles, point_of);
  return inner;
}

} // namespace

FinishedPart
finishPart (PartPoints points, std::vector<Triangle> triangles, const PartChange& change,
            const NeighborRows& neighbors, const PartFinishSettings& settings,
            const RunContext& run)
{
  apply (change, points.first, points.size (), run, triangles);
  TriangleMesh mesh;
  mesh.triangles = std::move (triangles);
  fixBesideSeam (change.seam, points, mesh);
  if (!mesh.connect (points.size (), run))
    throw std::logic_error ("the mesh of a part and what was added to it are no manifold");

  orientNormals (mesh, points.positions, points.normals, run);
  orientMissing (mesh, points, neighbors);
  FinishedPart finished;
  NeighborsWithin within (points, neighbors);
  FinishSettings finish_settings;
  finish_settings.flip_edges = settings.flip_edges;
  finish_settings.limits = settings.finish;
  const MeshFinish finish =
      repairMesh (mesh, {points.positions, within.table (), points.spacing, points.normals},
                  finish_settings, run);
  finished.flips = finish.flips;
  finished.folds_after_flips = finish.folds_after_flips;

  const MeshRegion region =
      regionAround (mesh.triangles, points.size (),
                    seedsOfZone (mesh, points, neighbors, change.beside), settings.parts.rings);
  const std::vector<std::uint8_t> is_in_zone = markAll (region.triangles, mesh.triangles.size ());
  finished.corners =
      sampleCorners (mesh, points.positions, CORNER_SAMPLE / settings.part_count + 1, run);
  finished.folds = countFoldsOutside (is_in_zone, mesh, points.positions, run);
  CrossingSum crossing;
  InnerTriangles inner =
      uncrossInner (mesh, is_in_zone, points, within.table (), settings, run, crossing);
  if (crossing.done.hasChanged ())
    finished.folds = countFoldsOutside (is_in_zone, mesh, points.positions, run);
  finished.zone = takeZone (region, points, mesh, neighbors);
  mesh = {};
  finished.check = checkInner (points, inner.triangles, markAll (region.points, points.size ()),
                               settings.check, run);
  finished.check.crossing = std::move (crossing);
  finished.buckets = makeTriangleBuckets (inner.triangles, points.positions);
  finished.triangles = std::move (inner.triangles);
  for (Triangle& corners : finished.triangles)
    corners = shifted (corners, points.first);
  return finished;
}

} // namespace pcl::floater

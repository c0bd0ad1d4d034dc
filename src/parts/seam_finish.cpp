// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts/seam_finish.h"

#include "parts/joined_points.h"
#include "parts/mesh_region.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
// The zones of all parts, whose points are places in `points`.
struct JoinedZones
{
  JoinedPoints points;
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3f> normals;
  std::vector<float> spacing;
  std::vector<Index> scatter;
  CsrLists neighbors;
  TriangleMesh mesh; // the triangles of the seam last
};

JoinedZones
joinZones (const std::vector<SeamZone>& zones, const std::vector<Triangle>& seam)
{
  JoinedZones joined;
  for (const SeamZone& zone : zones)
    joined.points.add (zone.points);
  joined.points.sort ();
  // Parts are in the order of their points, and each point is of one part.
  joined.neighbors.offsets.push_back (0);
  Index before = 0;
  for (const SeamZone& zone : zones) {
    joined.positions.insert (joined.positions.end (), zone.positions.begin (),
                             zone.positions.end ());
    joined.normals.insert (joined.normals.end (), zone.normals.begin (), zone.normals.end ());
    joined.spacing.insert (joined.spacing.end (), zone.spacing.begin (), zone.spacing.end ());
    joined.mesh.is_partial.insert (joined.mesh.is_partial.end (), zone.is_partial.begin (),
                                   zone.is_partial.end ());
    for (std::size_t i = 0; i < zone.points.size (); ++i) {
      if (zone.is_scatter[i] != 0)
        joined.scatter.push_back (before + static_cast<Index> (i));
      for (const Index q : zone.neighbors.row (i))
        if (const Index at = joined.points.placeOf (q); at != NONE)
          joined.neighbors.ids.push_back (at);
      joined.neighbors.offsets.push_back (static_cast<Index> (joined.neighbors.ids.size ()));
    }
    for (const Triangle& corners : zone.triangles)
      joined.mesh.triangles.push_back (
          {before + corners[0], before + corners[1], before + corners[2]});
    before += static_cast<Index> (zone.points.size ());
  }
  for (const Triangle& corners : seam)
    joined.mesh.triangles.push_back ({joined.points.placeOf (corners[0]),
                                      joined.points.placeOf (corners[1]),
                                      joined.points.placeOf (corners[2])});
  return joined;
}

// Which triangles are not to be repaired: those that are not near to one with corners in several
// parts, or to a point without a triangle, and those at edges between partial points that have no
// triangle on the other side. It may be one that is in no zone.
std::vector<std::uint8_t>
findFixed (const TriangleMesh& mesh, std::size_t first_of_seam, std::size_t rings)
{
  std::vector<Index> seeds;
  for (std::size_t t = first_of_seam; t < mesh.triangles.size (); ++t)
    seeds.insert (seeds.end (), mesh.triangles[t].begin (), mesh.triangles[t].end ());
  for (Index p = 0; p < mesh.triangle_of.size (); ++p)
    if (mesh.triangle_of[p] == NONE)
      seeds.push_back (p);
  std::vector<std::uint8_t> is_fixed (mesh.triangles.size (), 1);
  for (const Index t :
       regionAround (mesh.triangles, mesh.triangle_of.size (), seeds, rings).triangles)
    is_fixed[t] = 0;
  for (Index t = 0; t < mesh.triangles.size (); ++t)
    for (std::uint8_t side = 0; side < 3; ++side)
      if (mesh.neighbors[t][side] == NONE && mesh.isPartial (mesh.from ({t, side})) &&
          mesh.isPartial (mesh.to ({t, side})))
        is_fixed[t] = 1;
  return is_fixed;
}

} // namespace

FinishedSeam
finishSeam (const std::vector<SeamZone>& zones, const std::vector<Triangle>& seam,
            std::vector<double> corners, const FinishSettings& settings, std::size_t rings,
            const RunContext& run)
{
  JoinedZones joined = joinZones (zones, seam);
  TriangleMesh& mesh = joined.mesh;
  const std::size_t first_of_seam = mesh.triangles.size () - seam.size ();
  if (!mesh.connect (joined.points.size (), run))
    throw std::logic_error ("the triangles between parts do not fit");
  mesh.is_fixed = findFixed (mesh, first_of_seam, rings);
  std::size_t folds_of_parts = 0; // which they have told already
  for (const MeshEdge& e : findFolds (mesh, joined.positions, run))
    folds_of_parts += std::max (e.triangle, mesh.mate (e).triangle) < first_of_seam ? 1 : 0;
  FinishedSeam finished;
  MeshFinish& finish = finished.finish;
  finish = repairMesh (
      mesh, {joined.positions, joined.neighbors, joined.spacing, joined.scatter, joined.normals},
      settings, run);
  finish.folds_after_flips -= std::min (finish.folds_after_flips, folds_of_parts);
  mesh.is_fixed.clear ();
  if (settings.open_boundary)
    openBoundary (mesh, joined.positions, std::move (corners), settings.limits.notches, run,
                  finish);
  finished.triangles.reserve (mesh.triangles.size ());
  for (const auto& [a, b, c] : mesh.triangles)
    finished.triangles.push_back (
        {joined.points.pointAt (a), joined.points.pointAt (b), joined.points.pointAt (c)});
  return finished;
}

} // namespace floater
} // namespace pcl

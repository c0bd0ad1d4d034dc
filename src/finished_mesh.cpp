// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "finished_mesh.h"

#include "cloud_geometry.h"
#include "mesh/flaw_repair.h"
#include "mesh/flips.h"
#include "mesh/vertex_splits.h"
#include "report/report_mesh.h"
#include "report/verdict.h"

#include <algorithm>
#include <utility>

namespace pcl::floater {
namespace {
// Points that were set aside get the point that stands for them as a neighbour, and its neighbours.
void
extendNeighbors (CsrLists& neighbors, const std::vector<Index>& of)
{
  std::size_t entries = neighbors.ids.size ();
  for (const Index p : of)
    entries += neighbors.row (p).size () + 1;
  neighbors.ids.reserve (entries); // rows stay where they are
  for (const Index p : of) {
    const Row row = neighbors.row (p);
    neighbors.ids.push_back (p);
    for (const Index q : row)
      neighbors.ids.push_back (q);
    neighbors.offsets.push_back (static_cast<Index> (neighbors.ids.size ()));
  }
}
} // namespace

MeshExamination
examine (const TriangleMesh& mesh, const Points& points, const LocalGeometry& geometry,
         const Request& request)
{
  request.run.beginStage (Stage::CHECK);
  return checkMesh (mesh, points, geometry.meshSpacing (), request.run, request.limits.check);
}

Points
addStacked (TriangleMesh& mesh, const Points& points, LocalGeometry& geometry, MeshFinish& finish,
            const Request& request)
{
  const std::vector<Index>& of = points.stacked.of;
  const auto extend = [&of] (auto& values) {
    if (!values.empty ())
      for (const Index p : of)
        values.push_back (values[p]);
  };
  extend (geometry.spacing);
  extend (geometry.own_spacing);
  extend (geometry.stars.normals);
  extend (finish.remade.is_remade);
  std::vector<Index> added;
  for (std::size_t i = 0; i < of.size (); ++i)
    if (mesh.triangle_of[of[i]] != NONE)
      added.push_back (static_cast<Index> (points.size () + i));
  Points all = withStacked (points);
  splitVertices (mesh, all.positions, added, request.limits.splits, request.run);
  return all;
}

void
repairSplits (TriangleMesh& mesh, const Points& points, const Points& all, LocalGeometry& geometry,
              const Request& request, MeshFinish& finish)
{
  finish.crossing = findSelfIntersections (mesh.triangles, all.positions, request.run);
  finish.pairs_found = std::max (finish.pairs_found, finish.crossing->size ());
  if (!repairsFlaws (request.options) ||
      (finish.crossing->empty () && findFolds (mesh, all.positions, request.run).empty ()))
    return;
  extendNeighbors (geometry.neighbors, points.stacked.of);
  repairAtEnd (mesh, all.positions, geometry, request.limits.surface.finish, finish, request.run);
  geometry.neighbors = {};
}

Problem
useMesh (TriangleMesh mesh, const MeshFinish& finish, MeshExamination found, const Points& points,
         const LocalGeometry& geometry, const Request& request, Result& result)
{
  Report& report = result.report;
  if (mesh.triangles.empty ())
    return {RunStatus::DEGENERATE,
            "no three points make a triangle of a surface: they lie along lines or curves, or each "
            "on its own; a surface needs points side by side"};
  report.statistics.self_intersections_found =
      std::max (finish.pairs_found, found.crossing.size ());
  Trimming trimming;
  if (asksForTrimming (request.options.trimming) && found.isManifold ()) {
    trimming =
        trimMesh (mesh, points, geometry.meshSpacing (), request.options.trimming, request.run);
    std::vector<Index> unused = std::move (found.unused); // without points that trimming leaves
                                                          // unused
    found = examine (mesh, points, geometry, request);
    if (!report.is_view) // noise along the rays makes true surfaces cross themselves
      checkCrossing (mesh.triangles, points, request.run, found);
    found.unused = std::move (unused);
    if (trimming.triangles > 0)
      report.loop.clear ();
  }
  std::vector<Triangle> triangles = std::move (mesh.triangles);
  mesh = {};
  Problem problem = reportCheck (points, found, request.options, report);
  if (!problem)
    problem =
        reportTrimming (points, trimming, request.options.trimming, triangles.size (), report);
  if (!problem)
    reportFacing (points, finish.facing, request.options.facing, report);
  report.statistics.flips = finish.flips;
  report.statistics.necks_cut = finish.necks_cut;
  report.statistics.remade_points = finish.remade.points ();
  report.statistics.self_intersection_flips = finish.repairs.flips;
  report.statistics.self_intersection_moves = finish.repairs.moves;
  report.statistics.self_intersection_rebuilds = finish.repairs.rebuilds;
  report.statistics.triangles = triangles.size ();
  report.check.largest_area_share = largestAreaShare (triangles, points.positions);
  for (Triangle& triangle : triangles)
    for (Index& p : triangle)
      p = points.cloud_index[p];
  result.triangles = std::move (triangles);
  return problem;
}

} // namespace pcl::floater

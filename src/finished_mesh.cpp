// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "finished_mesh.h"

#include "cloud_geometry.h"
#include "mesh/flips.h"
#include "mesh/self_intersection_removal.h"
#include "mesh/vertex_splits.h"
#include "report/report_mesh.h"
#include "report/verdict.h"

#include <utility>

namespace pcl::floater {
namespace {
// Examines the mesh, and finds self-intersections. Skips them for views: the search would take a
// quarter of the time, and noise along the rays makes true surfaces cross themselves.
MeshExamination
examineWithCrossing (const TriangleMesh& mesh, const Points& points, const LocalGeometry& geometry,
                     const Request& request)
{
  MeshExamination found = examine (mesh, points, geometry, request);
  checkCrossing (mesh.triangles, points, request.run, found);
  return found;
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
addStacked (TriangleMesh& mesh, const Points& points, LocalGeometry& geometry,
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
  geometry.neighbors = {};
  std::vector<Index> added;
  for (std::size_t i = 0; i < of.size (); ++i)
    if (mesh.triangle_of[of[i]] != NONE)
      added.push_back (static_cast<Index> (points.size () + i));
  Points all = withStacked (points);
  splitVertices (mesh, all.positions, added, request.limits.splits, request.run);
  return all;
}

void
uncross (TriangleMesh& mesh, MeshExamination& found, const Points& points, LocalGeometry& geometry,
         const Request& request, Statistics& statistics, std::optional<CrossingPairs> known)
{
  checkCrossing (mesh.triangles, points, request.run, found, std::move (known));
  statistics.self_intersections_found = found.crossing.size ();
  // Where noisy points were projected, the true triangles cross each other.
  if (found.crossing.empty () || !found.crossing.untested.empty () ||
      !request.options.remove_self_intersections || !request.options.flip_edges ||
      !points.projected.empty ())
    return;
  if (geometry.neighbors.rows () == 0)
    geometry.neighbors =
        findNeighbors (points, neighborSettings (request.options, nullptr), request.run);
  std::vector<Eigen::Vector3f>& normals = geometry.stars.normals;
  orientNormals (mesh, points.positions, normals, request.run);
  const TriangleCost cost (points.positions, normals, &geometry.meshSpacing (),
                           request.limits.surface.finish.cost);
  const Uncrossing done =
      removeSelfIntersections (mesh, found.crossing, geometry.neighbors, cost, points.positions,
                               request.limits.uncrossing, request.run);
  statistics.self_intersection_flips = done.flips;
  statistics.self_intersection_moves = done.moves;
  statistics.self_intersection_rebuilds = done.rebuilds;
  if (done.hasChanged ())
    found = examineWithCrossing (mesh, points, geometry, request);
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
  Trimming trimming;
  if (asksForTrimming (request.options.trimming) && found.isManifold ()) {
    trimming =
        trimMesh (mesh, points, geometry.meshSpacing (), request.options.trimming, request.run);
    std::vector<Index> unused = std::move (found.unused); // without points that trimming leaves
                                                          // unused
    found = report.is_view ? examine (mesh, points, geometry, request)
                           : examineWithCrossing (mesh, points, geometry, request);
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
  report.statistics.remade_points = finish.remade_points;
  report.statistics.triangles = triangles.size ();
  report.check.largest_area_share = largestAreaShare (triangles, points.positions);
  for (Triangle& triangle : triangles)
    for (Index& p : triangle)
      p = points.cloud_index[p];
  result.triangles = std::move (triangles);
  return problem;
}

} // namespace pcl::floater

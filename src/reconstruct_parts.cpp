// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruct_parts.h"

#include "finished_mesh.h"
#include "mesh/trimming.h"
#include "parts/parts_method.h"
#include "report/report_mesh.h"

#include <pcl/surface/floater/vertex_normals.h>

#include <optional>
#include <stdexcept>
#include <utility>

namespace pcl::floater {
Problem
reconstructParts (const Points& points, const Parts& parts, LocalGeometry geometry,
                  const SurfaceSettings& surface_settings, const Request& request,
                  KnownStages* known, Result& result)
{
  const Limits& limits = request.limits;
  const PartsSettings settings{surface_settings,
                               limits.parts,
                               limits.check,
                               limits.uncrossing,
                               removesCrossings (points, request.options),
                               points.diagonal};
  const RunContext& run = request.run;
  const ConsensusLimits& consensus = limits.surface.consensus;
  run.beginStage (Stage::CONSENSUS);
  std::optional<PartWork> work;
  work.emplace (points, parts, geometry,
                known != nullptr ? known->parts (parts)
                                 : sourceOf (points, parts, geometry, consensus.candidates, run),
                consensus, run);
  SurfaceOfParts made = makeSurfaceOfParts (points, parts, *work, settings, run);
  Report& report = result.report;
  CheckedParts& checked = made.checked;
  reportOrientationSeam (points, made.surface.orientation_seam, report);
  report.topology = Topology::SURFACE;
  reportLoops (points, made.surface, report);
  report.statistics.self_intersections_found = checked.crossing.found;
  report.statistics.self_intersection_flips = checked.crossing.done.flips;
  report.statistics.self_intersection_moves = checked.crossing.done.moves;
  report.statistics.self_intersection_rebuilds = checked.crossing.done.rebuilds;

  TriangleMesh mesh;
  mesh.triangles = assembleTriangles (checked.mesh, made.checks, parts, *work, run);
  work.reset ();
  const bool is_stacked = !points.stacked.of.empty ();
  if ((asksForTrimming (request.options.trimming) || is_stacked) && checked.found.isManifold () &&
      !mesh.connect (points.size (), run))
    throw std::logic_error ("the finished parts do not fit");
  std::optional<Points> all;
  if (is_stacked && checked.found.isManifold ()) {
    geometry.stars.normals = vertexNormals (points.positions, mesh.triangles, run.threads ());
    all = addStacked (mesh, points, geometry, request);
    checked.found = examine (mesh, *all, geometry, request);
    uncross (mesh, checked.found, *all, geometry, request, report.statistics);
  }
  return useMesh (std::move (mesh), made.surface.finish, std::move (checked.found),
                  all ? *all : points, geometry, request, result);
}

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruct_parts.h"

#include "finished_mesh.h"
#include "mesh/trimming.h"
#include "parts/local_parts.h"
#include "report/report_mesh.h"

#include <pcl/surface/floater/vertex_normals.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

namespace pcl::floater {
namespace {
// The parts, and the results of their surface so far.
struct PartsInWork
{
  const Parts& parts;
  std::unique_ptr<PartWork> work;
  SurfaceOfParts made;
};

// While this object exists, positions and spacings are freed; the parts hold them.
class LeftToParts
{
public:
  LeftToParts (Points& points, LocalGeometry& geometry, PartWork& work)
      : points_ (points), geometry_ (geometry), work_ (work)
  {
    points.position_elsewhere = [&work] (Index p) {
      return work.valuesOf ({p}).positions.front ();
    };
    points.positions = std::vector<Eigen::Vector3d> ();
    geometry.spacing = std::vector<float> ();
  }
  ~LeftToParts () { points_.position_elsewhere = {}; }
  LeftToParts (const LeftToParts&) = delete;
  LeftToParts& operator= (const LeftToParts&) = delete;
  LeftToParts (LeftToParts&&) = delete;
  LeftToParts& operator= (LeftToParts&&) = delete;

  // Restores positions and spacings.
  void takeBack ()
  {
    PointValues values = valuesOfAll (work_, points_.size ());
    points_.position_elsewhere = {};
    points_.positions = std::move (values.positions);
    geometry_.spacing = std::move (values.spacing);
  }

private:
  Points& points_;
  LocalGeometry& geometry_;
  PartWork& work_;
};

// Assembles the whole mesh from its parts, for example to trim it.
Problem
useAssembled (PartsInWork surface, const Points& points, LocalGeometry& geometry,
              const Request& request, Result& result)
{
  TriangleMesh mesh;
  CheckedParts& checked = surface.made.checked;
  mesh.triangles = assembleTriangles (checked.mesh, surface.made.checks, surface.parts,
                                      *surface.work, request.run);
  surface.work.reset ();
  const bool is_stacked = !points.stacked.of.empty ();
  if ((asksForTrimming (request.options.trimming) || is_stacked) && checked.found.isManifold () &&
      !mesh.connect (points.size (), request.run))
    throw std::logic_error ("the finished parts do not fit");
  if (is_stacked && checked.found.isManifold ()) {
    geometry.stars.normals =
        vertexNormals (points.positions, mesh.triangles, request.run.threads ());
    const Points all = addStacked (mesh, points, geometry, request);
    checked.found = examine (mesh, all, geometry, request);
    uncross (mesh, checked.found, all, geometry, request, result.report.statistics);
    return useMesh (std::move (mesh), surface.made.surface.finish, std::move (checked.found), all,
                    geometry, request, result);
  }
  return useMesh (std::move (mesh), surface.made.surface.finish, std::move (checked.found), points,
                  geometry, request, result);
}

} // namespace

Problem
reconstructParts (Points& points, const Parts& parts, LocalGeometry geometry,
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
  PartsInWork surface{parts, nullptr, {}};
  std::optional<LeftToParts> left;
  if (known != nullptr) {
    surface.work = known->parts (settings);
    left.emplace (points, geometry, *surface.work);
  }
  else
    surface.work = std::make_unique<LocalParts> (points, parts, geometry, settings, request.run);
  surface.made = makeSurfaceOfParts (points, parts, *surface.work, settings, request.run);
  Report& report = result.report;
  const CheckedParts& checked = surface.made.checked;
  reportOrientationSeam (points, surface.made.surface.orientation_seam, report);
  report.topology = Topology::SURFACE;
  reportLoops (points, surface.made.surface, report);
  report.statistics.self_intersections_found = checked.crossing.found;
  report.statistics.self_intersection_flips = checked.crossing.done.flips;
  report.statistics.self_intersection_moves = checked.crossing.done.moves;
  report.statistics.self_intersection_rebuilds = checked.crossing.done.rebuilds;
  if (left && asksForTrimming (request.options.trimming)) {
    left->takeBack ();
    left.reset ();
    known = nullptr;
  }
  if (known == nullptr)
    return useAssembled (std::move (surface), points, geometry, request, result);
  Problem problem = reportFinished (checked.mesh.triangles, surface.made.surface.finish,
                                    checked.found, {}, points, request, report);
  MeshOfParts& mesh = surface.made.checked.mesh;
  mesh.seam = inCloud (points, std::move (mesh.seam));
  known->keepMesh (std::move (mesh));
  return problem;
}

} // namespace pcl::floater

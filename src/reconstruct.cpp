// SPDX-License-Identifier: GPL-3.0-or-later
// The whole way: samples, then a disc laid out in the plane or a surface of any topology out of
// stars, then a last look at the mesh.
#include <pcl/surface/floater/reconstruct.h>

#include "complex/surface_method.h"
#include "disc_method.h"
#include "mesh_check.h"
#include "neighborhoods/stars.h"
#include "report_builder.h"
#include "triangulation/flips.h"
#include "validation.h"

#include <algorithm>
#include <new>
#include <utility>

namespace pcl
{
namespace floater
{
namespace
{
constexpr std::size_t LARGEST_SECOND_TRY = 300'000; // points; a second and half a GB

// Beyond the report: the mesh as it is, on the user's own points, whatever the stages think that
// they made.
Problem
examine (Samples& samples, const std::vector<Triangle>& triangles, const Options& options,
         StageClock& clock, Report& report)
{
  constexpr double AFTER_SPACING = 0.1; // of the time of this stage
  clock.start (Stage::CHECK);
  StageClock::step (AFTER_SPACING);
  if (!samples.noisy.empty ())
    samples.set.positions.swap (samples.noisy);
  const std::vector<float> spacing =
      localSpacing (samples.set.positions, samples.near, options.threads);
  samples.near = {};
  samples.stars = {};
  StageClock::step (1.0);
  const MeshExamination found = checkMesh (triangles, samples.set, spacing);
  report.statistics.folds = found.check.folds;
  return reportCheck (samples.set, found, options, report);
}

// Examines a mesh and makes it the result.
Problem
useMesh (Samples& samples, SurfaceMesh mesh, const SurfaceFinish& finish, const Options& options,
         StageClock& clock, Result& result)
{
  std::vector<Triangle> triangles = std::move (mesh.triangles);
  mesh = {};
  Problem problem = examine (samples, triangles, options, clock, result.report);
  result.triangles = reportMesh (samples.set, std::move (triangles), finish, result.report);
  return problem;
}

Problem
useDisc (Samples& samples, Disc disc, const Options& options, StageClock& clock, Result& result)
{
  result.report.topology = Topology::DISC;
  reportBoundary (samples.set, disc.boundary, result.report);
  if (disc.problem)
    return disc.problem;
  return useMesh (samples, std::move (disc.mesh), disc.finish, options, clock, result);
}

std::size_t
countFlaws (const SurfaceMesh& mesh, const SurfaceFinish& finish)
{
  return finish.folds.size () + static_cast<std::size_t> (std::count (
                                    mesh.triangle_of.begin (), mesh.triangle_of.end (), NONE));
}

double
costOf (const Samples& samples, const SurfaceMesh& mesh, const Options& options)
{
  const std::vector<Eigen::Vector3d>& positions = samples.ownPositions ();
  std::vector<Eigen::Vector3f> normals = samples.stars.normals;
  orientNormals (mesh, positions, normals);
  const std::vector<float> spacing = localSpacing (positions, samples.near, options.threads);
  return meshCost (mesh, TriangleCost (positions, normals, &spacing));
}

// Topology::AUTO: where the surface is one disc but came out with folds or without points, and is
// not too large for a second try, the disc method makes it, too. It is taken if that has fewer of
// these, and is the smoother one.
bool
isDiscBetter (Samples& samples, const Surface& surface, const Options& options, StageClock& clock,
              Report& report, Disc& disc)
{
  const std::size_t flaws = countFlaws (surface.mesh, surface.finish);
  if (options.topology != Topology::AUTO || !surface.is_one_disc || flaws == 0 ||
      samples.set.positions.size () > LARGEST_SECOND_TRY)
    return false;
  const Report before = report;
  StageClock::setMethod (Topology::DISC);
  clock.start (Stage::STARS);
  samples.stars = makeStars (samples.set.positions, samples.near, samples.stars.normals,
                             options.filter_sheets, options.threads);
  disc = makeDisc (samples, options, clock, report);
  clock.stop ();
  if (!disc.problem && countFlaws (disc.mesh, disc.finish) < flaws &&
      costOf (samples, disc.mesh, options) < costOf (samples, surface.mesh, options))
    return true;
  const auto seconds = report.statistics.seconds;
  const double total_seconds = report.statistics.total_seconds;
  report = before;
  report.statistics.seconds = seconds;
  report.statistics.total_seconds = total_seconds;
  return false;
}

Problem
reconstructAny (Input& input, const Options& options, Result& result)
{
  Report& report = result.report;
  report.statistics.cloud_points = input.cloud_size;
  report.statistics.selected_points = input.positions.size ();
  if (Problem problem = checkOptions (options))
    return problem;
  StageClock clock (report.statistics, options.progress);
  if (asksForDisc (options))
    StageClock::setMethod (Topology::DISC);
  Samples samples;
  if (Problem problem = prepareSamples (input, options, clock, samples, report))
    return problem;

  Disc disc;
  if (asksForDisc (options)) {
    report.topology_reason =
        options.topology == Topology::DISC ? "asked for" : "its boundary loop is given";
    disc = makeDisc (samples, options, clock, report);
    return useDisc (samples, std::move (disc), options, clock, result);
  }
  Surface surface = makeSurface (samples, options, clock);
  reportOneSided (samples.set, surface.cut, report);
  if (isDiscBetter (samples, surface, options, clock, report, disc)) {
    report.topology_reason = "one disc, laid out with fewer folds than by stars alone";
    return useDisc (samples, std::move (disc), options, clock, result);
  }
  report.topology = Topology::SURFACE;
  report.statistics.holes_filled = surface.holes_filled;
  return useMesh (samples, std::move (surface.mesh), surface.finish, options, clock, result);
}

} // namespace

Result
reconstruct (Input input, const Options& options)
{
  Result result;
  Problem problem;
  try {
    Monitor monitor (options);
    problem = reconstructAny (input, options, result);
    if (!problem)
      monitor.finish ();
  }
  catch (const Cancelled&) {
    problem = {Status::CANCELLED, "the caller stopped the run"};
  }
  catch (const std::bad_alloc&) {
    problem = {Status::OUT_OF_MEMORY,
               "not enough memory: use fewer points, or a machine with more"};
  }
  catch (const std::exception& error) {
    problem = {Status::INTERNAL_ERROR, std::string ("unexpected error: ") + error.what ()};
  }
  if (problem.status == Status::CANCELLED) {
    Report stopped;
    stopped.statistics = result.report.statistics;
    result.report = std::move (stopped); // nothing that takes memory
  }
  result.report.status = problem.status;
  if (problem) {
    result.triangles = {};
    result.report.message = std::move (problem.message);
  }
  return result;
}

} // namespace floater
} // namespace pcl

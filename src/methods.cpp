// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "methods.h"

#include "core/order_statistics.h"
#include "input/input.h"
#include "mesh/check.h"
#include "mesh/folds.h"
#include "mesh/trimming.h"
#include "mesh/vertex_splits.h"
#include "points/net.h"
#include "report/findings.h"
#include "report/report_cloud.h"
#include "report/report_mesh.h"
#include "view/view_method.h"

namespace pcl::floater {
namespace {
// What a method has made.
struct Draft
{
  TriangleMesh mesh;
  MeshFinish finish;
  std::optional<MeshExamination> found = {}; // of the points that are not set aside, if it is known
};

// Examines the mesh on the input points, independently of earlier stages.
MeshExamination
examine (const TriangleMesh& mesh, const Points& points, const LocalGeometry& geometry,
         const Request& request)
{
  request.run.beginStage (Stage::CHECK);
  return checkMesh (mesh, points, geometry.meshSpacing (), request.run);
}

// Adds the points that were set aside to the mesh, unless the point that stands for them is not in it;
// extends the geometry but for the neighbours, and what was made anew. Returns all points.
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
  splitVertices (mesh, all.positions, added, request.run);
  return all;
}

// Repairs the flaws of a mesh with the points that were set aside; the neighbours go.
// \param points without these points
// \param all    as addStacked () returned it
void
repairSplits (Draft& draft, const Points& points, const Points& all, LocalGeometry& geometry,
              const Request& request)
{
  auto& [mesh, finish, found] = draft;
  finish.crossing = findSelfIntersections (mesh.triangles, all.positions, request.run);
  finish.pairs_found = std::max (finish.pairs_found, finish.crossing->size ());
  if (!repairsFlaws (request.options) ||
      (finish.crossing->empty () && findFolds (mesh, all.positions, request.run).empty ()))
    return;
  // They get the point that stands for them as a neighbour, and its neighbours.
  CsrLists& neighbors = geometry.neighbors;
  std::size_t entries = neighbors.ids.size ();
  for (const Index p : points.stacked.of)
    entries += neighbors.row (p).size () + 1;
  neighbors.ids.reserve (entries); // rows stay where they are
  for (const Index p : points.stacked.of) {
    const Row row = neighbors.row (p);
    neighbors.ids.push_back (p);
    for (const Index q : row)
      neighbors.ids.push_back (q);
    neighbors.offsets.push_back (static_cast<Index> (neighbors.ids.size ()));
  }
  const RepairLimits& limits = request.limits.repair;
  repairMesh (mesh, all.positions, geometry, Repair::AT_THE_END, limits, finish, request.run);
  openCrossings (mesh, all.positions, geometry, limits, finish, request.run);
  neighbors = {};
}

// A mesh that was laid out as a disc is one, and its boundary is the loop.
Problem
checkDisc (const Points& points, const MeshExamination& found, std::vector<Index> loop)
{
  std::vector<Index> border;
  if (found.isManifold () && found.isDisc ())
    border = valuesAt (points.cloud_index, found.loops.front ().points);
  for (std::vector<Index>* one : {&border, &loop})
    std::rotate (one->begin (), std::min_element (one->begin (), one->end ()), one->end ());
  if (border != loop && !loop.empty ())
    std::reverse (loop.begin () + 1, loop.end ());
  return border == loop ? Problem{}
                        : Problem{RunStatus::INTERNAL_ERROR,
                                  "the result is not one manifold disc within the boundary loop; "
                                  "please report this with the cloud"};
}

// Points that a view leaves out, also those alone between rays.
void
reportLeftOut (const Points& points, const MeshExamination& found, const LocalGeometry& geometry,
               const Request& request, Report& report)
{
  if (request.options.remove_outliers) {
    report.statistics.working_points = points.size () - found.unused.size ();
    reportOutliers (valuesAt (points.cloud_index, found.unused), FindingId::OUTLIERS, report);
  }
  reportCoordinateGrid (points, findCoordinateGrid (points, geometry.meshSpacing ()), report);
}

// The end of every method: adds the points that were set aside, examines, trims, reports.
// \return INTERNAL_ERROR unless it is an oriented manifold, DEGENERATE if no triangle is left
Problem
useMesh (Draft draft, const Points& given, LocalGeometry geometry, const Request& request,
         Result& result)
{
  Report& report = result.report;
  TriangleMesh& mesh = draft.mesh;
  std::optional<Points> all;
  if (!given.stacked.of.empty ()) {
    all = addStacked (mesh, given, geometry, draft.finish, request);
    if (!report.is_view)
      repairSplits (draft, given, *all, geometry, request);
  }
  const Points& points = all ? *all : given;
  MeshExamination found =
      draft.found && !all ? std::move (*draft.found) : examine (mesh, points, geometry, request);
  if (report.is_view) // noise along the rays makes true surfaces cross themselves
    reportLeftOut (points, found, geometry, request, report);
  else
    checkCrossing (mesh.triangles, points, request.run, found, std::move (draft.finish.crossing));
  if (report.topology == Topology::DISC)
    if (Problem problem = checkDisc (points, found, report.loop))
      return problem;
  if (mesh.triangles.empty ())
    return {RunStatus::DEGENERATE,
            "no three points make a triangle of a surface: they lie along lines or curves, or each "
            "on its own; a surface needs points side by side"};
  report.statistics.self_intersections_found =
      std::max (draft.finish.pairs_found, found.crossing.size ());
  Trimming trimming;
  if (asksForTrimming (request.options.trimming) && found.isManifold ()) {
    trimming =
        trimMesh (mesh, points, geometry.meshSpacing (), request.options.trimming, request.run);
    // Without points that trimming leaves unused.
    std::vector<Index> unused = std::move (found.unused);
    found = examine (mesh, points, geometry, request);
    if (!report.is_view)
      checkCrossing (mesh.triangles, points, request.run, found);
    found.unused = std::move (unused);
    if (trimming.triangles > 0)
      report.loop.clear ();
  }
  result.triangles = std::move (mesh.triangles);
  mesh = {};
  Problem problem =
      reportMesh (points, result.triangles, found, draft.finish, trimming, request.options, report);
  for (Triangle& triangle : result.triangles)
    for (Index& p : triangle)
      p = points.cloud_index[p];
  return problem;
}

// The longest boundary loop of the surface that the stars make, of a net if points lie on others.
Boundary
loopOfSurface (const Points& points, LocalGeometry geometry, const Request& request)
{
  const RunContext run = request.run.withinStage ();
  const NeighborSettings neighbors{request.options.neighbors};
  Points net = points;
  net.projected = {};
  chooseNet (net, geometry.neighbors, neighbors, run, nullptr);
  if (net.stacked.of.empty ())
    net.projected = points.projected;
  else {
    const StarSettings stars = starSettings (request.options);
    LocalPlanes planes = beginPlanes (net, std::move (geometry.neighbors), {}, stars, run);
    planes = fitLocalPlanes (net, std::move (planes), stars, run);
    geometry = makeLocalGeometry (net, std::move (planes), stars, run);
  }
  HoleOptions holes;
  holes.policy = HolePolicy::KEEP_LARGEST;
  Boundary boundary;
  double longest = 0.0;
  for (std::vector<Index>& loop :
       boundaryLoops (makeSurface (net, geometry, holes, {}, run).mesh, run)) {
    boundary.candidates += loop.size ();
    const double length = perimeter (net.positions, loop);
    if (length > longest) {
      longest = length;
      boundary.loop = std::move (loop);
    }
  }
  std::vector<Index> of_net (net.size ()); // points, in the same order
  for (Index p = 0, kept = 0; kept < of_net.size (); ++p)
    if (points.cloud_index[p] == net.cloud_index[kept])
      of_net[kept++] = p;
  boundary.loop = valuesAt (of_net, boundary.loop);
  return boundary;
}

// TW 385, section 3: boundary points as one ordered loop.
Boundary
findLoop (const Points& points, const LocalGeometry& geometry, const Request& request)
{
  const BoundaryOptions& options = request.options.disc.boundary;
  request.run.beginStage (Stage::BOUNDARY);
  const bool is_given = !options.loop.empty ();
  Boundary boundary = is_given ? givenLoop (points, options.loop)
                      : options.method == BoundaryMethod::TWO_SEGMENTS
                          ? publishedLoop (points, geometry, options, request.run)
                          : loopOfSurface (points, geometry, request);
  checkBoundary (points, geometry.spacing, is_given, boundary);
  return boundary;
}

// Unused points at depth steps, which contradict the view; not those alone in gaps, nor those on
// what bears the sensor, which are no part of the scene.
std::size_t
countContradictions (const Points& points, const Viewpoint& viewpoint, const ViewSurface& surface,
                     const std::vector<Index>& unused)
{
  std::vector<double> depths;
  for (const Vector3d& position : points.positions)
    depths.push_back (rayTo (position, viewpoint).depth);
  const double least =
      viewpoint.is_far ? -std::numeric_limits<double>::infinity () : AT_SENSOR * median (depths);
  return std::count_if (unused.begin (), unused.end (), [&] (Index p) {
    return surface.is_at_step[p] != 0 && rayTo (points.positions[p], viewpoint).depth >= least;
  });
}

// Evidence for the front of a component, as the options ask for it. Refers to the normals of the points.
FacingHints
facingHints (const Points& points, const Request& request)
{
  FacingHints hints;
  hints.wanted = request.options.facing;
  if (!points.facing_normals.empty () &&
      (hints.wanted == Facing::AUTO || hints.wanted == Facing::NORMALS))
    hints.normals = &points.facing_normals;
  const bool may_be_seen =
      request.options.view.use != ViewUse::NEVER || hints.wanted == Facing::VIEWPOINT;
  if (may_be_seen && isSensorKnown (request.sensor_origin))
    hints.sensor = points.fromCloud (request.sensor_origin);
  return hints;
}

// How a disc or a surface is finished, as the options ask for it.
FinishSettings
finishSettings (const Points& points, const Request& request)
{
  FinishSettings settings;
  settings.flip_edges = request.options.flip_edges;
  settings.limits = request.limits.repair;
  settings.facing = facingHints (points, request);
  settings.repair = repairsFlaws (request.options);
  return settings;
}

} // namespace

Problem
reconstructDisc (const Points& points, LocalGeometry geometry, const Request& request,
                 Result& result)
{
  const Options& options = request.options;
  result.report.topology = Topology::DISC;
  result.report.topology_reason = options.disc.as_published ? "the method of TW 385 is asked for"
                                  : options.topology == Topology::DISC
                                      ? "asked for"
                                      : "its boundary loop is given";
  Disc disc = makeDisc (points, geometry, findLoop (points, geometry, request), options,
                        finishSettings (points, request), request.run);
  reportDisc (points, disc, result.report);
  if (disc.problem)
    return disc.problem;
  return useMesh ({std::move (disc.mesh), std::move (disc.finish)}, points, std::move (geometry),
                  request, result);
}

Problem
reconstructSurface (const Points& points, LocalGeometry geometry, const Request& request,
                    Result& result)
{
  Surface surface = makeSurface (points, geometry, request.options.holes,
                                 finishSettings (points, request), request.run);
  result.report.topology = Topology::SURFACE;
  reportLoops (points, surface, result.report);
  return useMesh ({std::move (surface.mesh), std::move (surface.finish)}, points,
                  std::move (geometry), request, result);
}

std::optional<Problem>
reconstructView (const Points& points, const Viewpoint& viewpoint, const Request& request,
                 Result& result)
{
  // Share of the points; if more are in no triangle, at depth steps, the cloud is not a scan of
  // surfaces from there. Of a scan by 16 rings, 0.06 are: things as high as one ring are no
  // surface; of scans from a moving car, up to 0.10; of a raster of heights with missing ones, 0.2.
  constexpr double UNUSED = 0.15;
  // The same, of all unused points, also those alone in gaps. Measured: at most 0.15 in generated
  // scans, 0.21 in a real one of 32 rings; 0.37 in profiles far apart.
  constexpr double UNUSED_IN_ALL = 0.25;
  // UNUSED if only the file or outlines tell the viewpoint. Scans from several places, of which it
  // tells one, have 0.013 to 0.035.
  constexpr double UNUSED_IF_TOLD = 0.01;
  const Options& options = request.options;
  ViewSurface surface = makeViewSurface (points, viewpoint, options, request.limits.view,
                                         facingHints (points, request), request.run);
  LocalGeometry geometry;
  geometry.spacing = std::move (surface.spacing);
  MeshExamination found = examine (surface.mesh, points, geometry, request);
  const bool is_given = options.view.use == ViewUse::GIVEN;
  const auto isMoreThan = [&points] (double share, std::size_t count) {
    return static_cast<double> (count) > share * static_cast<double> (points.size ());
  };
  const double most_unused = viewpoint.is_only_told ? UNUSED_IF_TOLD : UNUSED;
  const bool is_doubtful = isMoreThan (most_unused, found.unused.size ());
  if (!is_given && is_doubtful &&
      (isMoreThan (UNUSED_IN_ALL, found.unused.size ()) ||
       isMoreThan (most_unused, countContradictions (points, viewpoint, surface, found.unused))))
    return {};
  if (surface.mesh.triangles.empty ())
    return Problem{RunStatus::INVALID_OPTION,
                   "no triangle is left of the view from the given viewpoint: the points hide each "
                   "other, or lie on one line as seen from there; give the place of the sensor, or "
                   "none"};
  result.report.topology = Topology::SURFACE;
  reportView (points, viewpoint, surface, result.report);
  if (is_doubtful && is_given) // so no points are set aside
    addFinding (result.report, FindingId::DOUBTFUL_VIEWPOINT, points, {}, found.unused.size (),
                points.size ());
  return useMesh ({std::move (surface.mesh), std::move (surface.finish), std::move (found)}, points,
                  std::move (geometry), request, result);
}
} // namespace pcl::floater

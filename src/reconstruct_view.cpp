// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruct_view.h"

#include "cloud_geometry.h"
#include "core/order_statistics.h"
#include "finished_mesh.h"
#include "input/input.h"
#include "mesh/check.h"
#include "report/findings.h"
#include "report/report_cloud.h"
#include "view/view_method.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace pcl::floater {
std::optional<Viewpoint>
knownViewpoint (const Points& points, const Request& request)
{
  const ViewOptions& options = request.options.view;
  const bool is_given = options.use == ViewUse::GIVEN;
  const std::array<double, 3>& place = is_given ? options.viewpoint : request.sensor_origin;
  const Viewpoint viewpoint{
      (Eigen::Map<const Eigen::Vector3d> (place.data ()) - points.centre) / points.scale, false};
  const EvidenceLimits& evidence = request.limits.view.evidence;
  if (is_given || isSeenFrom (points, viewpoint, evidence, request.run))
    return viewpoint;
  if (isSensorKnown (request.sensor_origin) &&
      mayBeSeenFrom (points.positions, viewpoint, evidence, request.run))
    return Viewpoint{viewpoint.place, false, true};
  return {};
}

namespace {
// If the points are not evenly spaced as seen from the given viewpoint, but are from another one:
// that one. The given one is then likely to be wrong. First the sensor origin in the file is
// tried, then a viewpoint is searched. No result for clouds that are even from nowhere, such as a
// scan that was thinned at random. 0.1 microseconds per point if the given viewpoint is right,
// otherwise the time of a search.
std::optional<Viewpoint>
contradictingViewpoint (const Points& points, const Viewpoint& given, const Request& request)
{
  const RunContext& run = request.run;
  const SearchLimits& search = request.limits.view.search;
  const EvidenceLimits& evidence = request.limits.view.evidence;
  const auto isSeen = [&] (const Viewpoint& viewpoint) {
    return isSeenFrom (points, viewpoint, evidence, run);
  };
  if (isSeen (given))
    return {};
  const Eigen::Map<const Eigen::Vector3d> origin (request.sensor_origin.data ());
  const Viewpoint of_file{(origin - points.centre) / points.scale, false};
  if (isSensorKnown (request.sensor_origin) && isSeen (of_file))
    return of_file;
  const LocalPlanes planes =
      findPlanes (points, neighborSettings (request.options, nullptr), request);
  const auto find = [&] (const std::vector<AreaSample>& samples, SearchReason reason) {
    return findViewpoint (points, planes.neighbors, samples, reason, search, evidence, run);
  };
  const std::optional<Viewpoint> found =
      find (takeAreaSamples (points, planes, starSettings (request), search.samples, run),
            SearchReason::UNEVEN);
  return found ? found
               : find (takePatchSamples (points.positions, planes.neighbors, search.samples),
                       SearchReason::NOISE);
}

// Unused points at depth steps, which contradict the view; not those alone in gaps, nor those on
// what bears the sensor, which are no part of the scene.
std::size_t
countContradictions (const Points& points, const Viewpoint& viewpoint, const ViewSurface& surface,
                     const std::vector<Index>& unused, const EvidenceLimits& limits)
{
  std::vector<double> depths;
  for (const Eigen::Vector3d& position : points.positions)
    depths.push_back (rayTo (position, viewpoint).depth);
  const double least = viewpoint.is_far ? -std::numeric_limits<double>::infinity ()
                                        : limits.at_sensor * median (depths);
  return static_cast<std::size_t> (std::count_if (unused.begin (), unused.end (), [&] (Index p) {
    return surface.is_at_step[p] != 0 && rayTo (points.positions[p], viewpoint).depth >= least;
  }));
}

} // namespace

std::optional<Problem>
reconstructView (const Points& points, const Viewpoint& viewpoint, const Request& request,
                 Result& result)
{
  const Options& options = request.options;
  const Limits& limits = request.limits;
  ViewSurface surface = makeViewSurface (points, viewpoint, {options, limits.view, limits.surface},
                                         facingHints (points, request), request.run);
  LocalGeometry geometry;
  geometry.spacing = std::move (surface.spacing);
  MeshExamination found = examine (surface.mesh, points, geometry, request);
  const double most_unused = (viewpoint.is_only_told ? limits.view.largest_unused_if_told
                                                     : limits.view.largest_unused_share) *
                             static_cast<double> (points.size ());
  const bool is_doubtful = static_cast<double> (found.unused.size ()) > most_unused;
  if (options.view.use != ViewUse::GIVEN && is_doubtful &&
      (static_cast<double> (found.unused.size ()) >
           limits.view.largest_unused_in_all * static_cast<double> (points.size ()) ||
       static_cast<double> (countContradictions (points, viewpoint, surface, found.unused,
                                                 limits.view.evidence)) > most_unused))
    return {};
  if (surface.mesh.triangles.empty ())
    return Problem{RunStatus::INVALID_OPTION,
                   "no triangle is left of the view from the given viewpoint: the points hide each "
                   "other, or lie on one line as seen from there; give the place of the sensor, or "
                   "none"};
  Report& report = result.report;
  report.topology = Topology::SURFACE;
  reportView (points, viewpoint, surface, report);
  std::optional<Points> all;
  if (!points.stacked.of.empty ()) {
    all = addStacked (surface.mesh, points, geometry, surface.finish, request);
    found = examine (surface.mesh, *all, geometry, request);
  }
  const Points& vertices = all ? *all : points;
  if (is_doubtful && options.view.use == ViewUse::GIVEN)
    addFinding (report, FindingId::DOUBTFUL_VIEWPOINT, vertices, {}, found.unused.size (),
                vertices.size ());
  if (options.remove_outliers) { // also those alone between rays
    report.statistics.working_points = vertices.size () - found.unused.size ();
    reportOutliers (valuesAt (vertices.cloud_index, found.unused), FindingId::OUTLIERS, report);
  }
  reportCoordinateGrid (
      vertices, findCoordinateGrid (vertices, geometry.meshSpacing (), request.run), report);
  return useMesh (std::move (surface.mesh), surface.finish, std::move (found), vertices, geometry,
                  request, result);
}

std::optional<Problem>
reconstructKnownView (const Points& points, const Viewpoint& viewpoint, const Request& request,
                      Result& result)
{
  std::optional<Viewpoint> other;
  if (request.options.view.use == ViewUse::GIVEN)
    other = contradictingViewpoint (points, viewpoint, request);
  std::optional<Problem> problem = reconstructView (points, viewpoint, request, result);
  if (problem && !*problem && other)
    reportOtherViewpoint (points, *other, result.report);
  return problem;
}

} // namespace pcl::floater

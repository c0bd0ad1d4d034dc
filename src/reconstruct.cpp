// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The pipeline of a cloud: points, neighbours, outliers, noise, local geometry; then a disc laid
// out in the plane, or a surface of any topology from stars; then one check. A scan whose viewpoint
// is known is connected as its sensor saw it, without neighbours.
#include "reconstruct.h"

#include "input/input.h"
#include "local/no_surface.h"
#include "mesh/two_sides.h"
#include "methods.h"
#include "options/check_options.h"
#include "points/outliers.h"
#include "report/findings.h"
#include "report/report_cloud.h"
#include "report/report_mesh.h"

namespace pcl::floater {
namespace {
// Of isStrong (). Generated boxes and sheets 2 spacings apart have up to 0.028, surfaces with noise
// of 0.3 spacings 0.07, of 0.5 spacings 0.18. Clean clouds of the benchmark have at most 0.020, its
// depth cameras at least 0.038. Chosen between these: close to both, and not certain.
constexpr double DISTURBED = 0.035;
// The same share, from which on a cloud is too noisy for any mesh through its points, if projection
// explains it nowhere: noise of 2 spacings has 0.23 or more. Clouds with a mesh have up to 0.15.
constexpr double HOPELESS = 0.2;
constexpr std::size_t NEARLY_ALL = 9; // times as many points of scatter as others

// Whether stars are open as along the border of a sheet. A square has four times as many points on
// it as the root of all, and a third of their stars are open: the others reach back. Half a ball has
// two and a half times as many, and a sixth of their stars: 0.4 times the root. A little more than half
// of that.
bool
isOpen (const Stars& stars)
{
  const double open = std::count (stars.open.begin (), stars.open.end (), 1);
  return 16.0 * open * open >= stars.open.size ();
}

// Whether points have to be projected before they are connected: enough are noisy, and their stars
// disagree. At creases and thin sheets of clean clouds points look noisy, but their stars agree.
// O(n).
// \param agreement of the star of each point, see starAgreement
// \param disturbed_share mean, over all points, of the share of a noisy point's star neighbours
//     that do not have it in their stars
bool
isStrong (const Noise& noise, const std::vector<float>& agreement, double disturbed_share)
{
  double disturbed = 0.0;
  for (std::size_t p = 0; p < agreement.size (); ++p)
    if (noise.at_point[p] > 0.0F)
      disturbed += 1.0 - static_cast<double> (agreement[p]);
  return disturbed >= disturbed_share * static_cast<double> (agreement.size ());
}

// The points that are not on the user's loop. Equal points are represented by one of them.
std::vector<Index>
exceptLoop (std::vector<Index> found, const Points& points, const Options& options)
{
  std::vector<Index> loop = options.disc.boundary.loop;
  for (Index& index : loop) {
    const auto duplicate = std::lower_bound (points.duplicates.begin (), points.duplicates.end (),
                                             std::array<Index, 2>{index, 0});
    if (duplicate != points.duplicates.end () && (*duplicate)[0] == index)
      index = (*duplicate)[1];
  }
  std::sort (loop.begin (), loop.end ());
  const auto is_given = [&] (Index p) {
    return std::binary_search (loop.begin (), loop.end (), points.cloud_index[p]);
  };
  found.erase (std::remove_if (found.begin (), found.end (), is_given), found.end ());
  return found;
}

// DEGENERATE if the cloud is curves that are too far apart for a surface.
Problem
checkCurves (const Points& points, const LocalGeometry& geometry, const Request& request)
{
  const std::optional<double> times =
      findCurves (points.positions, points.fromCloud (request.origin), geometry,
                  static_cast<std::size_t> (request.options.neighbors.k), request.run);
  if (!times)
    return {};
  const std::string apart =
      *times > 0.0 ? "about " + rounded (*times) + " times as far apart as the points along them"
                   : "too far apart";
  return {RunStatus::DEGENERATE,
          "the points lie along curves, such as profiles of a scanner, " + apart +
              ": for a surface, profiles should be at most 10 times as far apart as their points. "
              "Take more profiles, or fewer points of each (a voxel grid thins them out)"};
}

// The neighbours of all points, and their spacing, for fitLocalPlanes ().
LocalPlanes
searchPlanes (const Points& points, const NeighborSettings& settings, const Request& request)
{
  const RunContext& run = request.run;
  run.beginStage (Stage::NEIGHBORS);
  std::optional<KdTree> tree; // searched again for the stars of a surface
  CsrLists neighbors =
      findNeighbors (points, settings, run, asksForDisc (request.options) ? nullptr : &tree);
  run.beginStage (Stage::STARS);
  return beginPlanes (points, std::move (neighbors), std::move (tree),
                      starSettings (request.options), run);
}

// Beyond TW 385: projects noisy points on local planes, by which they are connected, where noise
// explains the disagreement of their stars. The vertices stay the user's points.
// \param noise in: to project; out: of the projected points
// \return the geometry around each projected point
LocalGeometry
projectNoise (Points& points, LocalGeometry geometry, Noise& noise,
              const NeighborSettings& settings, const Request& request)
{
  const RunContext& run = request.run;
  points.projected = projectNoisyPoints (points.positions, geometry.neighbors, noise, run);
  const StarSettings stars = starSettings (request.options);
  LocalPlanes planes =
      fitLocalPlanes (points, searchPlanes (points, settings, request), stars, run);
  LocalGeometry projected = makeLocalGeometry (points, std::move (planes), stars, run);
  keepExplained (projected.neighbors, starAgreement (geometry.stars, run),
                 starAgreement (projected.stars, run), noise);
  if (noise.noisy_points == 0) {
    points.projected.clear ();
    return geometry;
  }
  std::vector<Index> taken_back;
  for (Index p = 0; p < points.size (); ++p)
    if (noise.at_point[p] <= 0.0F && points.projected[p] != points.positions[p]) {
      points.projected[p] = points.positions[p];
      taken_back.push_back (p);
    }
  if (!taken_back.empty ())
    copyRows (geometry, taken_back, projected);
  return projected;
}

// If the points are not evenly spaced as seen from the given viewpoint, but are from another one:
// that one. The given one is then likely to be wrong. First the sensor origin in the file is
// tried, then a viewpoint is searched. No result for clouds that are even from nowhere, such as a
// scan that was thinned at random.
std::optional<Viewpoint>
contradictingViewpoint (const Points& points, const Viewpoint& given, const Request& request)
{
  const RunContext& run = request.run;
  const auto isSeen = [&] (const Viewpoint& viewpoint) {
    return sightFrom (points, viewpoint, false, run) != Sight::NO;
  };
  if (isSeen (given))
    return {};
  const Viewpoint of_file{points.fromCloud (request.sensor_origin)};
  if (isSensorKnown (request.sensor_origin) && isSeen (of_file))
    return of_file;
  const LocalPlanes planes = searchPlanes (points, {request.options.neighbors}, request);
  const RowOf row_of = rowsBeside (points, planes);
  const std::vector<AreaSample> samples = takePatchSamples (points.positions, row_of);
  for (const SearchReason reason : {SearchReason::UNEVEN, SearchReason::OPEN})
    if (const std::optional<Viewpoint> found = findViewpoint (points, row_of, samples, reason, run))
      return found;
  return {};
}

// Like reconstructView (), for the given viewpoint, or the origin of the sensor if the points are evenly
// spaced from there; nothing if there is none. Warns if a given one may be wrong.
std::optional<Problem>
reconstructKnownView (const Points& points, const Request& request, Result& result)
{
  const ViewOptions& options = request.options.view;
  const bool is_given = options.use == ViewUse::GIVEN;
  const bool is_told = isSensorKnown (request.sensor_origin);
  Viewpoint viewpoint{points.fromCloud (is_given  ? options.viewpoint
                                        : is_told ? request.sensor_origin
                                                  : request.origin)};
  std::optional<Viewpoint> other;
  if (is_given)
    other = contradictingViewpoint (points, viewpoint, request);
  else {
    const Sight sight = sightFrom (points, viewpoint, is_told, request.run);
    if (sight == Sight::NO)
      return {};
    viewpoint.is_only_told = sight == Sight::POSSIBLE;
  }
  std::optional<Problem> problem = reconstructView (points, viewpoint, request, result);
  if (problem && !*problem && other)
    reportOtherViewpoint (points, *other, result.report);
  return problem;
}

// Reconstructs a cloud whose viewpoint is unknown, or that is not a single scan.
Problem
reconstructByNeighbors (Points& points, NeighborSearch* searcher, const Request& request,
                        KnownStages* known, Result& result)
{
  const Options& options = request.options;
  const RunContext& run = request.run;
  Report& report = result.report;
  const bool as_disc = asksForDisc (options), may_be_seen = mayBeSeen (options);
  run.beginStage (Stage::NEIGHBORS);
  const NeighborSettings settings{options.neighbors, searcher};
  std::optional<KdTree> tree; // searched again for the stars of a surface
  CsrLists neighbors = known != nullptr
                           ? known->neighborsOfStacks ()
                           : findNeighbors (points, settings, run, as_disc ? nullptr : &tree);
  if (!as_disc && neighbors.rows () > 0)
    reportStacks (points, chooseNet (points, neighbors, settings, run, &tree), report);
  if (known != nullptr) { // the others will be those of its planes
    neighbors = {};
    tree.reset ();
  }
  std::vector<Index> outliers;
  if (known != nullptr)
    outliers = known->outliers ();
  else if (options.remove_outliers)
    outliers = exceptLoop (findOutliers (points.positions, neighbors, run), points, options);
  if (!outliers.empty ()) {
    reportOutliers (removePoints (points, outliers), FindingId::OUTLIERS, report);
    report.statistics.working_points = points.total ();
    if (known == nullptr)
      neighbors = renewNeighbors (points, outliers, neighbors, settings, run);
    tree.reset ();
  }
  if (Problem problem = checkPoints (points))
    return problem;
  run.beginStage (Stage::STARS);
  const StarSettings stars = starSettings (options);
  LocalPlanes planes =
      known != nullptr ? known->planes ()
                       : beginPlanes (points, std::move (neighbors), std::move (tree), stars, run);
  std::vector<AreaSample> samples;
  const auto reconstructFrom = [&] (const RowOf& row_of, SearchReason reason) {
    const std::optional<Viewpoint> viewpoint = findViewpoint (points, row_of, samples, reason, run);
    return viewpoint ? reconstructView (points, *viewpoint, request, result) : std::nullopt;
  };
  std::optional<Stars> begun;
  if (known != nullptr)
    begun = known->begunStars ();
  if (may_be_seen) {
    const RowOf row_of = rowsBeside (points, planes);
    samples = takePatchSamples (points.positions, row_of);
    if (const std::optional<Problem> problem = reconstructFrom (row_of, SearchReason::UNEVEN))
      return *problem;
  }
  if (known == nullptr)
    planes = fitLocalPlanes (points, std::move (planes), stars, run);
  const bool is_certain = options.scatter == ScatterPolicy::AUTO; // what is dropped as scatter
  const bool drops_scatter = options.scatter == ScatterPolicy::DROP || (is_certain && !as_disc);
  Noise noise;
  if (options.denoise || drops_scatter)
    noise = measureNoise (points.positions, planes.neighbors, run);
  LocalGeometry geometry =
      makeLocalGeometry (points, std::move (planes), stars, run, std::move (begun));
  if (stars.reach_beyond)
    if (Problem problem = checkCurves (points, geometry, request))
      return problem;
  const auto isStrongNow = [&] (double disturbed_share) {
    return options.denoise && noise.noisy_points > 0 &&
           isStrong (noise, starAgreement (geometry.stars, run), disturbed_share);
  };
  bool is_strong = isStrongNow (DISTURBED);
  std::vector<Index> scatter;
  if (options.denoise || drops_scatter)
    scatter = findScatter (geometry, noise, is_certain, run);
  if (is_certain && areOnTwoSides (points.positions, scatter, geometry.neighbors, run))
    scatter.clear (); // thin fins, several of them in a neighbourhood
  if (drops_scatter)
    scatter = exceptLoop (std::move (scatter), points, options);
  // Errors along rays look like noise and scatter; of what is open, the sensor tells the front.
  const bool looks_noisy = is_strong || !scatter.empty ();
  if (may_be_seen && (looks_noisy || isOpen (geometry.stars)))
    if (const std::optional<Problem> problem = reconstructFrom (
            [&] (Index p) { return geometry.neighbors.row (p); }, SearchReason::OPEN))
      return *problem;
  reportScatter (points, scatter, drops_scatter && is_certain, report);
  if (drops_scatter && !scatter.empty ()) {
    removePoints (points, scatter);
    report.statistics.working_points = points.total ();
    geometry = {};
    if (checkPoints (points) || scatter.size () >= NEARLY_ALL * points.size ())
      return {RunStatus::DEGENERATE,
              "the cloud is no surface: " + counted (scatter.size (), "point lies", "points lie") +
                  " on none at any scale, such as leaves, a solid, or a scan with errors of more "
                  "than its spacing, and only " +
                  std::to_string (points.size ()) +
                  " on one; take a part that is a surface, smooth the cloud or thin it by a voxel "
                  "grid, use a method that smooths, such as Poisson reconstruction, or keep the "
                  "scatter"};
    planes = fitLocalPlanes (points, searchPlanes (points, settings, request), stars, run);
    noise = measureNoise (points.positions, planes.neighbors, run);
    geometry = makeLocalGeometry (points, std::move (planes), stars, run);
    is_strong = isStrongNow (DISTURBED);
  }
  if (!options.denoise)
    noise = {};
  if (is_strong) {
    const bool may_be_hopeless = isStrongNow (HOPELESS);
    geometry = projectNoise (points, std::move (geometry), noise, settings, request);
    if (may_be_hopeless && noise.noisy_points == 0)
      return {RunStatus::DEGENERATE,
              "the points are too noisy for a mesh that goes through them, by more than their "
              "spacing: smooth the cloud, thin it by a voxel grid, or use a method that smooths, "
              "such as Poisson reconstruction; denoise off connects them nevertheless"};
  }
  reportNoise (noise, is_strong && noise.noisy_points > 0, report);
  noise = {};
  reportCoordinateGrid (points, findCoordinateGrid (points, geometry.meshSpacing ()), report);

  if (as_disc)
    return reconstructDisc (points, std::move (geometry), request, result);
  return reconstructSurface (points, std::move (geometry), request, result);
}

Problem
reconstructAny (Input& input, const Request& request, KnownStages* known, Result& result)
{
  const Options& options = request.options;
  Report& report = result.report;
  Points points;
  if (known != nullptr)
    points = known->points (report);
  else if (Problem problem = takePoints (input, options, request.run, points, report))
    return problem;
  if (Problem problem = checkPoints (points))
    return problem;

  if (mayBeSeen (options))
    if (const std::optional<Problem> problem = reconstructKnownView (points, request, result))
      return *problem;
  return reconstructByNeighbors (points, input.search, request, known, result);
}

} // namespace

Result
reconstruct (Input input, const Options& options, const Limits& limits, KnownStages* known)
{
  Result result;
  Problem problem;
  try {
    const Options effective = effectiveOptions (options);
    RunMonitor monitor (
        {options.stage_callback, options.progress_callback, options.cancelled_callback},
        result.report.statistics, asksForDisc (effective));
    const RunContext context (options.threads, &monitor);
    const bool has_plane_normals = !input.normals.empty ();
    const auto [x, y, z] = input.shift;
    const Request request{effective, limits, context, input.sensor_origin, {-x, -y, -z}};
    problem = reconstructAny (input, request, known, result);
    describeFindings (result.report);
    if (!problem) {
      for (std::string& unused : describeUnusedOptions (options, result.report, has_plane_normals))
        result.report.warnings.push_back (std::move (unused));
      result.report.verdict = judge (result.report);
      monitor.finish ();
    }
  }
  catch (...) {
    problem = problemOfException ();
    if (known != nullptr && problem.status == RunStatus::INTERNAL_ERROR)
      throw; // of the stages that are known elsewhere: their owner knows its kind
  }
  if (problem.status == RunStatus::CANCELLED) {
    Report cancelled;
    cancelled.statistics = result.report.statistics;
    result.report = std::move (cancelled); // must not allocate memory
  }
  result.report.status = problem.status;
  if (problem) {
    result.triangles = {};
    result.report.message = std::move (problem.message);
  }
  return result;
}

Result
reconstruct (Input input, const Options& options)
{
  return reconstruct (std::move (input), options, Limits{});
}

Result
reconstruct (Positions positions, const Options& options)
{
  Problem problem;
  try {
    if (positions.empty ())
      problem = {RunStatus::NO_INPUT, "the input cloud is empty"};
    else if (positions.size () > std::numeric_limits<Index>::max ())
      problem = {RunStatus::OUT_OF_MEMORY,
                 "the cloud has more than 4294967295 points; reconstruct parts of it"};
    else {
      Input input;
      input.cloud_size = positions.size ();
      input.cloud_index = indicesBelow (positions.size ());
      input.positions = std::move (positions);
      return reconstruct (std::move (input), options);
    }
  }
  catch (...) {
    problem = problemOfException ();
  }
  Result failed;
  failed.report.status = problem.status;
  failed.report.message = std::move (problem.message);
  return failed;
}

} // namespace pcl::floater

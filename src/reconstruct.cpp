// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The pipeline of a cloud: points, neighbours, outliers, noise, local geometry; then a disc laid
// out in the plane, or a surface of any topology from stars; then one check. A scan whose viewpoint
// is known is connected as its sensor saw it, without neighbours.
#include "reconstruct.h"

#include "cloud_geometry.h"
#include "input/input.h"
#include "local/stars.h"
#include "methods.h"
#include "options/check_options.h"
#include "report/findings.h"
#include "report/report_cloud.h"
#include "report/verdict.h"

namespace pcl::floater {
namespace {
// Of isStrong (). Generated boxes and sheets 2 spacings apart have up to 0.028, surfaces with noise
// of 0.3 spacings 0.07, of 0.5 spacings 0.18. Clean clouds of the benchmark have at most 0.020, its
// depth cameras at least 0.038. Chosen between these: close to both, and not certain.
constexpr double DISTURBED = 0.035;
// The same share, from which on a cloud is too noisy for any mesh through its points, if projection
// explains it nowhere: noise of 2 spacings has 0.23 or more. Clouds that make a mesh without
// projection have up to 0.15.
constexpr double HOPELESS = 0.2;
constexpr std::size_t NEARLY_ALL = 9; // times as many points of scatter as others

// Whether stars are open as along the border of a sheet. A square has four times as many points on
// it as the root of all, and a third of their stars are open: the others reach back. Half a ball has
// two and a half times as many, and a sixth of their stars: 0.4 times the root. A little more than half
// of that.
bool
isOpen (const Stars& stars)
{
  const auto open = static_cast<double> (
      std::count_if (stars.open.begin (), stars.open.end (), [] (auto is) { return is != 0; }));
  return 16.0 * open * open >= static_cast<double> (stars.open.size ());
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
  const std::vector<Index> outliers =
      known != nullptr ? known->outliers () : outliersOf (points, neighbors, request);
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
  const StarSettings stars = starSettings (request);
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
  const bool is_measured = options.denoise || dropsScatter (options);
  Noise noise;
  if (is_measured)
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
  noise.is_strong = isStrongNow (DISTURBED);
  const std::vector<Index> scatter =
      is_measured ? scatterOf (points, geometry, noise, request) : std::vector<Index>{};
  // Errors along the rays of a scan look like noise and scatter; of what is open, the sensor tells
  // the front.
  const bool looks_noisy = noise.is_strong || !scatter.empty ();
  if (may_be_seen && (looks_noisy || isOpen (geometry.stars)))
    if (const std::optional<Problem> problem = reconstructFrom (
            [&] (Index p) { return geometry.neighbors.row (p); }, SearchReason::OPEN))
      return *problem;
  if (takeScatter (points, scatter, options, report)) {
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
    noise.is_strong = isStrongNow (DISTURBED);
  }
  if (!options.denoise)
    noise = {};
  if (noise.is_strong) {
    const bool may_be_hopeless = isStrongNow (HOPELESS);
    geometry = projectNoise (points, std::move (geometry), noise, settings, request);
    if (may_be_hopeless && noise.noisy_points == 0)
      return {RunStatus::DEGENERATE,
              "the points are too noisy for a mesh that goes through them, by more than their "
              "spacing: smooth the cloud, thin it by a voxel grid, or use a method that smooths, "
              "such as Poisson reconstruction; denoise off connects them nevertheless"};
  }
  reportNoise (noise, noise.is_strong && noise.noisy_points > 0, report);
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
  else if (Problem problem = takePoints (input, request, points, report))
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
    problem =
        reconstructAny (input, {effective, limits, context, input.sensor_origin}, known, result);
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
      input.cloud_index.resize (positions.size ());
      std::iota (input.cloud_index.begin (), input.cloud_index.end (), Index{0});
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

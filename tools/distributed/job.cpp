// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "job.h"

#include "input/input.h"
#include "options/check_options.h"
#include "prepared_input.h"
#include "reconstruct.h"
#include "report/report_cloud.h"
#include "report_json.h"
#include "stored_cloud.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace pcl::floater {
namespace {
constexpr const char* REPORT = "report.json";

// Bytes of each point that have to stay in memory for `plan`. Measured with 10 and 30 million
// points: below, more time goes to pages that come back than to all else.
constexpr double KEPT_BY_PLAN = 9.0;

template <typename Visit>
void
forBlockFiles (const Plan& plan, Visit&& visit)
{
  for (const Step& step : STEPS)
    for (std::size_t block = 0; step.of_block != nullptr && block < plan.blocks; ++block)
      visit (blockFile (step.name, block));
}

// What the blocks have found out, from the files of all, each when it is needed.
class StoredStages : public KnownStages
{
public:
  /// \param context must outlive this
  explicit StoredStages (const StepContext& context)
      : context_ (context), outliers_ (readOutliers (context))
  {
  }

  Points points (Report& report) override
  {
    std::vector<Index> gross_outliers;
    Points points = readPoints (context_.store, POINTS, context_.plan, gross_outliers);
    report.statistics.cloud_points = context_.plan.cloudSize ();
    report.statistics.selected_points = context_.plan.selected_points;
    reportOutliers (gross_outliers, FindingId::GROSS_OUTLIERS, report);
    reportPoints (points, report);
    return points;
  }

  std::vector<Index> outliers () override { return outliers_; }

  LocalPlanes planes () override
  {
    StoredCloud cloud (context_, outliers_);
    const std::vector<Index> all = pointsFrom (0, static_cast<Index> (cloud.points ()));
    LocalPlanes planes;
    planes.neighbors = cloud.nearest (all);
    appendRows (cloud.gatherLists ("planes", "beside", all), planes.neighbors);
    planes.spacing = cloud.gather<float> ("planes", "spacing", all);
    planes.normals = cloud.gather<Eigen::Vector3f> ("planes", "normals", all);
    return planes;
  }

  Stars begunStars () override
  {
    StoredCloud cloud (context_, outliers_);
    const std::vector<Index> all = pointsFrom (0, static_cast<Index> (cloud.points ()));
    Stars stars;
    stars.neighbors = cloud.gatherLists ("stars", "stars", all);
    stars.far_neighbors = cloud.gatherLists ("stars", "far", all);
    stars.open = cloud.gather<std::uint8_t> ("stars", "open", all);
    stars.normals = cloud.gather<Eigen::Vector3f> ("stars", "normals", all);
    stars.reach = cloud.gather<float> ("stars", "reach", all);
    return stars;
  }

private:
  const StepContext& context_;
  std::vector<Index> outliers_;
};

// What decides the result, as text.
std::string
parametersText (const Job& job)
{
  Options options = job.line.options;
  options.threads = 0; // the result does not depend on it
  nlohmann::ordered_json json = optionsJson (options, job.line.use_input_normals);
  json["shift"] = job.line.auto_shift ? nlohmann::ordered_json ("auto") : nlohmann::ordered_json ();
  if (job.line.shift)
    json["shift"] = {job.line.shift->x (), job.line.shift->y (), job.line.shift->z ()};
  if (job.line.columns[0] > 0)
    json["columns"] = job.line.columns;
  if (!job.line.classes.empty ())
    json["classes"] = job.line.classes;
  return json.dump ();
}

// Compares a plan with the parameters of the job and with all bytes of its files.
// \throws WorkError if they are others
void
requirePlan (const Job& job, const FolderStore& store, const Plan& plan)
{
  std::vector<InputFile> inputs;
  for (const std::filesystem::path& input : job.inputs)
    inputs.push_back (describeInput (input));
  if (plan.parameters != parametersText (job))
    throw WorkError ("the options are not those of '" + store.describe (MANIFEST) +
                     "'; give the same, or name another work folder");
  if (planId (inputs, plan.parameters, job.blocks, plan.arguments) != plan.id)
    throw WorkError ("the input files or the number of blocks are not those of '" +
                     store.describe (MANIFEST) + "'; give the same, or name another work folder");
}

} // namespace

void
prepareFolders (const Job& job)
{
  std::error_code error;
  if (std::filesystem::create_directories (job.work, error))
    std::filesystem::permissions (job.work, std::filesystem::perms::owner_all, error);
  if (error || !std::filesystem::is_directory (job.work))
    throw WriteError ("cannot make the work folder '" + job.work.string () +
                      "': " + (error ? error.message () : "there is a file of that name"));
  requireWritable (job.work / MANIFEST);
  if (job.writes_tiles && std::filesystem::exists (job.line.output)) {
    if (std::filesystem::equivalent (job.line.output, job.work))
      throw UsageError ("the tiles cannot be in the work folder; name another folder");
    requireWritable (job.line.output / TILES);
  }
  else
    requireWritable (job.line.output);
  if (!job.line.report.empty ())
    requireWritable (job.line.report);
}

int
planStep (const Job& job, FolderStore& store)
{
  Plan plan;
  try {
    nlohmann::json (job.arguments).dump ();
  }
  catch (const nlohmann::json::exception&) {
    throw UsageError ("an argument is no UTF-8, which the manifest of the work folder is; use "
                      "other names of files and folders");
  }
  for (const std::filesystem::path& input : job.inputs)
    plan.inputs.push_back (describeInput (input));
  CommandLine line = job.line;
  std::vector<std::size_t> firsts;
  Cloud cloud = readClouds (job.inputs, readOptionsOf (line), firsts);
  Input input = prepareInput (line, cloud, plan.figures, KEPT_BY_PLAN);
  plan.warnings = cloud.warnings;
  plan.figures.vertices = static_cast<std::size_t> (
      std::count_if (input.positions.begin (), input.positions.end (),
                     [] (const Eigen::Vector3d& position) { return position.allFinite (); }));
  const RunContext run (job.join_threads);
  const Options options = effectiveOptions (line.options);
  const Limits limits = effectiveLimits ({}, line.options);
  Points points;
  Report report;
  const std::array<double, 3> sensor_origin = input.sensor_origin;
  Problem problem = takePoints (input, {options, limits, run, sensor_origin}, points, report);
  if (!problem)
    problem = checkPoints (points);
  if (problem) {
    report.status = problem.status;
    report.message = problem.message;
    printOutcome (line, report, {});
    return exitCode (report, {});
  }
  plan.arguments = job.arguments;
  plan.parameters = parametersText (job);
  plan.points = points.size ();
  constexpr std::size_t POINTS_OF_BLOCK = std::size_t{1} << 19U; // some 200 MB at a time
  plan.blocks =
      job.blocks > 0 ? job.blocks : (points.size () + POINTS_OF_BLOCK - 1) / POINTS_OF_BLOCK;
  plan.selected_points = report.statistics.selected_points;
  plan.scale = points.scale;
  plan.sensor_origin = sensor_origin;
  Eigen::Map<Eigen::Vector3d> (plan.centre.data ()) = points.centre;
  plan.id = planId (plan.inputs, plan.parameters, job.blocks, plan.arguments);
  writePoints (store, POINTS, plan.id, points, report.outliers);
  writeFile (store.path (MANIFEST), manifestText (plan),
             true); // last: with it, the step is finished
  return EXIT_OK;
}

Plan
readPlan (const Job& job, FolderStore& store)
{
  Plan plan = parseManifest (store.open (MANIFEST).text (), store.describe (MANIFEST));
  if (!job.is_from_manifest || (job.step != nullptr && job.step->of_all == joinStep))
    requirePlan (job, store, plan);
  return plan;
}

int
joinStep (const Job& job, FolderStore& store, const Plan& plan)
{
  const auto start = std::chrono::steady_clock::now ();
  CommandLine line = job.line;
  const StepContext context (store, plan, line, job.join_threads);
  checkMemory (line, plan.cloudSize ());
  StoredStages stages (context);
  forBlockFiles (plan, [&] (const std::string& name) { // missing ones are told before hours of work
    openArrays (store, name, plan);
  });
  Input input;
  input.cloud_size = plan.cloudSize ();
  input.sensor_origin = plan.sensor_origin;
  Options options = line.options;
  options.threads = job.join_threads;
  Eigen::Map<Eigen::Vector3d> (options.view.viewpoint.data ()) -= plan.shift ();
  Result result = reconstruct (std::move (input), options, {}, &stages);
  Report& report = result.report;
  RunFigures figures = plan.figures;
  figures.reconstruct_seconds = secondsSince (start);
  figures.writes_single = line.precision != Precision::DOUBLE;
  report.warnings.insert (report.warnings.begin (), line.warnings.begin (), line.warnings.end ());
  report.warnings.insert (report.warnings.begin (), plan.warnings.begin (), plan.warnings.end ());
  reportMemory (line, report);
  line.input = job.inputs.front ();
  writeFile (store.path (REPORT), reportText (line, report, figures), true);
  printOutcome (line, report, figures);
  if (report.status != RunStatus::SUCCESS)
    return exitCode (report, figures);
  store.put (TRIANGLES, {{"triangles", result.triangles}}, plan.id);
  if (job.frees_disk)
    forBlockFiles (plan, [&store] (const std::string& name) { store.remove (name); });
  return EXIT_OK;
}

int
writeStep (const Job& job, FolderStore& store, const Plan& plan)
{
  const CommandLine& line = job.line;
  ArrayFile file = openArrays (store, TRIANGLES, plan);
  auto triangles = file.read<Triangle> ("triangles");
  file.requireBelow (triangles, plan.cloudSize ());
  std::vector<std::size_t> firsts;
  Cloud cloud = readClouds (job.inputs, readOptionsOf (line), firsts);
  cloud.shift = plan.shift ();
  cloud.single_precision = line.precision != Precision::DOUBLE;
  requirePlan (job, store, plan); // the bytes of now
  if (line.compute_normals)
    replaceNormals (cloud, triangles, job.join_threads);
  removeNonFinitePoints (cloud, triangles);
  OutputFiles files;
  if (!line.report.empty ())
    stageFile (line.report, store.open (REPORT).text (), files);
  const std::vector<std::string> losses =
      job.writes_tiles ? writeTiles (line.output, cloud, triangles, firsts, store, plan)
                       : writeMesh (line.output, cloud, triangles, *line.meshFormat (), files);
  for (const std::string& loss : losses)
    std::fprintf (stderr, "warning: %s\n", printable (loss).c_str ());
  publishAll (files);
  return EXIT_OK;
}

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "job.h"

#include "atomic_file.h"
#include "format.h"
#include "input/input.h"
#include "memory_limit.h"
#include "mesh_output.h"
#include "mesh_writer.h"
#include "options/check_options.h"
#include "precision.h"
#include "prepared_input.h"
#include "report_json.h"
#include "run_report.h"
#include "stored_mesh.h"
#include "stored_stages.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace pcl::floater {
namespace {
constexpr std::size_t POINTS_OF_BLOCK = std::size_t{1} << 19U; // some 200 MB at a time
constexpr const char* REPORT = "report.json";

double
secondsSince (std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double> (std::chrono::steady_clock::now () - start).count ();
}

// The cloud of the job, with its origin shifted as in the plan.
Cloud
readShifted (const Job& job, const Plan& plan, std::vector<std::size_t>* firsts = nullptr)
{
  Cloud cloud = readClouds (job.inputs, job.line.auto_shift || job.line.shift, firsts);
  cloud.shift = Eigen::Map<const Eigen::Vector3d> (plan.shift.data ());
  return cloud;
}

// Bytes of each point that have to stay in memory for the steps of the whole cloud. Measured for
// `plan` with 10 and 30 million points: below, more time goes to pages that come back than to all
// else. `join` was run with 9 (10 million points) and 11 (100 million).
constexpr double KEPT_BY_STEP = 9.0;

// Throws UsageError if a step of the whole cloud cannot be kept below the limit.
void
checkMemory (const CommandLine& line, std::size_t points)
{
  const std::size_t least = leastMemory (points, KEPT_BY_STEP);
  if (line.max_memory > 0 && line.max_memory < least)
    throw UsageError ("--max-memory: " + formatSize (line.max_memory) + " is too small for " +
                      std::to_string (points) + " points; use " + formatSize (least) + " or more");
}

// What the report and the mesh need to know of the cloud.
void
describeCloud (const Cloud& cloud, const Input& input, Plan& plan)
{
  for (const Field& field : cloud.fields)
    plan.fields.push_back (field.name);
  plan.warnings = cloud.warnings;
  plan.finite_points = static_cast<std::size_t> (
      std::count_if (input.positions.begin (), input.positions.end (),
                     [] (const Eigen::Vector3d& position) { return position.allFinite (); }));
  plan.is_single = cloud.single_precision;
  plan.fits_single =
      cloud.single_precision || fitSinglePrecision (input.positions, cloud.are_decimals);
}

void
tellFailure (const Job& job, const Problem& problem, const Report& warnings)
{
  Report report = warnings;
  report.status = problem.status;
  report.message = problem.message;
  printOutcome (job.line, report, {});
}

} // namespace

std::string
parametersText (const Job& job)
{
  Options options = job.line.options;
  options.threads = 0; // the result does not depend on these
  options.blocks = 0;
  nlohmann::ordered_json json = optionsJson (options, job.line.use_input_normals);
  json["shift"] = job.line.auto_shift ? nlohmann::ordered_json ("auto") : nlohmann::ordered_json ();
  if (job.line.shift)
    json["shift"] = {job.line.shift->x (), job.line.shift->y (), job.line.shift->z ()};
  if (!job.line.changed_limits.empty ())
    json["limits"] = job.line.changed_limits;
  return json.dump ();
}

void
prepareFolders (const Job& job)
{
  std::error_code error;
  std::filesystem::create_directories (job.work, error);
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

EffectiveOptions::EffectiveOptions (const CommandLine& line)
    : options (effectiveOptions (line.options)),
      limits (effectiveLimits (line.limits, line.options))
{
}

std::size_t
defaultBlocks (std::size_t points)
{
  return std::max<std::size_t> (1, (points + POINTS_OF_BLOCK - 1) / POINTS_OF_BLOCK);
}

int
planStep (const Job& job, FolderStore& store)
{
  Plan plan;
  for (const std::filesystem::path& input : job.inputs)
    plan.inputs.push_back (describeInput (input));
  CommandLine line = job.line;
  Cloud cloud = readClouds (job.inputs, line.auto_shift || line.shift);
  checkMemory (line, cloud.size ());
  Input input = makeInput (cloud);
  takeNormals (line, cloud, input);
  shiftOrigin (line, cloud, input);
  describeCloud (cloud, input, plan);
  const EffectiveOptions effective (line);
  Statistics times; // which nobody reads
  RunMonitor monitor ({{}, {}, {}, line.options.task_callback}, times);
  const RunContext run (job.join_threads, &monitor);
  Points points;
  Report report;
  const std::array<double, 3> sensor_origin = input.sensor_origin;
  Problem problem =
      takePoints (input, {effective.options, effective.limits, run, sensor_origin}, points, report);
  if (!problem)
    problem = checkPoints (points);
  if (problem) {
    tellFailure (job, problem, report);
    Report failed;
    failed.status = problem.status;
    return exitCode (failed, {});
  }
  plan.arguments = job.arguments;
  plan.parameters = parametersText (job);
  plan.points = points.size ();
  plan.blocks = job.blocks > 0 ? job.blocks : defaultBlocks (points.size ());
  const std::size_t parts = Parts (points.size (), effective.limits.parts).count ();
  plan.parts = parts > 1 ? parts : 0;
  plan.cloud_size = report.statistics.cloud_points;
  plan.selected_points = report.statistics.selected_points;
  plan.lattice_width = points.lattice_width;
  plan.scale = points.scale;
  plan.sensor_origin = sensor_origin;
  Eigen::Map<Eigen::Vector3d> (plan.centre.data ()) = points.centre;
  Eigen::Map<Eigen::Vector3d> (plan.shift.data ()) = cloud.shift;
  plan.id = planId (plan.inputs, plan.parameters, job.blocks);
  writePoints (store, POINTS, plan.id, points, report.outliers, run);
  store.finish ();
  store.putText (MANIFEST, manifestText (plan)); // last: with it, the step is finished
  return EXIT_OK;
}

Plan
readPlan (const Job& job, const FolderStore& store)
{
  Plan plan = parseManifest (store.readText (MANIFEST), store.describe (MANIFEST));
  if (job.is_from_manifest && job.step != "join" && job.step != "write")
    return plan;
  std::vector<InputFile> inputs;
  for (const std::filesystem::path& input : job.inputs)
    inputs.push_back (describeInput (input));
  if (plan.parameters != parametersText (job))
    throw WorkError ("the options are not those of '" + store.describe (MANIFEST) +
                     "'; give the same, or name another work folder");
  if (planId (inputs, plan.parameters, job.blocks) != plan.id)
    throw WorkError ("the input files or the number of blocks are not those of '" +
                     store.describe (MANIFEST) + "'; give the same, or name another work folder");
  return plan;
}

int
joinStep (const Job& job, FolderStore& store, const Plan& plan, const JoinHelp& help)
{
  const auto start = std::chrono::steady_clock::now ();
  CommandLine line = job.line;
  const EffectiveOptions effective (line);
  const RunContext run (job.join_threads);
  const StepContext context{store, plan, effective.options, effective.limits, run};
  checkMemory (line, plan.cloud_size);
  StoredStages stages (context, store, job.frees_disk ? &store : nullptr);
  stages.setHelp (help);
  for (const char* step : BLOCK_STEPS) // what is missing is told before hours of work
    for (std::size_t block = 0; block < plan.blocks; ++block)
      openArrays (store, blockFile (step, block), plan);
  for (std::size_t part = 0; part < plan.parts; ++part)
    openArrays (store, blockFile (MESH, part), plan);
  Input input;
  input.cloud_size = plan.cloud_size;
  input.sensor_origin = plan.sensor_origin;
  input.lattice_width = plan.lattice_width;
  Options options = line.options;
  options.threads = job.join_threads;
  Eigen::Map<Eigen::Vector3d> (options.view.viewpoint.data ()) -=
      Eigen::Map<const Eigen::Vector3d> (plan.shift.data ());
  Result result = reconstruct (std::move (input), options, line.limits, stages);
  Report& report = result.report;
  if (report.status == RunStatus::CANCELLED) // only stitchStep () cancels
    return EXIT_OK;
  RunFigures figures;
  figures.reconstruct_seconds = secondsSince (start);

  figures.shift = Eigen::Map<const Eigen::Vector3d> (plan.shift.data ());
  figures.input_points = plan.cloud_size;
  figures.single_precision = plan.is_single;
  figures.input_fields = plan.fields;
  std::vector<std::string> warnings = plan.warnings;
  const bool is_single = choosePrecision (
      line.precision, *line.meshFormat (), [&plan] { return plan.fits_single; },
      line.auto_shift || line.shift, warnings);
  figures.writes_single = is_single;
  report.warnings.insert (report.warnings.begin (), line.warnings.begin (), line.warnings.end ());
  report.warnings.insert (report.warnings.begin (), warnings.begin (), warnings.end ());
  reportMemory (line, report);
  if (report.status == RunStatus::SUCCESS)
    figures.vertices = plan.finite_points;
  line.input = job.inputs.front ();
  store.putText (REPORT, reportText (line, report, figures));
  printOutcome (line, report, figures);
  if (report.status != RunStatus::SUCCESS)
    return exitCode (report, figures);
  const FinishedMesh mesh{std::move (result.triangles), stages.takeMesh (), is_single,
                          job.frees_disk};
  putMesh (store, plan, mesh);
  removeFinished (store, plan, !mesh.parts);
  if (job.frees_disk) {
    store.finish (); // the mesh is on the disk before that of which it was made goes
    for (const char* step : BLOCK_STEPS)
      for (std::size_t block = 0; block < plan.blocks; ++block)
        store.remove (blockFile (step, block));
    for (std::size_t part = 0; part < plan.parts; ++part)
      store.remove (blockFile (MESH, part));
  }
  return EXIT_OK;
}

int
stitchStep (const Job& job, FolderStore& store, const Plan& plan, JoinHelp help)
{
  help.finish = [] (const std::string&, const std::deque<std::size_t>&) { throw Cancelled (); };
  return joinStep (job, store, plan, help);
}

int
writeStep (const Job& job, FolderStore& store, const Plan& plan)
{
  const CommandLine& line = job.line;
  const EffectiveOptions effective (line);
  const RunContext run (job.join_threads);
  FinishedMesh mesh = readMesh ({store, plan, effective.options, effective.limits, run});
  Triangles triangles = std::move (mesh.triangles);
  std::vector<std::size_t> firsts;
  Cloud cloud = readShifted (job, plan, &firsts);
  cloud.single_precision = mesh.is_single;
  if (line.compute_normals)
    replaceNormals (cloud, triangles, job.join_threads);
  removeNonFinitePoints (cloud, triangles);
  std::optional<AtomicFile> report;
  if (!line.report.empty ()) {
    report.emplace (line.report);
    report->write (store.readText (REPORT));
    report->close ();
  }
  std::vector<std::string> losses;
  if (job.writes_tiles)
    losses = writeTiles (line.output, cloud, triangles,
                         job.inputs.size () > 1 ? ownersByFile (cloud, firsts, job.inputs)
                                                : ownersByBlock (cloud, store, plan));
  else {
    AtomicFile file (line.output);
    losses = writeMesh (file, line.output, cloud, triangles, line.output_format);
    file.close ();
    file.publish ();
  }
  for (const std::string& loss : losses)
    std::fprintf (stderr, "warning: %s\n", loss.c_str ());
  if (report)
    report->publish ();
  return EXIT_OK;
}

} // namespace pcl::floater

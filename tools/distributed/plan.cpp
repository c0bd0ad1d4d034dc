// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "job.h"

#include "input/input.h"
#include "report_json.h"
#include "stored_cloud.h"

#include <nlohmann/json.hpp>
#include <xxhash.h>

namespace pcl::floater {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE (InputFile, file, bytes, checksum)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE (RunFigures, input_points, notes, input_fields, single_precision,
                                    shift, vertices)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE (Plan, id, inputs, arguments, parameters, points, blocks,
                                    selected_points, centre, sensor_origin, scale, warnings,
                                    figures)

namespace {
using ManifestJson = nlohmann::json;

constexpr const char* FORMAT = "pcl_floater work folder";

std::uint64_t
hash (std::string_view text)
{
  return XXH3_64bits (text.data (), text.size ());
}

std::vector<InputFile>
describeInputs (const Job& job)
{
  std::vector<InputFile> inputs;
  for (const std::filesystem::path& path : job.inputs)
    readNamed (path, [&] {
      const FileBytes file (path);
      inputs.push_back ({path.string (), file.view ().size (), hash (file.view ())});
    });
  return inputs;
}

// Identifies a plan: the same for the same files, parameters and arguments of the one that made it.
std::uint64_t
planId (const std::vector<InputFile>& inputs, const std::string& parameters, std::size_t blocks,
        const std::vector<std::string>& arguments)
{
  ManifestJson sums = ManifestJson::array ();
  for (const InputFile& input : inputs)
    sums.push_back ({input.bytes, input.checksum});
  return hash (dump ({WORK_FORMAT, parameters, sums, arguments, blocks}));
}

// Bytes of each point that have to stay in memory for `plan`. Measured with 10 and 30 million
// points: below, more time goes to pages that come back than to all else.
constexpr double KEPT_BY_PLAN = 9.0;

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
  return dump (json);
}

} // namespace

Plan
readManifest (const Store& store)
{
  const WorkFile file = store.open (MANIFEST);
  try {
    ManifestJson json = ManifestJson::parse (file.text ());
    if (json.at ("format") != FORMAT)
      file.refuse ("is no manifest of this program; name another work folder");
    if (json.at ("version") != WORK_FORMAT)
      file.refuse ("has the format version " + json.at ("version").dump () + ", and this program " +
                   std::to_string (WORK_FORMAT) +
                   "; use the version that made it, or an empty work folder");
    const ManifestJson checksum = json.at ("checksum");
    json.erase ("checksum");
    if (checksum == hash (dump (json)))
      return json.get<Plan> ();
  }
  catch (const nlohmann::json::exception&) { // is told below
  }
  file.refuse ("is damaged; delete it and run again");
}

Cloud
readClouds (const std::vector<std::filesystem::path>& files, const ReadOptions& options,
            std::vector<std::size_t>& firsts)
{
  std::vector<Cloud> clouds;
  firsts = {0};
  for (const std::filesystem::path& file : files) {
    clouds.push_back (readNamed (file, [&] { return readCloud (file, options); }));
    firsts.push_back (firsts.back () + clouds.back ().rows);
  }
  if (clouds.size () == 1)
    return std::move (clouds.front ());
  Cloud merged;
  merged.rows = firsts.back ();
  if (merged.rows > static_cast<std::size_t> (std::numeric_limits<std::int32_t>::max ()))
    throw ReadError ("the files have more points together than a mesh file can number "
                     "(2147483647); reconstruct fewer of them at a time");
  merged.coordinates = {
      {{"x", ScalarType::FLOAT64}, {"y", ScalarType::FLOAT64}, {"z", ScalarType::FLOAT64}}};
  for (const Field& field : clouds.front ().fields)
    if (std::all_of (clouds.begin (), clouds.end (), [&field] (const Cloud& cloud) {
          const Field* const its = cloud.find (field.name);
          return its != nullptr && its->type == field.type && its->count == field.count;
        }))
      merged.fields.push_back ({field.name, field.type, field.count});
    else
      merged.warnings.push_back ("the field '" + field.name +
                                 "' was left out: not all files have it with the same type");
  char* to = allocateRows (allFields (merged), merged.rows).get (); // which the fields keep
  std::vector<std::string> warnings;                                // before those of the fields
  for (std::size_t c = 0; c < clouds.size (); ++c) {
    const Cloud& cloud = clouds[c];
    const std::string named = "'" + files[c].string () + "': ";
    for (const std::string& warning : cloud.warnings)
      warnings.push_back (named + warning);
    for (const std::string& note : cloud.notes)
      merged.notes.push_back (named + note);
    merged.single_precision = merged.single_precision && cloud.single_precision;
    if (!cloud.left_out.empty ()) {
      merged.left_out.resize (merged.rows, false);
      std::copy (cloud.left_out.begin (), cloud.left_out.end (),
                 merged.left_out.begin () + static_cast<std::ptrdiff_t> (firsts[c]));
    }
    std::vector<const Field*> fields;
    for (const Field& field : merged.fields)
      fields.push_back (cloud.find (field.name));
    for (std::size_t row = 0; row < cloud.rows; ++row) {
      for (const Field& field : cloud.coordinates) {
        const double coordinate = field.scaled (row); // as it is meant and not as it is in the file
        to = std::copy_n (reinterpret_cast<const char*> (&coordinate), sizeof coordinate, to);
      }
      for (const Field* field : fields)
        to = putValues (*field, to, [&] (auto tag, std::size_t value) {
          return field->value<decltype (tag)> (row, value);
        });
    }
  }
  merged.warnings.insert (merged.warnings.begin (), warnings.begin (), warnings.end ());
  return merged;
}

void
requirePlan (const Job& job, const Store& store, const Plan& plan)
{
  const std::vector<InputFile> inputs = describeInputs (job);
  if (plan.parameters != parametersText (job))
    throw WorkError ("the options are not those of '" + store.path (MANIFEST).string () +
                     "'; give the same, or name another work folder");
  if (planId (inputs, plan.parameters, job.blocks, plan.arguments) != plan.id)
    throw WorkError ("the input files or the number of blocks are not those of '" +
                     store.path (MANIFEST).string () +
                     "'; give the same, or name another work folder");
}

int
planStep (const Job& job, const Store& store)
{
  Plan plan;
  try {
    nlohmann::json (job.arguments).dump ();
  }
  catch (const nlohmann::json::exception&) {
    throw UsageError ("an argument is no UTF-8, which the manifest of the work folder is; use "
                      "other names of files and folders");
  }
  plan.inputs = describeInputs (job);
  CommandLine line = job.line;
  std::vector<std::size_t> firsts;
  Cloud cloud = readClouds (job.inputs, line.readOptions (), firsts);
  Input input = prepareInput (line, cloud, plan.figures, KEPT_BY_PLAN);
  plan.warnings = cloud.warnings;
  plan.figures.vertices = static_cast<std::size_t> (
      std::count_if (input.positions.begin (), input.positions.end (),
                     [] (const Eigen::Vector3d& position) { return position.allFinite (); }));
  const RunContext run (job.join_threads);
  const Options options = effectiveOptions (line.options);
  const Limits limits;
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
  ManifestJson json = plan;
  json["format"] = FORMAT;
  json["version"] = WORK_FORMAT;
  json["checksum"] = hash (dump (json));
  // Last: with it, the step is finished.
  writeFile (store.path (MANIFEST), dump (json, 2) + "\n", true);
  return EXIT_OK;
}

} // namespace pcl::floater

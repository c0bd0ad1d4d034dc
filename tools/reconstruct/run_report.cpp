// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_report.h"

#include "large_arrays.h"
#include "memory_limit.h"
#include "report_json.h"

#include <nlohmann/json.hpp>

#include <sys/resource.h>

namespace pcl::floater {
namespace {
using Json = nlohmann::ordered_json;

/// JSON is UTF-8; in names of files, bytes that are not are replaced.
std::string
dump (const Json& json)
{
  constexpr int ONE_LINE = -1;
  return json.dump (ONE_LINE, ' ', false, Json::error_handler_t::replace);
}

Json
fileName (const std::filesystem::path& path)
{
  return path.empty () ? Json () : Json (path.string ());
}

/// Null if there is no limit.
Json
memoryLimitJson (const CommandLine& line)
{
  if (line.max_memory == 0)
    return {};
  const ScratchUse use = scratchUse ();
  return {{"bytes", line.max_memory},
          {"scratch", fileName (line.scratch)},
          {"scratch_peak_bytes", use.peak},
          {"dropped_bytes", use.dropped}};
}

/// Null if no texture coordinates were asked for.
Json
textureJson (const CommandLine& line, const RunFigures& run)
{
  const TextureCoordinates& texture = run.texture;
  if (texture.status != RunStatus::SUCCESS)
    return {};
  return {{"file", fileName (line.texture)}, {"charts", texture.chart_count},
          {"stretch", texture.stretch},      {"largest_stretch", texture.largest_stretch},
          {"area_used", texture.area_used},  {"seam_length", texture.seam_length},
          {"gutter", texture.gutter},        {"flipped", texture.flipped}};
}

} // namespace

std::size_t
peakMemory ()
{
  constexpr std::size_t UNIT = 1024; // bytes; Linux counts in kB
  rusage usage{};
  return ::getrusage (RUSAGE_SELF, &usage) == 0 ? static_cast<std::size_t> (usage.ru_maxrss) * UNIT
                                                : 0;
}

std::string
outcomeName (const Report& report, const RunFigures& run)
{
  return run.is_refused ? "WARNINGS" : statusName (report.status);
}

std::string
reportText (const CommandLine& line, const Report& report, const RunFigures& run)
{
  const bool is_ok = report.status == RunStatus::SUCCESS && !run.is_refused;
  Json all = {{"tool", "pcl_floater_reconstruct"},
              {"version", PCL_FLOATER_VERSION},
              {"input",
               {{"file", fileName (line.input)},
                {"points", run.input_points},
                {"coordinates", run.single_precision ? "float" : "double"},
                {"fields", run.input_fields}}},
              {"shift", {run.shift.x (), run.shift.y (), run.shift.z ()}},
              {"output", is_ok ? Json{{"file", fileName (line.output)},
                                      {"coordinates", run.writes_single ? "float" : "double"},
                                      {"vertices", run.vertices},
                                      {"normals", line.compute_normals},
                                      {"triangles", report.statistics.triangles},
                                      {"parameterization", fileName (line.parameterization)}}
                               : Json ()},
              {"options", optionsJson (line.options, line.use_input_normals)},
              {"strict", line.strict},
              {"status", outcomeName (report, run)},
              {"message", report.message},
              {"warnings", report.warnings}};
  all.update (resultJson (report));
  all["seconds"] = {{"reading", run.read_seconds}};
  all["seconds"].update (secondsJson (report.statistics));
  all["seconds"]["reconstruction"] = run.reconstruct_seconds;
  if (run.texture.status != RunStatus::NOT_RUN)
    all["seconds"]["texture"] = run.texture_seconds;
  all["texture"] = is_ok ? textureJson (line, run) : Json ();
  all["peak_memory_bytes"] = peakMemory ();
  all["memory_limit"] = memoryLimitJson (line);
  all["loop"] = report.loop;
  all["unused"] = report.unused;
  all["outliers"] = report.outliers;
  all["scatter"] = report.scatter;
  all["non_finite"] = report.non_finite;
  all["duplicates"] = report.duplicates;
  std::string text;
  for (const auto& [key, value] : all.items ())
    text += (text.empty () ? "{\n  " : ",\n  ") + dump (key) + ": " + dump (value);
  return text + "\n}\n";
}

std::string
summaryLine (const CommandLine& line, const Report& report, const RunFigures& run)
{
  const bool is_ok = report.status == RunStatus::SUCCESS && !run.is_refused;
  return dump ({{"status", outcomeName (report, run)},
                {"message", report.message},
                {"points", run.input_points},
                {"used_points", report.statistics.used_points},
                {"triangles", report.statistics.triangles},
                {"topology", choiceName (TOPOLOGY_CHOICES, report.topology)},
                {"topology_reason", report.topology_reason},
                {"components", report.check.components},
                {"genus", report.check.genus},
                {"loops", report.check.loops.size ()},
                {"loop_points", report.statistics.loop_points},
                {"viewpoint", viewpointJson (report)},
                {"denoised", report.denoised},
                {"outliers", report.outliers.size ()},
                {"warnings", report.warnings.size ()},
                {"recon_seconds", run.reconstruct_seconds},
                {"read_seconds", run.read_seconds},
                {"write_seconds", run.write_seconds},
                {"peak_memory_bytes", peakMemory ()},
                {"output", is_ok ? fileName (line.output) : Json ()}});
}

void
reportMemory (const CommandLine& line, Report& report)
{
  if (const std::string failure = largeArrayFailure ();
      report.status == RunStatus::OUT_OF_MEMORY && !failure.empty ())
    report.message = failure;
  if (line.max_memory == 0)
    return;
  if (liesInMemory (line.scratch))
    report.warnings.push_back ("the scratch folder '" + line.scratch.string () +
                               "' is in memory itself; use --scratch to name one on a disk");
  const std::size_t peak = peakMemory ();
  if (peak > line.max_memory)
    report.warnings.push_back ("the memory in use grew to " + formatSize (peak) +
                               ", above --max-memory " + formatSize (line.max_memory));
}

} // namespace pcl::floater

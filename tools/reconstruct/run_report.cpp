// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_report.h"

#include "report_json.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace pcl::floater {
namespace {
using Json = nlohmann::ordered_json;

Json
fileName (const std::filesystem::path& path)
{
  return path.empty () ? Json () : Json (path.string ());
}

/// Name of the status, or "REFUSED" if --strict refuses the mesh.
std::string
outcomeName (const Report& report, const RunFigures& run)
{
  return run.is_refused ? "REFUSED" : statusName (report.status);
}

// The most important figures as a JSON object on one line, without newline.
std::string
summaryLine (const CommandLine& line, const Report& report, const RunFigures& run)
{
  const bool is_ok = report.status == RunStatus::SUCCESS && !run.is_refused;
  return dump ({{"status", outcomeName (report, run)},
                {"message", report.message},
                {"verdict", qualityName (report.verdict.value)},
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

/// Prints the decisions that a run is least sure of.
void
printUnsure (std::FILE* to, const Report& report)
{
  const auto begin = [to] (const char* what, std::size_t count, const char* noun) {
    constexpr std::size_t MOST = 10;
    if (count > 0)
      std::fprintf (to, "not sure   %s%s%s\n", what, counted (count, noun).c_str (),
                    count > MOST ? ", the least sure of them:" : "");
    return std::min (count, MOST); // are told
  };
  const std::size_t loops = begin ("of ", report.loop_decisions.size (), "boundary loop");
  for (std::size_t i = 0; i < loops; ++i) {
    const LoopDecision& loop = report.loop_decisions[i];
    std::fprintf (to,
                  "           of %zu points, %.3g spacings wide, at point %u: %s, a boundary with "
                  "a probability of %.0f %%\n",
                  loop.points, loop.width_spacings, loop.at,
                  loop.stays_open ? "stays open" : "filled", 100.0 * loop.probability);
  }
  const std::size_t parts =
      begin ("which side is the front of ", report.facing_decisions.size (), "part");
  for (std::size_t i = 0; i < parts; ++i) {
    const FacingDecision& part = report.facing_decisions[i];
    std::fprintf (
        to,
        "           of %zu triangles at point %u: by the rule '%s', with a certainty of %.0f %%\n",
        part.triangles, part.at, facingRuleName (part.rule), 100.0 * part.certainty);
  }
}

void
printShape (std::FILE* to, const Report& report)
{
  const MeshCheck& check = report.check;
  std::fprintf (to, "topology   %s%s%s\n", choiceName (TOPOLOGY_CHOICES, report.topology),
                report.topology_reason.empty () ? "" : ": ", report.topology_reason.c_str ());
  std::fprintf (
      to, "shape      %s, genus %lld, %s\n", counted (check.components, "component").c_str (),
      static_cast<long long> (check.genus), check.loops.empty () ? "closed" : "with boundary");
  if (check.loops.empty ())
    return;
  const LoopSummary &longest = check.loops.front (), &shortest = check.loops.back ();
  if (check.loops.size () == 1)
    std::fprintf (to, "loops      1 of %zu points, %.3g spacings wide\n", longest.points,
                  longest.width_spacings);
  else
    std::fprintf (
        to, "loops      %zu, of %zu points, %.3g spacings wide, to %zu points, %.3g spacings\n",
        check.loops.size (), longest.points, longest.width_spacings, shortest.points,
        shortest.width_spacings);
}

void
printSummary (std::FILE* to, const CommandLine& line, const Report& report, const RunFigures& run)
{
  const Statistics& statistics = report.statistics;
  constexpr double MEGABYTE = 1e6;
  const Verdict& verdict = report.verdict;
  std::fprintf (to, "verdict    %s%s%s\n", qualityName (verdict.value),
                verdict.cause.empty () ? "" : ": ", verdict.cause.c_str ());
  if (!verdict.remedy.empty ())
    std::fprintf (to, "           what helps: %s\n", verdict.remedy.c_str ());
  for (const std::string& note : run.notes)
    std::fprintf (to, "input      %s\n", note.c_str ());
  std::fprintf (
      to, "points     %zu, %zu of them in the mesh (%zu repeated, %zu invalid, %s, %zu unused)\n",
      run.input_points, statistics.used_points, statistics.duplicate_points,
      statistics.non_finite_points, counted (report.outliers.size (), "outlier").c_str (),
      report.unused.size ());
  if (!report.scatter.empty ())
    std::fprintf (to, "scatter    %s on no surface at any scale, such as leaves: %s\n",
                  counted (report.scatter.size (), "point").c_str (),
                  line.options.scatter == ScatterPolicy::KEEP ? "connected like the others"
                                                              : "left out");
  std::fprintf (to, "triangles  %zu\n", statistics.triangles);
  printShape (to, report);
  if (line.verbose)
    printUnsure (to, report);
  if (statistics.trimmed_triangles > 0)
    std::fprintf (to, "cut off    %s (%zu to open crossings), %s, %s\n",
                  counted (statistics.trimmed_triangles, "triangle").c_str (),
                  statistics.opened_triangles,
                  counted (statistics.trimmed_components, "component").c_str (),
                  counted (statistics.trimmed_points, "point").c_str ());
  if (run.shift != std::array<double, 3>{})
    std::fprintf (to, "shift      %.17g %.17g %.17g, subtracted from all coordinates%s\n",
                  run.shift[0], run.shift[1], run.shift[2],
                  line.auto_shift
                      ? ": 32-bit numbers are too coarse for them; --precision double keeps them"
                      : "");
  if (report.is_view)
    std::fprintf (
        to, "viewpoint  %s %.6g %.6g %.6g; %s across depth steps and %zu in gaps were left out\n",
        report.is_far_view ? "far away, rays along" : "at", report.viewpoint[0],
        report.viewpoint[1], report.viewpoint[2],
        counted (statistics.view_steps, "triangle").c_str (), statistics.view_gaps);
  if (statistics.stacked_points > 0)
    std::fprintf (to, "stacks     %s on other points, %.2g spacings from them (largest %.2g)\n",
                  counted (statistics.stacked_points, "point").c_str (), statistics.stack_height,
                  statistics.largest_stack_height);
  if (report.denoised)
    std::fprintf (to,
                  "noise      %.2g spacings (90 %% below %.2g, largest %.2g): to connect them, %zu "
                  "points were projected on local planes\n",
                  statistics.noise, statistics.noise_quantile_90, statistics.largest_noise,
                  statistics.projected_points);
  std::fprintf (to,
                "seconds    %.3f reading, %.3f reconstructing, %.3f writing; peak memory %.0f MB\n",
                run.read_seconds, run.reconstruct_seconds, run.write_seconds,
                static_cast<double> (peakMemory ()) / MEGABYTE);
  std::fprintf (to, "warnings   %zu\n", report.warnings.size ());
  std::fprintf (to, "mesh       %s\n",
                isStandardStream (line.output) ? "to the standard output"
                                               : printable (line.output.string ()).c_str ());
  if (run.texture.status == RunStatus::SUCCESS)
    std::fprintf (to, "texture    %s, stretch %.3f, %.0f %% of the square used, %.3f s%s%s\n",
                  counted (run.texture.chart_count, "chart").c_str (), run.texture.stretch,
                  100.0 * run.texture.area_used, run.texture_seconds,
                  line.texture.empty () ? "" : ": ", printable (line.texture.string ()).c_str ());
  for (const auto& [what, path] :
       {std::pair ("flat mesh  ", &line.parameterization), std::pair ("report     ", &line.report),
        std::pair ("page       ", &line.html)})
    if (!path->empty ())
      std::fprintf (to, "%s%s\n", what, printable (path->string ()).c_str ());
}

} // namespace

nlohmann::ordered_json
reportJson (const CommandLine& line, const Report& report, const RunFigures& run)
{
  const bool is_ok = report.status == RunStatus::SUCCESS && !run.is_refused;
  Json all = {{"tool", "pcl_floater_reconstruct"},
              {"version", PCL_FLOATER_VERSION},
              {"input",
               {{"file", fileName (line.input)},
                {"points", run.input_points},
                {"coordinates", run.single_precision ? "float" : "double"},
                {"fields", run.input_fields},
                {"notes", run.notes}}},
              {"shift", run.shift},
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
  all["texture"] = nullptr;
  if (const TextureCoordinates& texture = run.texture;
      is_ok && texture.status == RunStatus::SUCCESS)
    all["texture"] = {
        {"file", fileName (line.texture)}, {"charts", texture.chart_count},
        {"stretch", texture.stretch},      {"largest_stretch", texture.largest_stretch},
        {"area_used", texture.area_used},  {"seam_length", texture.seam_length},
        {"gutter", texture.gutter},        {"flipped", texture.flipped}};
  all["peak_memory_bytes"] = peakMemory ();
  all["memory_limit"] = nullptr;
  if (line.max_memory > 0)
    all["memory_limit"] = {{"bytes", line.max_memory},
                           {"scratch", fileName (line.scratch)},
                           {"scratch_peak_bytes", scratchUse ().peak}};
  all["loop"] = report.loop;
  all["unused"] = report.unused;
  all["outliers"] = report.outliers;
  all["scatter"] = report.scatter;
  all["non_finite"] = report.non_finite;
  all["duplicates"] = report.duplicates;
  return all;
}

std::string
reportText (const CommandLine& line, const Report& report, const RunFigures& run)
{
  const Json all = reportJson (line, report, run);
  std::string text;
  for (const auto& [key, value] : all.items ())
    text += (text.empty () ? "{\n  " : ",\n  ") + dump (key) + ": " + dump (value);
  return text + "\n}\n";
}

void
printOutcome (const CommandLine& line, const Report& report, const RunFigures& figures)
{
  const bool is_ok = report.status == RunStatus::SUCCESS && !figures.is_refused;
  std::FILE* const to = isStandardStream (line.output) ? stderr : stdout; // a mesh is alone there
  constexpr std::size_t FEW = 3; // the first warnings matter most
  const std::size_t count = report.warnings.size ();
  const bool shows_all = line.verbose || figures.is_refused;
  const std::size_t shown = shows_all ? count : line.quiet ? 0 : std::min (count, FEW);
  for (std::size_t i = 0; i < shown; ++i)
    std::fprintf (stderr, "warning: %s\n", printable (report.warnings[i]).c_str ());
  if (shown < count && !line.quiet)
    std::fprintf (stderr, "%s more: --verbose prints them\n",
                  counted (count - shown, "warning").c_str ());
  if (!is_ok) // the warnings may tell why
    std::fprintf (stderr, "%s: cannot reconstruct %s: %s (%s)\n", line.program,
                  printable (inputName (line.input)).c_str (), printable (report.message).c_str (),
                  outcomeName (report, figures).c_str ());
  if (is_ok && !line.quiet)
    printSummary (to, line, report, figures);
  if (line.json)
    std::fprintf (to, "%s\n", summaryLine (line, report, figures).c_str ());
  if (std::fflush (stdout) != 0 || std::ferror (stdout) != 0)
    throw WriteError ("cannot write to the standard output");
}

} // namespace pcl::floater

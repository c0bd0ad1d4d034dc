// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report_json.h"

#include "large_arrays.h"

#include <nlohmann/json.hpp>

#include <sys/resource.h>

namespace pcl
{
namespace floater
{
namespace
{
using Json = nlohmann::ordered_json;

Json
optionsJson (const CommandLine& line)
{
  const Options& options = line.options;
  const bool in_cloud_units = options.holes.unit == LengthUnit::CLOUD;
  return {{"method", choiceName (METHOD_CHOICES, options.disc.as_published)},
          {"topology", choiceName (TOPOLOGY_CHOICES, options.topology)},
          {"holes", choiceName (HOLE_CHOICES, options.holes.policy)},
          {"kept_loops", options.holes.kept_loops},
          {"largest_hole", in_cloud_units ? 0.0 : options.holes.largest_hole},
          {"largest_hole_length", in_cloud_units ? options.holes.largest_hole : 0.0},
          {"max_edge", options.trimming.maximum_edge_length},
          {"max_edge_ratio", options.trimming.maximum_edge_ratio},
          {"min_component", options.trimming.minimum_component_size},
          {"viewpoint", options.view.use == ViewUse::GIVEN  ? Json (options.view.viewpoint)
                        : options.view.use == ViewUse::AUTO ? Json ("auto")
                                                            : Json ("none")},
          {"facing", choiceName (FACING_CHOICES, options.facing)},
          {"use_input_normals", line.use_input_normals},
          {"remove_outliers", options.remove_outliers},
          {"scatter", choiceName (SCATTER_CHOICES, options.scatter)},
          {"denoise", options.denoise},
          {"neighbors", options.neighbors.k},
          {"neighborhood", choiceName (NEIGHBORHOOD_CHOICES, options.neighbors.kind)},
          {"ball_radius", options.neighbors.ball_radius},
          {"sheet_filter", options.filter_sheets},
          {"boundary", choiceName (BOUNDARY_CHOICES, options.disc.boundary.method)},
          {"loop_given", !options.disc.boundary.loop.empty ()},
          {"opening_angle", options.disc.boundary.opening_angle},
          {"cluster_tolerance", options.disc.boundary.cluster_tolerance},
          {"cluster_neighbors", options.disc.boundary.cluster_k},
          {"domain", choiceName (DOMAIN_CHOICES, options.disc.domain.curve)},
          {"sides", options.disc.domain.polygon_sides},
          {"spacing", choiceName (SPACING_CHOICES, options.disc.domain.loop_spacing)},
          {"weights", choiceName (WEIGHTING_CHOICES, options.disc.weighting)},
          {"solver", choiceName (SOLVER_CHOICES, options.disc.solver.method)},
          {"ordering", choiceName (ORDERING_CHOICES, options.disc.solver.ordering)},
          {"tolerance", options.disc.solver.tolerance},
          {"max_iterations", options.disc.solver.max_iterations},
          {"ilut_fill", options.disc.solver.ilut_fill},
          {"ilut_drop", options.disc.solver.ilut_drop},
          {"flips", options.flip_edges},
          {"uncross", options.remove_self_intersections},
          {"open_crossings", options.trimming.open_self_intersections},
          {"threads", options.threads},
          {"blocks", options.blocks}};
}

Json
viewpointJson (const Report& report)
{
  if (!report.is_view)
    return {};
  return {{"is_far", report.is_far_view},
          {report.is_far_view ? "direction" : "place", report.viewpoint}};
}

Json
statisticsJson (const Statistics& statistics)
{
  return {{"cloud_points", statistics.cloud_points},
          {"selected_points", statistics.selected_points},
          {"non_finite_points", statistics.non_finite_points},
          {"duplicate_points", statistics.duplicate_points},
          {"working_points", statistics.working_points},
          {"outlier_points", statistics.outlier_points},
          {"scatter_points", statistics.scatter_points},
          {"noise", statistics.noise},
          {"noise_quantile_90", statistics.noise_quantile_90},
          {"largest_noise", statistics.largest_noise},
          {"projected_points", statistics.projected_points},
          {"coordinate_step", statistics.coordinate_step},
          {"trimmed_triangles", statistics.trimmed_triangles},
          {"opened_triangles", statistics.opened_triangles},
          {"trimmed_components", statistics.trimmed_components},
          {"trimmed_points", statistics.trimmed_points},
          {"view_steps", statistics.view_steps},
          {"view_gaps", statistics.view_gaps},
          {"holes_filled", statistics.holes_filled},
          {"used_points", statistics.used_points},
          {"relinked_points", statistics.relinked_points},
          {"boundary_candidates", statistics.boundary_candidates},
          {"loop_points", statistics.loop_points},
          {"triangles", statistics.triangles},
          {"levels", statistics.levels},
          {"flips", statistics.flips},
          {"folds", statistics.folds},
          {"self_intersections_found", statistics.self_intersections_found},
          {"self_intersection_flips", statistics.self_intersection_flips},
          {"self_intersection_moves", statistics.self_intersection_moves},
          {"self_intersection_rebuilds", statistics.self_intersection_rebuilds},
          {"unknowns", statistics.unknowns},
          {"nnz_matrix", statistics.nnz_matrix},
          {"nnz_factors", statistics.nnz_factors},
          {"fill_in", statistics.fill_in},
          {"residual", statistics.residual},
          {"relative_residual", statistics.relative_residual},
          {"iterations_u", statistics.iterations_u},
          {"iterations_v", statistics.iterations_v},
          {"reciprocal_condition", statistics.reciprocal_condition},
          {"factorization_bytes", statistics.factorization_bytes}};
}

Json
checkJson (const MeshCheck& check, bool is_view)
{
  if (!check.done)
    return {};
  Json loops = Json::array ();
  for (const LoopSummary& loop : check.loops)
    loops.push_back ({{"points", loop.points},
                      {"length", loop.length},
                      {"width", loop.width},
                      {"width_spacings", loop.width_spacings},
                      {"at", loop.at}});
  return {{"nonmanifold_edges", check.nonmanifold_edges},
          {"nonmanifold_vertices", check.nonmanifold_vertices},
          {"orientation_conflicts", check.orientation_conflicts},
          {"components", check.components},
          {"euler_characteristic", check.euler_characteristic},
          {"genus", check.genus},
          {"folds", check.folds},
          {"degenerate_triangles", check.degenerate_triangles},
          {"self_intersections", is_view ? Json () : Json (check.self_intersections)},
          {"self_intersections_at", check.self_intersections_at},
          {"longest_edge", check.longest_edge},
          {"longest_edge_at", check.longest_edge_at},
          {"loops", loops}};
}

// Null if no texture coordinates were asked for.
Json
textureJson (const CommandLine& line, const RunFigures& run)
{
  const TextureCoordinates& texture = run.texture;
  if (texture.status != RunStatus::SUCCESS)
    return {};
  return {{"file", line.texture.empty () ? Json () : Json (line.texture.string ())},
          {"charts", texture.chart_count},
          {"stretch", texture.stretch},
          {"largest_stretch", texture.largest_stretch},
          {"area_used", texture.area_used},
          {"seam_length", texture.seam_length},
          {"gutter", texture.gutter},
          {"flipped", texture.flipped}};
}

Json
loopDecisionsJson (const Report& report)
{
  Json decisions = Json::array ();
  for (const LoopDecision& decision : report.loop_decisions)
    decisions.push_back ({{"points", decision.points},
                          {"width", decision.width},
                          {"width_spacings", decision.width_spacings},
                          {"at", decision.at},
                          {"stays_open", decision.stays_open},
                          {"probability", decision.probability},
                          {"is_too_deep", decision.is_too_deep}});
  return decisions;
}

Json
facingDecisionsJson (const Report& report)
{
  Json decisions = Json::array ();
  for (const FacingDecision& decision : report.facing_decisions)
    decisions.push_back ({{"triangles", decision.triangles},
                          {"at", decision.at},
                          {"rule", facingRuleName (decision.rule)},
                          {"certainty", decision.certainty}});
  return decisions;
}

// How many parts of the mesh face as they do by each rule that turned any.
Json
facingPartsJson (const Report& report)
{
  Json parts = Json::object ();
  for (std::size_t rule = 0; rule < report.facing_parts.size (); ++rule)
    if (report.facing_parts[rule] > 0)
      parts[facingRuleName (static_cast<FacingRule> (rule))] = report.facing_parts[rule];
  return parts;
}

Json
secondsJson (const Statistics& statistics, const RunFigures& run)
{
  Json seconds = {{"reading", run.read_seconds}};
  for (std::size_t stage = 0; stage < statistics.seconds.size (); ++stage)
    seconds[stageName (static_cast<Stage> (stage))] = statistics.seconds[stage];
  seconds["reconstruction"] = run.reconstruct_seconds;
  if (run.texture.status != RunStatus::NOT_RUN)
    seconds["texture"] = run.texture_seconds;
  return seconds;
}

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
  const Json all = {{"tool", "pcl_floater_reconstruct"},
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
                                            {"triangles", report.statistics.triangles},
                                            {"parameterization", fileName (line.parameterization)}}
                                     : Json ()},
                    {"options", optionsJson (line)},
                    {"strict", line.strict},
                    {"status", outcomeName (report, run)},
                    {"message", report.message},
                    {"warnings", report.warnings},
                    {"topology", choiceName (TOPOLOGY_CHOICES, report.topology)},
                    {"topology_reason", report.topology_reason},
                    {"viewpoint", viewpointJson (report)},
                    {"denoised", report.denoised},
                    {"check", checkJson (report.check, report.is_view)},
                    {"loop_decisions", loopDecisionsJson (report)},
                    {"facing_certainty", report.facing_certainty},
                    {"facing_parts", facingPartsJson (report)},
                    {"facing_decisions", facingDecisionsJson (report)},
                    {"statistics", statisticsJson (report.statistics)},
                    {"texture", is_ok ? textureJson (line, run) : Json ()},
                    {"seconds", secondsJson (report.statistics, run)},
                    {"peak_memory_bytes", peakMemory ()},
                    {"memory_limit", memoryLimitJson (line)},
                    {"loop", report.loop},
                    {"unused", report.unused},
                    {"outliers", report.outliers},
                    {"scatter", report.scatter},
                    {"non_finite", report.non_finite},
                    {"duplicates", report.duplicates}};
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

} // namespace floater
} // namespace pcl

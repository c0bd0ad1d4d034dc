// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report_json.h"

#include "choices.h"

#include <nlohmann/json.hpp>

namespace pcl::floater {
namespace {
using Json = nlohmann::ordered_json;

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

} // namespace

nlohmann::ordered_json
optionsJson (const Options& options, bool use_input_normals)
{
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
          {"use_input_normals", use_input_normals},
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

nlohmann::ordered_json
viewpointJson (const Report& report)
{
  if (!report.is_view)
    return {};
  return {{"is_far", report.is_far_view},
          {"by_pixels", report.is_view_by_pixels},
          {report.is_far_view ? "direction" : "place", report.viewpoint}};
}

nlohmann::ordered_json
resultJson (const Report& report)
{
  return {{"topology", choiceName (TOPOLOGY_CHOICES, report.topology)},
          {"topology_reason", report.topology_reason},
          {"viewpoint", viewpointJson (report)},
          {"denoised", report.denoised},
          {"check", checkJson (report.check, report.is_view)},
          {"loop_decisions", loopDecisionsJson (report)},
          {"facing_certainty", report.facing_certainty},
          {"facing_parts", facingPartsJson (report)},
          {"facing_decisions", facingDecisionsJson (report)},
          {"statistics", statisticsJson (report.statistics)}};
}

nlohmann::ordered_json
secondsJson (const Statistics& statistics)
{
  Json seconds = Json::object ();
  for (std::size_t stage = 0; stage < statistics.seconds.size (); ++stage)
    seconds[stageName (static_cast<Stage> (stage))] = statistics.seconds[stage];
  return seconds;
}

} // namespace pcl::floater

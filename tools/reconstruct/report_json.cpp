// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report_json.h"

#include "options/option_rows.h"

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

// Writes the value of each option.
struct OptionsWriter
{
  Json& json;

  template <typename Number>
  void operator() (const OptionRow& row, Number value, const NumberRange&)
  {
    json[row.name] = value;
  }
  void operator() (const OptionRow& row, bool value) { json[row.name] = value; }
  template <typename Enum, std::size_t N>
  void operator() (const OptionRow& row, Enum value, const Choices<Enum, N>& choices)
  {
    json[row.name] = choiceName (choices, value);
  }
  void operator() (const OptionRow& row, const HoleOptions& holes, LengthUnit unit)
  {
    json[row.name] = holes.unit == unit ? holes.largest_hole : 0.0;
  }
  void operator() (const OptionRow& row, const ViewOptions& view)
  {
    json[row.name] = view.use == ViewUse::GIVEN  ? Json (view.viewpoint)
                     : view.use == ViewUse::AUTO ? Json ("auto")
                                                 : Json ("none");
  }
};

// Writes what the table has on each option.
struct TableWriter
{
  Json& table;
  Json defaults;

  template <typename Number>
  void operator() (const OptionRow& row, Number, const NumberRange& range)
  {
    add (row, std::is_integral_v<Number> ? "int" : "float", range.text ());
  }
  void operator() (const OptionRow& row, bool) { add (row, "bool", {true, false}); }
  template <typename Enum, std::size_t N>
  void operator() (const OptionRow& row, Enum, const Choices<Enum, N>& choices)
  {
    Json words = Json::array ();
    for (const auto& choice : choices)
      words.push_back (choice.first);
    add (row, "word", words);
  }
  void operator() (const OptionRow& row, const HoleOptions&, LengthUnit)
  {
    add (row, "float", NumberRange{0, NO_LIMIT}.text ());
  }
  void operator() (const OptionRow& row, const ViewOptions&)
  {
    add (row, "place", "x,y,z, auto or none");
  }

  void add (const OptionRow& row, const char* kind, const Json& values)
  {
    table.push_back ({{"name", row.name},
                      {"letter", row.letter},
                      {"group", row.group},
                      {"class", row.in_class},
                      {"kind", kind},
                      {"default", defaults[row.name]},
                      {"values", values},
                      {"text", row.text}});
  }
};

} // namespace

nlohmann::ordered_json
optionsJson (const Options& options, bool use_input_normals)
{
  Json json = Json::object ();
  visitOptions (options, OptionsWriter{json});
  json["use_input_normals"] = use_input_normals;
  json["loop_given"] = !options.disc.boundary.loop.empty ();
  return json;
}

nlohmann::ordered_json
optionTableJson ()
{
  Json table = Json::array ();
  const Options defaults;
  visitOptions (defaults, TableWriter{table, optionsJson (defaults, false)});
  return table;
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

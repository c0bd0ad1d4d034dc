// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report_json.h"

#include "options/option_rows.h"

#include <nlohmann/json.hpp>

namespace pcl::floater {
using Json = nlohmann::ordered_json;

// As NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE for nlohmann::json, which has no fixed order: with the members
// by their names. The names of the parameters are those that the macros of nlohmann expect.
#define PCL_FLOATER_TO_JSON(Type, ...)                                                             \
  static void to_json (Json& nlohmann_json_j, const Type& nlohmann_json_t)                         \
  {                                                                                                \
    NLOHMANN_JSON_EXPAND (NLOHMANN_JSON_PASTE (NLOHMANN_JSON_TO, __VA_ARGS__))                     \
  }
// NOLINTBEGIN(readability-identifier-naming)

PCL_FLOATER_TO_JSON (Statistics, cloud_points, selected_points, non_finite_points, duplicate_points,
                     working_points, outlier_points, scatter_points, stacked_points, stack_height,
                     largest_stack_height, noise, noise_quantile_90, largest_noise,
                     projected_points, coordinate_step, trimmed_triangles, opened_triangles,
                     trimmed_components, trimmed_points, view_steps, view_gaps, holes_filled,
                     used_points, boundary_candidates, loop_points, triangles, flips, folds,
                     necks_cut, remade_points, self_intersections_found, self_intersection_flips,
                     self_intersection_moves, self_intersection_rebuilds, unknowns, nnz_matrix,
                     nnz_factors, fill_in, residual, relative_residual, iterations_u, iterations_v,
                     reciprocal_condition, factorization_bytes)

PCL_FLOATER_TO_JSON (LoopSummary, points, length, width, width_spacings, at)

PCL_FLOATER_TO_JSON (LoopDecision, points, width, width_spacings, at, stays_open, probability,
                     is_too_deep)

static void
to_json (Json& json, FacingRule rule)
{
  json = facingRuleName (rule);
}

PCL_FLOATER_TO_JSON (FacingDecision, triangles, at, rule, certainty)

static void
to_json (Json& json, const Finding& finding)
{
  Json places = Json::array ();
  for (const auto& [point, position] : finding.places)
    places.push_back ({{"point", point}, {"position", position}});
  json = {{"id", findingName (finding.id)},
          {"severity", severityName (finding.severity)},
          {"numbers", finding.numbers},
          {"places", places}};
}

PCL_FLOATER_TO_JSON (MeshCheck, nonmanifold_edges, nonmanifold_vertices, components,
                     euler_characteristic, genus, folds, degenerate_triangles, self_intersections,
                     has_more_self_intersections, self_intersections_at, largest_area_share,
                     longest_edge, longest_edge_at, loops)

// NOLINTEND(readability-identifier-naming)

namespace {
// Writes what the table has on each option, with its value as the default.
struct TableWriter
{
  Json& table;

  template <typename Number>
  void operator() (const OptionRow& row, Number value, const NumberRange& range)
  {
    add (row, std::is_integral_v<Number> ? "int" : "float", range.text (), value);
  }
  void operator() (const OptionRow& row, bool value) { add (row, "bool", {true, false}, value); }
  template <typename Enum, std::size_t N>
  void operator() (const OptionRow& row, Enum value, Choices<Enum, N>& choices)
  {
    Json words = Json::array ();
    for (const auto& choice : choices)
      words.push_back (choice.first);
    add (row, "word", words, choiceName (choices, value));
  }
  void operator() (const OptionRow& row, const HoleOptions& holes, LengthUnit unit)
  {
    (*this) (row, holes.unit == unit ? holes.largest_hole : 0.0, NumberRange{0, NO_LIMIT});
  }
  void operator() (const OptionRow& row, const ViewOptions& view)
  {
    add (row, "place", "x,y,z, auto or none",
         view.use == ViewUse::GIVEN  ? Json (view.viewpoint)
         : view.use == ViewUse::AUTO ? Json ("auto")
                                     : Json ("none"));
  }

  void add (const OptionRow& row, const char* kind, const Json& values, const Json& value)
  {
    table.push_back ({{"name", row.name},
                      {"letter", row.letter},
                      {"group", row.group},
                      {"class", row.in_class},
                      {"kind", kind},
                      {"default", value},
                      {"values", values},
                      {"text", row.text}});
  }
};

} // namespace

std::string
dump (const nlohmann::ordered_json& json, int indent)
{
  return json.dump (indent, ' ', false, Json::error_handler_t::replace);
}

nlohmann::ordered_json
optionTableJson (const Options& options)
{
  Json table = Json::array ();
  visitOptions (options, TableWriter{table});
  return table;
}

nlohmann::ordered_json
optionsJson (const Options& options, bool use_input_normals)
{
  Json json = Json::object ();
  for (const Json& row : optionTableJson (options))
    json[row["name"].get<std::string> ()] = row["default"];
  json["use_input_normals"] = use_input_normals;
  json["loop_given"] = !options.disc.boundary.loop.empty ();
  return json;
}

nlohmann::ordered_json
viewpointJson (const Report& report)
{
  if (!report.is_view)
    return {};
  return {{"is_far", report.is_far_view},
          {report.is_far_view ? "direction" : "place", report.viewpoint}};
}

nlohmann::ordered_json
resultJson (const Report& report)
{
  Json check = report.check.done ? Json (report.check) : Json ();
  if (report.check.done && report.is_view)
    check["self_intersections"] = nullptr; // they have not been searched
  Json facing_parts = Json::object ();     // how many of them face as they do by each rule
  for (std::size_t rule = 0; rule < report.facing_parts.size (); ++rule)
    if (report.facing_parts[rule] > 0)
      facing_parts[facingRuleName (static_cast<FacingRule> (rule))] = report.facing_parts[rule];
  return {{"verdict",
           {{"value", qualityName (report.verdict.value)},
            {"cause", report.verdict.cause},
            {"remedy", report.verdict.remedy}}},
          {"topology", choiceName (TOPOLOGY_CHOICES, report.topology)},
          {"topology_reason", report.topology_reason},
          {"viewpoint", viewpointJson (report)},
          {"denoised", report.denoised},
          {"check", check},
          {"loop_decisions", report.loop_decisions},
          {"facing_certainty", report.facing_certainty},
          {"facing_parts", facing_parts},
          {"facing_decisions", report.facing_decisions},
          {"findings", report.findings},
          {"statistics", report.statistics}};
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

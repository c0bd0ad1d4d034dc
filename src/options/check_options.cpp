// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/check_options.h"

#include "options/option_rows.h"

#include <cstdio>
#include <initializer_list>

namespace pcl::floater {
namespace {
Problem
refused (const char* option, const std::string& why)
{
  return {RunStatus::INVALID_OPTION, option + (" " + why), option};
}

// Keeps the first number out of range.
struct RangeCheck
{
  Problem problem;

  template <typename Number>
  void operator() (const OptionRow& row, Number value, const NumberRange& range)
  {
    if (!problem && !range.has (value))
      problem = refused (row.name, "must be " + range.text ());
  }
  void operator() (const OptionRow& row, const HoleOptions& holes, LengthUnit unit)
  {
    if (holes.unit == unit)
      (*this) (row, holes.largest_hole, NumberRange{0, NO_LIMIT});
  }
  template <typename... Other>
  void operator() (const OptionRow&, const Other&...)
  {
  }
};

std::string
numberText (double number)
{
  char text[32];
  std::snprintf (text, sizeof text, "%.15g", number);
  return text;
}

// What each method accepts, and what a hole policy needs.
Problem
checkTogether (const Options& options)
{
  const HolePolicy holes = options.holes.policy;
  const auto& viewpoint = options.view.viewpoint;
  const bool is_surface = options.topology == Topology::SURFACE;
  const bool is_loop_given = !options.disc.boundary.loop.empty ();
  const bool is_view_given = options.view.use == ViewUse::GIVEN;
  struct Rule
  {
    bool is_broken;
    const char *option, *why;
  };
  const Rule rules[] = {
      {holes == HolePolicy::BY_SIZE && options.holes.largest_hole == 0.0, "holes",
       "by size need the size of the largest hole to fill"},
      {options.topology == Topology::DISC && holes != HolePolicy::AUTO &&
           holes != HolePolicy::KEEP_LARGEST,
       "holes",
       "of a disc must be auto or keep-largest: it has one boundary loop and no holes; choose "
       "another topology"},
      {is_surface && is_loop_given, "topology", "must be disc or auto if a boundary loop is given"},
      {is_surface && options.disc.as_published, "topology",
       "must be disc or auto: the method of TW 385 makes discs only"},
      {is_view_given && !std::all_of (viewpoint.begin (), viewpoint.end (),
                                      [] (double x) { return std::isfinite (x); }),
       "viewpoint", "must have finite coordinates"},
      {is_view_given && (options.topology == Topology::DISC || is_loop_given), "viewpoint",
       "is of no use for a disc, which is laid out without it"}};
  for (const Rule& rule : rules)
    if (rule.is_broken)
      return refused (rule.option, rule.why);
  return {};
}

// Why an option has no effect, or nullptr.
const char*
reasonOf (UsedFor use, const Options& options, const Report& report)
{
  const BoundaryOptions& boundary = options.disc.boundary;
  const Neighborhood kind = options.neighbors.kind;
  const bool is_disc = report.topology == Topology::DISC;
  const bool in_balls = isInBalls (kind);
  const auto isOneOf = [use] (std::initializer_list<UsedFor> uses) {
    return std::find (uses.begin (), uses.end (), use) != uses.end ();
  };
  const std::pair<bool, const char*> reasons[] = {
      // whether it holds, and its text
      {use == UsedFor::KEEP_COUNT && options.holes.policy != HolePolicy::KEEP_COUNT,
       "only the hole policy keep-count reads it"},
      {use == UsedFor::BY_SIZE && options.holes.policy != HolePolicy::BY_SIZE,
       "only the hole policy by-size reads it"},
      {use == UsedFor::SCATTER && options.disc.as_published,
       "the method of TW 385 keeps all points"},
      {report.is_view && isOneOf ({UsedFor::STARS, UsedFor::NEIGHBORHOOD, UsedFor::NEAREST,
                                   UsedFor::BALLS, UsedFor::SCATTER}),
       "a scan is connected as its sensor saw it, without neighbours"},
      {use == UsedFor::NEAREST && in_balls, "neighbours are searched in balls"},
      {use == UsedFor::BALLS && !in_balls, "neighbours are not searched in balls"},
      // A surface uses Delaunay stars of either.
      {!is_disc && (isOneOf ({UsedFor::DISC, UsedFor::LOOP, UsedFor::TWO_SEGMENTS, UsedFor::POLYGON,
                              UsedFor::ITERATIVE}) ||
                    (use == UsedFor::NEIGHBORHOOD && kind == Neighborhood::NEAREST)),
       "the mesh was not made as a disc"},
      {isOneOf ({UsedFor::LOOP, UsedFor::TWO_SEGMENTS}) && !boundary.loop.empty (),
       "the boundary loop is given"},
      {use == UsedFor::TWO_SEGMENTS && boundary.method != BoundaryMethod::TWO_SEGMENTS,
       "only the boundary method two-segments reads it"},
      {use == UsedFor::POLYGON && options.disc.domain.curve != Domain::POLYGON,
       "the domain is no polygon"},
      {use == UsedFor::ITERATIVE && options.disc.solver.method != Solver::BICGSTAB_ILUT,
       "only the solver bicgstab-ilut reads it"},
  };
  const auto first = std::find_if (std::begin (reasons), std::end (reasons),
                                   [] (const auto& reason) { return reason.first; });
  return first != std::end (reasons) ? first->second : nullptr;
}

} // namespace

DiscOptions
DiscOptions::tw385 ()
{
  DiscOptions disc;
  disc.as_published = true;
  disc.boundary.method = BoundaryMethod::TWO_SEGMENTS; // section 3.3
  disc.boundary.opening_angle = 160.0;                 // section 3.1
  disc.boundary.cluster_tolerance = 0.05;              // sections 3.2 and 5: 5 % of the diagonal
  disc.domain.curve = Domain::CIRCLE;                  // section 2.1: any convex domain
  disc.weighting = Weighting::MEAN_VALUE;              // section 4.1, equation (2)
  disc.solver.method = Solver::UMFPACK;                // section 4.2
  disc.solver.ordering = Ordering::AMD;                // section 4.2
  return disc;
}

Options
effectiveOptions (const Options& options)
{
  Options effective = options;
  if (!options.disc.as_published)
    return effective;
  if (options.topology == Topology::AUTO)
    effective.topology = Topology::DISC;
  effective.remove_outliers = false;
  effective.scatter = ScatterPolicy::AUTO; // a disc keeps all points
  effective.denoise = false;
  effective.filter_sheets = false;
  effective.flip_edges = false;
  effective.remove_self_intersections = false;
  return effective;
}

void
choosePublished (DiscOptions& disc, bool boundary_is_given, bool ordering_is_given)
{
  const DiscOptions published = DiscOptions::tw385 ();
  if (!boundary_is_given)
    disc.boundary.method = published.boundary.method;
  if (!ordering_is_given && disc.solver.method == published.solver.method)
    disc.solver.ordering = published.solver.ordering;
}

std::string
NumberRange::text () const
{
  const std::string from = numberText (least), to = numberText (most);
  if (most == NO_LIMIT)
    return from + " or more";
  if (!without_least && !without_most)
    return "from " + from + " to " + to;
  return "above " + from + (without_most ? " and below " : " and at most ") + to;
}

Problem
checkOptions (const Options& options)
{
  RangeCheck ranges;
  visitOptions (options, ranges);
  if (ranges.problem)
    return ranges.problem;
  if (Problem problem = checkTogether (options))
    return problem;
  if (!options.disc.boundary.loop.empty () && options.disc.boundary.loop.size () < 3)
    return {RunStatus::INVALID_LOOP, "the given boundary loop has fewer than 3 points"};
  return {};
}

std::vector<std::string>
describeUnusedOptions (const Options& options, const Report& report, bool has_plane_normals)
{
  const OptionValues defaults (Options{}), given (options);
  std::vector<std::pair<std::string, std::vector<std::string>>> found; // reasons, and the options
  const auto add = [&found] (const std::string& name, const char* reason) {
    for (auto& [known, names] : found)
      if (known == reason) {
        names.push_back (name);
        return;
      }
    found.push_back ({reason, {name}});
  };
  for (std::size_t i = 0; i < given.rows.size (); ++i)
    if (given.values[i] != defaults.values[i])
      if (const char* const reason = reasonOf (given.rows[i].used_for, options, report))
        add (given.rows[i].name, reason);
  if (report.is_view && has_plane_normals && options.facing != Facing::AUTO &&
      options.facing != Facing::NORMALS)
    add ("the normals of the input",
         "a scan is connected as its sensor saw it, without tangent planes, and "
         "another facing is asked for");
  std::vector<std::string> sentences;
  for (const auto& [reason, names] : found) {
    std::string text =
        names.size () == 1 ? "an option has no effect: " : "options have no effect: ";
    for (std::size_t i = 0; i < names.size (); ++i)
      text += (i == 0 ? "" : ", ") + names[i];
    sentences.push_back (text.append ("; ").append (reason));
  }
  return sentences;
}

} // namespace pcl::floater

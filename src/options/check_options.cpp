// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/check_options.h"

#include "floater/solvers/solver.h"
#include "options/option_rows.h"

#include <cmath>
#include <cstdio>

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
  template <typename Enum, std::size_t N>
  void operator() (const OptionRow&, Enum, const Choices<Enum, N>&)
  {
  }
  void operator() (const OptionRow&, bool) {}
  void operator() (const OptionRow&, const ViewOptions&) {}
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
checkTopology (const Options& options)
{
  if (options.holes.policy == HolePolicy::BY_SIZE && options.holes.largest_hole == 0.0)
    return refused ("holes", "by size need the size of the largest hole to fill");
  if (options.topology == Topology::DISC && options.holes.policy != HolePolicy::AUTO &&
      options.holes.policy != HolePolicy::KEEP_LARGEST)
    return refused (
        "holes", "of a disc must be auto or keep-largest: it has one boundary loop and no holes; "
                 "choose another topology");
  if (options.topology == Topology::SURFACE && !options.disc.boundary.loop.empty ())
    return refused ("topology", "must be disc or auto if a boundary loop is given");
  if (options.topology == Topology::SURFACE && options.disc.as_published)
    return refused ("topology", "must be disc or auto: the method of TW 385 makes discs only");
  return {};
}

Problem
checkView (const Options& options)
{
  if (options.view.use != ViewUse::GIVEN)
    return {};
  for (const double coordinate : options.view.viewpoint)
    if (!std::isfinite (coordinate))
      return refused ("viewpoint", "must have finite coordinates");
  if (options.topology == Topology::DISC || !options.disc.boundary.loop.empty ())
    return refused ("viewpoint", "is of no use for a disc, which is laid out without it");
  return {};
}

} // namespace

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
  if (Problem problem = checkTopology (options))
    return problem;
  if (Problem problem = checkView (options))
    return problem;
  if (Problem problem = checkSolver (options.disc.solver.method, options.disc.solver.ordering))
    return problem;
  if (!options.disc.boundary.loop.empty () && options.disc.boundary.loop.size () < 3)
    return {RunStatus::INVALID_LOOP, "the given boundary loop has fewer than 3 points"};
  return {};
}

} // namespace pcl::floater

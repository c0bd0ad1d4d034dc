// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/unused_options.h"

#include "options/option_rows.h"

#include <utility>

namespace pcl::floater {
namespace {
bool
areInBalls (Neighborhood kind)
{
  return kind == Neighborhood::BALL || kind == Neighborhood::BALL_DELAUNAY;
}

// Why options that only discs read have no effect, or nullptr.
const char*
reasonOfDisc (UsedFor use, const Options& options, const Report& report)
{
  const DiscOptions& disc = options.disc;
  const Solver solver = disc.solver.method;
  if (report.topology != Topology::DISC)
    return "the mesh was not made as a disc";
  const bool is_of_loop = use == UsedFor::LOOP || use == UsedFor::TWO_SEGMENTS;
  if (is_of_loop && !disc.boundary.loop.empty ())
    return "the boundary loop is given";
  if (use == UsedFor::TWO_SEGMENTS && disc.boundary.method != BoundaryMethod::TWO_SEGMENTS)
    return "only the boundary method two-segments reads it";
  if (use == UsedFor::POLYGON && disc.domain.curve != Domain::POLYGON)
    return "the domain is no polygon";
  if (use == UsedFor::ILUT && solver != Solver::BICGSTAB_ILUT)
    return "only the solver bicgstab-ilut reads it";
  if (use == UsedFor::ITERATIVE && solver != Solver::BICGSTAB_ILUT &&
      solver != Solver::GAUSS_SEIDEL)
    return "the solver is direct";
  return nullptr;
}

const char*
reasonOf (UsedFor use, const Options& options, const Report& report)
{
  const bool in_balls = areInBalls (options.neighbors.kind);
  switch (use) {
  case UsedFor::ALL:
    return nullptr;
  case UsedFor::KEEP_COUNT:
    return options.holes.policy == HolePolicy::KEEP_COUNT
               ? nullptr
               : "only the hole policy keep-count reads it";
  case UsedFor::BY_SIZE:
    return options.holes.policy == HolePolicy::BY_SIZE ? nullptr
                                                       : "only the hole policy by-size reads it";
  case UsedFor::STARS:
  case UsedFor::NEIGHBORHOOD:
  case UsedFor::NEAREST:
  case UsedFor::BALLS:
  case UsedFor::SCATTER:
    if (use == UsedFor::SCATTER && options.disc.as_published)
      return "the method of TW 385 keeps all points";
    if (report.is_view)
      return "a scan is connected as its sensor saw it, without neighbours";
    if (use == UsedFor::NEAREST && in_balls)
      return "neighbours are searched in balls";
    if (use == UsedFor::BALLS && !in_balls)
      return "neighbours are not searched in balls";
    // A surface uses Delaunay stars of either.
    if (use == UsedFor::NEIGHBORHOOD && report.topology == Topology::SURFACE &&
        options.neighbors.kind == Neighborhood::NEAREST)
      return "the mesh was not made as a disc";
    return nullptr;
  default:
    return reasonOfDisc (use, options, report);
  }
}

} // namespace

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

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "check_options.h"

#include "floater/solvers/solver.h"

#include <cmath>

namespace pcl::floater {
namespace {
// \param range in which the option must be
Problem
outOfRange (const char* name, const char* range)
{
  return {RunStatus::INVALID_OPTION, std::string (name) + " must be " + range};
}

// What the two methods take, and what a policy for holes needs.
Problem
checkTopology (const Options& options)
{
  const auto refused = [] (const char* why) { return Problem{RunStatus::INVALID_OPTION, why}; };
  if (options.holes.kept_loops < 0)
    return refused ("the number of kept loops must be 0 or more");
  if (!(options.holes.largest_hole >= 0.0 && std::isfinite (options.holes.largest_hole)))
    return refused ("the size of the largest hole must be 0 or more");
  if (options.holes.policy == HolePolicy::BY_SIZE && options.holes.largest_hole == 0.0)
    return refused ("holes chosen by their size need the size of the largest hole to fill");
  if (options.topology == Topology::DISC && options.holes.policy != HolePolicy::AUTO &&
      options.holes.policy != HolePolicy::KEEP_LARGEST)
    return refused ("a disc has one boundary loop and no holes: of the policies for holes it takes "
                    "the automatic one and that which keeps the largest loop; choose another "
                    "topology");
  if (options.topology == Topology::SURFACE && !options.disc.boundary.loop.empty ())
    return refused ("a boundary loop can be given for a disc only; choose another topology");
  if (options.topology == Topology::SURFACE && options.disc.as_published)
    return refused ("the method of TW 385 makes discs only; choose another topology");
  return {};
}

Problem
checkTrimming (const TrimmingOptions& options)
{
  const auto refused = [] (const char* why) { return Problem{RunStatus::INVALID_OPTION, why}; };
  if (!(options.maximum_edge_length >= 0.0 && std::isfinite (options.maximum_edge_length)))
    return refused ("the maximum edge length must be 0 (no limit) or more");
  if (!(options.maximum_edge_ratio >= 0.0 && std::isfinite (options.maximum_edge_ratio)))
    return refused ("the maximum edge ratio must be 0 (no limit) or more local spacings");
  if (options.minimum_component_size < 0)
    return refused ("the minimum component size must be 0 or more points");
  return {};
}

Problem
checkView (const Options& options)
{
  if (options.view.use != ViewUse::GIVEN)
    return {};
  for (const double coordinate : options.view.viewpoint)
    if (!std::isfinite (coordinate))
      return {RunStatus::INVALID_OPTION, "the viewpoint must have finite coordinates"};
  if (options.topology == Topology::DISC || !options.disc.boundary.loop.empty ())
    return {RunStatus::INVALID_OPTION,
            "a viewpoint is of no use for a disc, which is laid out without it"};
  return {};
}

Problem
checkDisc (const DiscOptions& options)
{
  if (!(options.boundary.opening_angle > 0.0 && options.boundary.opening_angle < 360.0))
    return outOfRange ("the opening angle", "above 0 and below 360 degrees");
  if (!(options.boundary.cluster_tolerance > 0.0 && options.boundary.cluster_tolerance <= 1.0))
    return outOfRange ("the cluster tolerance", "above 0 and at most 1");
  if (options.boundary.cluster_k < 1)
    return outOfRange ("the number of cluster neighbours", "1 or more");
  if (options.domain.polygon_sides < 3)
    return outOfRange ("the number of polygon sides", "3 or more");
  if (!(options.solver.tolerance > 0.0 && options.solver.tolerance < 1.0))
    return outOfRange ("the tolerance", "above 0 and below 1");
  if (options.solver.max_iterations < 1)
    return outOfRange ("the number of iterations", "1 or more");
  if (options.solver.ilut_fill < 1 || options.solver.ilut_fill > 10000)
    return outOfRange ("the fill of ILUT", "from 1 to 10000");
  if (!(options.solver.ilut_drop >= 0.0 && options.solver.ilut_drop <= 1.0))
    return outOfRange ("the drop tolerance of ILUT", "from 0 to 1");
  if (Problem problem = checkSolver (options.solver.method, options.solver.ordering))
    return problem;
  return {};
}

} // namespace

Problem
checkOptions (const Options& options)
{
  if (Problem problem = checkTopology (options))
    return problem;
  if (Problem problem = checkTrimming (options.trimming))
    return problem;
  if (Problem problem = checkView (options))
    return problem;
  if (options.neighbors.k < 6 || options.neighbors.k > 200)
    return outOfRange ("the number of neighbours", "from 6 to 200");
  if (!(options.neighbors.ball_radius >= 1.0 && options.neighbors.ball_radius <= 10.0))
    return outOfRange ("the ball radius", "from 1 to 10 local spacings");
  if (Problem problem = checkDisc (options.disc))
    return problem;
  if (options.threads < 0)
    return outOfRange ("the number of threads", "0 (all cores) or more");
  if (options.blocks < 0)
    return outOfRange ("the number of blocks", "0 (chosen by the points) or more");
  if (!options.disc.boundary.loop.empty () && options.disc.boundary.loop.size () < 3)
    return {RunStatus::INVALID_LOOP, "the given boundary loop has fewer than 3 points"};
  return {};
}

} // namespace pcl::floater

// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/published_method.h"

#include <limits>

namespace pcl::floater {
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
  effective.scatter = ScatterPolicy::KEEP;
  effective.denoise = false;
  effective.filter_sheets = false;
  effective.flip_edges = false;
  effective.remove_self_intersections = false;
  return effective;
}

Limits
effectiveLimits (const Limits& limits, const Options& options)
{
  Limits effective = limits;
  if (!options.disc.as_published)
    return effective;
  effective.planes.core_points = std::numeric_limits<std::size_t>::max ();
  effective.planes.sheet_sine = 1.0;
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

} // namespace pcl::floater
